#include "render/surface_drawer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace shoal {

// Triangles ready for a vertex buffer, relative to an origin of their own so that floats hold them far out.
struct SurfaceMesh {
    struct Corner {
        glm::vec3 position{0};  // m, relative to the origin
        glm::vec3 normal{0};    // unit
        glm::vec3 color{1};     // linear RGB
    };
    glm::dvec3 origin{0};  // m
    std::vector<Corner> corners;
    std::vector<uint32_t> indices;
};

namespace {

using std::numbers::pi;

// Two unit directions across a unit normal; x and z for one that points up.
std::pair<glm::dvec3, glm::dvec3> tangentsOf(const glm::dvec3& normal) {
    const glm::dvec3 start = std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 along = glm::normalize(start - glm::dot(start, normal) * normal);
    return {along, glm::cross(along, normal)};
}

SurfaceMesh meshOf(const Mesh& mesh) {
    SurfaceMesh out;
    out.origin = glm::floor(0.5 * (mesh.low + mesh.high));
    out.corners.reserve(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        SurfaceMesh::Corner corner;
        corner.position = glm::vec3(mesh.positions[i] - out.origin);
        corner.normal = glm::vec3(mesh.normals[i]);
        if (!mesh.colors.empty()) corner.color = glm::vec3(mesh.colors[i]);
        out.corners.push_back(corner);
    }
    out.indices.reserve(mesh.triangles.size() * 3);
    for (const glm::ivec3& t : mesh.triangles)
        out.indices.insert(out.indices.end(), {uint32_t(t[0]), uint32_t(t[1]), uint32_t(t[2])});
    return out;
}

// Adds rings of corners, each of which ends where it began, and two triangles between any four of them.
// `corner` makes that of a ring at a turn, rad.
template <typename MakeCorner>
void addRings(SurfaceMesh& mesh, int rings, int segments, const MakeCorner& corner) {
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j <= segments; ++j)
            mesh.corners.push_back(corner(i, 2 * pi * j / segments));
    for (int i = 0; i + 1 < rings; ++i)
        for (int j = 0; j < segments; ++j) {
            const uint32_t a = uint32_t(i * (segments + 1) + j), b = a + uint32_t(segments) + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
}

SurfaceMesh meshOf(const SphereCollider& sphere) {
    constexpr int rings = 48, segments = 96;
    SurfaceMesh out;
    out.origin = sphere.center;
    addRings(out, rings + 1, segments, [&](int i, double turn) {
        const double polar = pi * i / rings;
        const glm::dvec3 n(std::sin(polar) * std::sin(turn), std::cos(polar),
                           std::sin(polar) * std::cos(turn));
        return SurfaceMesh::Corner{glm::vec3(sphere.radius * n), glm::vec3(n), glm::vec3(1)};
    });
    return out;
}

SurfaceMesh meshOf(const BoxCollider& box) {
    SurfaceMesh out;
    out.origin = box.center;
    const glm::dmat3 turn = glm::mat3_cast(box.rotation);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 n(0), u(0), v(0);
            n[axis] = side;
            u[(axis + 1) % 3] = side;  // so that the corners go round anticlockwise
            v[(axis + 2) % 3] = 1;
            const uint32_t first = uint32_t(out.corners.size());
            for (const glm::dvec2 at : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                const glm::dvec3 place = 0.5 * box.size * (n + at.x * u + at.y * v);
                out.corners.push_back({glm::vec3(turn * place), glm::vec3(turn * n), glm::vec3(1)});
            }
            out.indices.insert(out.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
        }
    }
    return out;
}

// A sphere cut in two at its equator, the halves moved to the ends.
SurfaceMesh meshOf(const CapsuleCollider& capsule) {
    constexpr int rings = 24, segments = 64;
    SurfaceMesh out;
    out.origin = capsule.from;
    const glm::dvec3 span = capsule.to - capsule.from;
    const double length = glm::length(span);
    const glm::dvec3 axis = length > 0 ? span / length : glm::dvec3(0, 1, 0);
    const auto [along, across] = tangentsOf(axis);
    addRings(out, 2 * rings, segments, [&, &u = along, &v = across](int i, double turn) {
        const bool far = i < rings;  // the equator twice, once at each end
        const double polar = pi * (far ? i : i - 1) / (2 * (rings - 1));
        const glm::dvec3 n =
            std::cos(polar) * axis + std::sin(polar) * (std::cos(turn) * u + std::sin(turn) * v);
        return SurfaceMesh::Corner{glm::vec3(capsule.radius * n + (far ? span : glm::dvec3(0))), glm::vec3(n),
                                   glm::vec3(1)};
    });
    return out;
}

// A disc of radius 1 around the origin; its rings are closer together in the middle, where the eye is.
SurfaceMesh meshOf(const PlaneCollider& plane) {
    constexpr int rings = 24, segments = 64;
    const glm::dvec3 normal = glm::normalize(plane.normal);
    const auto [along, across] = tangentsOf(normal);
    SurfaceMesh out;
    addRings(out, rings + 1, segments, [&, &u = along, &v = across](int i, double turn) {
        const double radius = std::pow(double(i) / rings, 3);
        const glm::dvec3 place = radius * (std::cos(turn) * u + std::sin(turn) * v);
        return SurfaceMesh::Corner{glm::vec3(place), glm::vec3(normal), glm::vec3(1)};
    });
    return out;
}

// Nothing: these are drawn as their models.
SurfaceMesh meshOf(const HeightFieldCollider&) {
    return {};
}

SurfaceMesh meshOf(const DistanceFieldCollider&) {
    return {};
}

constexpr double planeReach = 60;   // how far a plane is drawn, in heights of the eye above it
constexpr double leastReach = 150;  // m

Pose poseOf(const std::optional<ColliderPath>& path, double time) {
    return path ? poseAt(*path, time) : Pose{};
}

glm::dvec3 placed(const Pose& pose, const glm::dvec3& x) {
    return pose.position + pose.rotation * x;
}

}  // namespace

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
        const SurfaceMesh mesh = std::visit([](const auto& kind) { return meshOf(kind); }, *collider.shape);
        if (mesh.indices.empty()) continue;
        Drawn drawn;
        drawn.color = glm::vec3(collider.color);
        drawn.path = collider.path;
        if (const auto* plane = std::get_if<PlaneCollider>(&*collider.shape)) {
            drawn.plane = *plane;
            drawn.casts = false;
            drawn.detail = grid ? 0.35f : 0.9f;
            planes = true;
        } else {
            drawn.roughness = 0.5f;
        }
        add(context, mesh, std::move(drawn), collider.name.c_str());
    }
    if (surfaces_.empty()) return;

    gpu::ProgramOptions options{
        "render/surface.vert", "render/surface.frag", lighting.defines(), {}, "surfaces"};
    lit_ = gpu::Program(context, shaderRoot, options);
    if (planes) {
        options.defines.push_back("PLANE");
        options.label = "planes";
        litPlane_ = gpu::Program(context, shaderRoot, options);
        litPlane_.use();
        litPlane_.set("grid", int(grid));
    }
    if (shadow != nullptr)
        depth_ = gpu::Program(
            context, shaderRoot,
            {"render/surface.vert", "render/surface_shadow.frag", {"DEPTH_ONLY"}, {}, "surface depth"});
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
