#include "render/surface_drawer.h"

#include <algorithm>
#include <cmath>

namespace shoal {

static constexpr double planeReach = 60;   // how far a plane is drawn, in heights of the eye above it
static constexpr double leastReach = 150;  // m

static Pose poseOf(const std::optional<ColliderPath>& path, double time) {
    return path ? poseAt(*path, time) : Pose{};
}

static glm::dvec3 placed(const Pose& pose, const glm::dvec3& x) {
    return pose.position + pose.rotation * x;
}

SurfaceDrawer::SurfaceDrawer(gpu::Context& context, const std::string& shaderRoot, const Scene& scene,
                             const Lighting& lighting, const ShadowMap* shadow, bool grid) {
    for (const Model& model : scene.models) {
        if (!model.draw || model.mesh.triangles.empty()) continue;
        Drawn drawn;
        drawn.color = glm::vec3(model.color);
        drawn.roughness = float(model.roughness);
        drawn.detail = float(model.grain);
        add(context, meshOf(model.mesh), std::move(drawn), model.name.c_str());
    }
    bool planes = false;
    for (const Collider& collider : scene.colliders) {
        if (!collider.draw) continue;
        Drawn drawn;
        drawn.color = glm::vec3(collider.color);
        drawn.path = collider.path;
        if (const auto* sphere = std::get_if<SphereCollider>(&collider.shape)) {
            drawn.roughness = 0.5f;
            add(context, sphereMesh(*sphere), std::move(drawn), collider.name.c_str());
        } else if (const auto* box = std::get_if<BoxCollider>(&collider.shape)) {
            drawn.roughness = 0.5f;
            add(context, boxMesh(*box), std::move(drawn), collider.name.c_str());
        } else if (const auto* capsule = std::get_if<CapsuleCollider>(&collider.shape)) {
            drawn.roughness = 0.5f;
            add(context, capsuleMesh(*capsule), std::move(drawn), collider.name.c_str());
        } else if (const auto* plane = std::get_if<PlaneCollider>(&collider.shape)) {
            drawn.plane = *plane;
            drawn.casts = false;
            drawn.detail = grid ? 0.35f : 0.9f;
            planes = true;
            add(context, discMesh(glm::normalize(plane->normal)), std::move(drawn), collider.name.c_str());
        }
    }
    if (surfaces_.empty()) return;

    gpu::ProgramOptions options{
        "render/surface.vert", "render/surface.frag", lighting.defines(), {}, "surfaces"};
    lit_ = gpu::Program(context, shaderRoot, options);
    if (planes) {
        options.defines.push_back("PLANE");
        if (grid) options.defines.push_back("GRID");
        options.label = "planes";
        litPlane_ = gpu::Program(context, shaderRoot, options);
    }
    if (shadow != nullptr) {
        depth_ = gpu::Program(
            context, shaderRoot,
            {"render/surface.vert", "render/surface_shadow.frag", {"DEPTH_ONLY"}, {}, "surface depth"});
    }
}

void SurfaceDrawer::add(gpu::Context& context, const SurfaceMesh& mesh, Drawn drawn, const char* label) {
    using Corner = SurfaceMesh::Corner;
    drawn.origin = mesh.origin;
    drawn.indexCount = int(mesh.indices.size());
    drawn.corners =
        gpu::Buffer(context, gpu::Buffer::Use::vertex, std::span<const Corner>(mesh.corners), label);
    drawn.indices =
        gpu::Buffer(context, gpu::Buffer::Use::index, std::span<const uint32_t>(mesh.indices), label);
    drawn.array = gpu::VertexArray(context, label);
    drawn.array.attribute(0, drawn.corners, 3, sizeof(Corner), offsetof(Corner, position));
    drawn.array.attribute(1, drawn.corners, 3, sizeof(Corner), offsetof(Corner, normal));
    drawn.array.attribute(2, drawn.corners, 3, sizeof(Corner), offsetof(Corner, color));
    drawn.array.indices(drawn.indices);
    surfaces_.push_back(std::move(drawn));
}

void SurfaceDrawer::submit(const Drawn& surface) const {
    surface.array.bind();
    glDrawElements(GL_TRIANGLES, surface.indexCount, GL_UNSIGNED_INT, nullptr);
}

void SurfaceDrawer::drawShadows(const ShadowMap& shadow, double time) const {
    for (const Drawn& surface : surfaces_) {
        if (!surface.casts) continue;
        depth_.use();
        depth_.set("toClip", shadow.toClip());
        const Pose pose = poseOf(surface.path, time);
        depth_.set("meshTurn", glm::mat3(glm::mat3_cast(pose.rotation)));
        depth_.set("meshOrigin", glm::vec3(placed(pose, surface.origin) - shadow.origin().exact));
        depth_.set("meshScale", 1.0f);
        submit(surface);
    }
}

// The disc's middle is the foot of the eye on the plane; grain and grid stay where they are in the scene.
void SurfaceDrawer::placePlane(const gpu::Program& program, const PlaneCollider& plane,
                               const Eye& eye) const {
    const glm::dvec3 normal = glm::normalize(plane.normal);
    const double height = glm::dot(eye.origin.exact - plane.point, normal);
    const double reach = std::max(leastReach, planeReach * std::abs(height));
    const glm::dvec3 foot = eye.origin.exact - height * normal;
    const auto [along, across] = tangentsOf(normal);
    const auto offset = [](double s) { return float(s - 10 * std::floor(s / 10)); };
    program.set("meshOrigin", glm::vec3(foot - eye.origin.exact));
    program.set("meshScale", float(reach));
    program.set("planeRadius", float(reach));
    program.set("planeAlong", glm::vec3(along));
    program.set("planeAcross", glm::vec3(across));
    program.set("planeOffset", glm::vec2(offset(glm::dot(foot, along)), offset(glm::dot(foot, across))));
    // The grain's lattice repeats every 2^20 wavelengths; the foot is taken to a whole number of kilometres.
    const glm::dvec3 kilometres = glm::floor(foot / 1000.0) * 1000.0;
    program.set("grainOffset", glm::vec3(foot - kilometres));
}

void SurfaceDrawer::draw(const Eye& eye, const Lighting& lighting, double time) const {
    for (const Drawn& surface : surfaces_) {
        const gpu::Program& program = surface.plane ? litPlane_ : lit_;
        program.use();
        lighting.apply(program, eye);
        program.set("toClip", eye.toClip);
        program.set("meshColor", surface.color);
        program.set("roughness", surface.roughness);
        program.set("detail", surface.detail);
        const Pose pose = poseOf(surface.path, time);
        program.set("meshTurn", glm::mat3(glm::mat3_cast(pose.rotation)));
        if (surface.plane) {
            placePlane(program, {placed(pose, surface.plane->point), pose.rotation * surface.plane->normal},
                       eye);
        } else {
            program.set("meshOrigin", glm::vec3(placed(pose, surface.origin) - eye.origin.exact));
            program.set("meshScale", 1.0f);
            program.set("grainOffset", glm::vec3(0));
        }
        submit(surface);
    }
}

}  // namespace shoal
