#include "render/surface_drawer.h"

#include <algorithm>
#include <cmath>

#include "gpu/shader_source.h"
#include "render/picture.h"
#include "scene/collider_mesh.h"

namespace shoal {

// Triangles ready for a vertex buffer, relative to an origin of their own so that floats hold them far out.
struct SurfaceMesh {
    struct Corner {
        glm::vec3 position{0};  // m, relative to the origin
        glm::vec3 normal{0};    // unit
        glm::vec3 color{1};     // linear RGB
        glm::vec2 uv{0};
    };
    struct Piece {
        int material = -1;  // its number in the mesh; -1: none
        int firstIndex = 0, indexCount = 0;
    };
    glm::dvec3 origin{0};  // m
    std::vector<Corner> corners;
    std::vector<uint32_t> indices;
    std::vector<Piece> pieces;  // empty: one of all
};

namespace {

SurfaceMesh meshOf(const Mesh& mesh) {
    SurfaceMesh out;
    out.origin = glm::floor(0.5 * (mesh.low + mesh.high));
    out.corners.reserve(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        SurfaceMesh::Corner corner;
        corner.position = glm::vec3(mesh.positions[i] - out.origin);
        corner.normal = glm::vec3(mesh.normals[i]);
        if (!mesh.colors.empty()) corner.color = glm::vec3(mesh.colors[i]);
        if (!mesh.uvs.empty()) corner.uv = glm::vec2(mesh.uvs[i]);
        out.corners.push_back(corner);
    }
    for (const MeshPiece& piece : piecesByLook(mesh, out.indices))
        out.pieces.push_back({piece.look, int(piece.first), int(piece.count)});
    return out;
}

// Nothing where it shows as its model.
SurfaceMesh meshOf(const Collider& collider) {
    const ColliderMesh mesh = colliderMesh(collider);
    SurfaceMesh out;
    out.origin = mesh.origin;
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        out.corners.push_back({mesh.positions[i], mesh.normals[i]});
    out.indices = mesh.corners;
    return out;
}

Pose poseOf(const std::optional<ColliderPath>& path, double time) {
    return path ? poseAt(*path, time) : Pose{};
}

glm::dvec3 placed(const Pose& pose, const glm::dvec3& x) {
    return pose.position + pose.rotation * x;
}

}  // namespace

static bool blended(const SurfaceMaterial& material) {
    return material.alpha == SurfaceMaterial::Alpha::blend;
}

// Whether its image has holes.
static bool cutOut(const SurfaceMaterial& material) {
    return material.alpha == SurfaceMaterial::Alpha::cut && material.colorImage >= 0;
}

// Whether the alpha of its image counts.
static bool hasHoles(const SurfaceMaterial& material) {
    return material.alpha != SurfaceMaterial::Alpha::opaque && material.colorImage >= 0;
}

static bool refracting(const SurfaceMaterial& material) {
    return blended(material) && material.refraction > 1;
}

bool SurfaceDrawer::blends(const Scene& scene) {
    return std::any_of(scene.models.begin(), scene.models.end(), [](const Model& model) {
        return model.draw && std::any_of(model.mesh.materials.begin(), model.mesh.materials.end(), blended);
    });
}

static gpu::Texture imageTexture(gpu::Context& context, Image image, bool srgb, const std::string& label) {
    turnOver(image);
    gpu::Texture texture(context, srgb ? gpu::Format::srgb8a8 : gpu::Format::rgba8, image.width, image.height,
                         label.c_str());
    texture.upload(gpu::Traffic::Kind::parameters, 0, 0, image.width, image.height, image.pixels.data(),
                   image.pixels.size());
    texture.setLinear(true, true);
    return texture;
}

static std::optional<Box> boundsIfClosed(const Mesh& mesh) {
    const bool opaque = std::all_of(
        mesh.materials.begin(), mesh.materials.end(),
        [](const SurfaceMaterial& material) { return material.alpha == SurfaceMaterial::Alpha::opaque; });
    if (!opaque) return std::nullopt;
    const SurfaceReport report = examineSurface(mesh);
    if (!report.closed() || report.volume <= 0) return std::nullopt;
    return Box{mesh.low, mesh.high};
}

SurfaceDrawer::Drawn SurfaceDrawer::drawnModel(gpu::Context& context, const Model& model) {
    Drawn drawn;
    if (context.info().software) drawn.closed = boundsIfClosed(model.mesh);
    drawn.detail = float(model.grain);
    drawn.stony = model.grainOf == GrainKind::stone;
    const Mesh& mesh = model.mesh;
    std::vector<bool> colors(mesh.images.size());
    for (const SurfaceMaterial& material : mesh.materials)
        for (const int image : {material.colorImage, material.emissiveImage})
            if (image >= 0) colors[size_t(image)] = true;
    for (size_t i = 0; i < mesh.images.size(); ++i)
        drawn.images.push_back(imageTexture(context, mesh.images[i], colors[i], model.name));
    return drawn;
}

SurfaceDrawer::SurfaceDrawer(gpu::Context& context, const Scene& scene, const Lighting& lighting,
                             bool shadows, bool grid)
    : shadows_(shadows), grid_(grid) {
    for (const Model& model : scene.models) {
        if (!model.draw || model.mesh.triangles.empty()) continue;
        Drawn drawn = drawnModel(context, model);
        const SurfaceMesh mesh = meshOf(model.mesh);
        std::optional<double> thickness;
        for (const SurfaceMesh::Piece& piece : mesh.pieces) {
            Look look;
            if (piece.material >= 0) look.material = model.mesh.materials[size_t(piece.material)];
            look.material.color *= glm::dvec4(model.color, 1);
            if (model.roughness) look.material.roughness = *model.roughness;
            if (refracting(look.material)) {
                if (!thickness) thickness = medianThickness(model.mesh);
                look.plate = *thickness;
                refracts_ = true;
            }
            look.firstIndex = piece.firstIndex;
            look.indexCount = piece.indexCount;
            drawn.looks.push_back(look);
        }
        add(context, mesh, std::move(drawn), model.name.c_str());
    }
    models_ = surfaces_.size();
    changeColliders(context, scene.colliders, lighting);
}

void SurfaceDrawer::changeColliders(gpu::Context& context, const std::vector<Collider>& colliders,
                                    const Lighting& lighting) {
    surfaces_.erase(surfaces_.begin() + ptrdiff_t(models_), surfaces_.end());
    for (const Collider& collider : colliders) {
        if (!collider.draw) continue;
        const SurfaceMesh mesh = meshOf(collider);
        if (mesh.indices.empty()) continue;
        Drawn drawn;
        Look look;
        look.material.color = glm::dvec4(collider.color, 1);
        look.indexCount = int(mesh.indices.size());
        drawn.path = collider.path;
        if (const auto* plane = kindOf<PlaneCollider>(*collider.shape)) {
            drawn.plane = *plane;
            drawn.casts = false;
            drawn.detail = grid_ ? 0.35f : 0.9f;
        } else {
            look.material.roughness = 0.5;
        }
        drawn.looks.push_back(look);
        add(context, mesh, std::move(drawn), collider.name.c_str());
    }
    choosePrograms(context, lighting);
}

void SurfaceDrawer::add(gpu::Context& context, const SurfaceMesh& mesh, Drawn drawn, const char* label) {
    using Corner = SurfaceMesh::Corner;
    drawn.origin = mesh.origin;
    for (Look& look : drawn.looks) {
        glm::vec3 low(INFINITY), high(-INFINITY);
        for (int i = 0; i < look.indexCount; ++i) {
            const glm::vec3& corner = mesh.corners[mesh.indices[size_t(look.firstIndex + i)]].position;
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        look.middle = 0.5f * (low + high);
        blends_ = blends_ || blended(look.material);
    }
    drawn.corners =
        gpu::Buffer(context, gpu::Buffer::Use::vertex, std::span<const Corner>(mesh.corners), label);
    drawn.indices =
        gpu::Buffer(context, gpu::Buffer::Use::index, std::span<const uint32_t>(mesh.indices), label);
    drawn.array = gpu::VertexArray(context, label);
    drawn.array.attribute(0, drawn.corners, 3, sizeof(Corner), offsetof(Corner, position));
    drawn.array.attribute(1, drawn.corners, 3, sizeof(Corner), offsetof(Corner, normal));
    drawn.array.attribute(2, drawn.corners, 3, sizeof(Corner), offsetof(Corner, color));
    drawn.array.attribute(3, drawn.corners, 2, sizeof(Corner), offsetof(Corner, uv));
    drawn.array.indices(drawn.indices);
    surfaces_.push_back(std::move(drawn));
}

// A program for each set of images and looks that a material has.
void SurfaceDrawer::choosePrograms(gpu::Context& context, const Lighting& lighting) {
    for (Drawn& surface : surfaces_) {
        for (Look& look : surface.looks) {
            const SurfaceMaterial& material = look.material;
            gpu::ProgramOptions lit{
                "render/surface.vert", "render/surface.frag", lighting.defines(), {}, "surfaces"};
            lit.defines.insert(
                lit.defines.end(),
                {gpu::constant("PLANE", surface.plane.has_value()), gpu::constant("GRID", grid_),
                 gpu::constant("METALLIC", material.metallic > 0),
                 gpu::constant("GRAINY", surface.detail > 0), gpu::constant("STONY", surface.stony),
                 gpu::constant("COLOR_IMAGE", material.colorImage >= 0),
                 gpu::constant("NORMAL_IMAGE", material.normalImage >= 0),
                 gpu::constant("ROUGHNESS_IMAGE", material.roughnessImage >= 0),
                 gpu::constant("EMISSIVE_IMAGE", material.emissiveImage >= 0),
                 gpu::constant("CUT", cutOut(material)), gpu::constant("REFRACTS", refracting(material))});
            if (surface.plane) lit.label = "planes";
            look.lit = &programs_.get(context, lit);
            if (!shadows_ || !surface.casts) continue;
            look.depth = &programs_.get(context, {"render/surface.vert",
                                                  "render/surface_shadow.frag",
                                                  {gpu::constant("HOLES", hasHoles(material)),
                                                   gpu::constant("BLENDED", blended(material))},
                                                  {},
                                                  "surface depth"});
        }
    }
}

void SurfaceDrawer::submit(const Drawn& surface, const Look& look) const {
    surface.array.bind();
    gpu::beginPass();
    glDrawElements(GL_TRIANGLES, look.indexCount, GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(size_t(look.firstIndex) * sizeof(uint32_t)));
}

bool SurfaceDrawer::castsStill() const {
    return std::any_of(surfaces_.begin(), surfaces_.end(), [](const Drawn& surface) {
        return !surface.path && std::any_of(surface.looks.begin(), surface.looks.end(),
                                            [](const Look& look) { return look.depth != nullptr; });
    });
}

void SurfaceDrawer::drawShadows(const ShadowMap& shadow, std::optional<double> time) const {
    for (const Drawn& surface : surfaces_) {
        if (surface.path.has_value() != time.has_value()) continue;
        const Pose pose = poseOf(surface.path, time.value_or(0));
        for (const Look& look : surface.looks) {
            if (!look.depth) continue;
            const gpu::Program& program = *look.depth;
            program.use();
            program.set("toClip", shadow.toClip());
            program.set("meshTurn", glm::mat3(glm::mat3_cast(pose.rotation)));
            program.set("meshOrigin", glm::vec3(placed(pose, surface.origin) - shadow.origin().exact));
            program.set("meshScale", 1.0f);
            if (hasHoles(look.material))
                program.texture("image", surface.images[size_t(look.material.colorImage)]);
            if (cutOut(look.material)) program.set("alphaCut", float(look.material.alphaCut));
            if (hasHoles(look.material) || blended(look.material))
                program.set("meshColor", glm::vec4(look.material.color));
            submit(surface, look);
        }
    }
}

// The disc's middle is the foot of the eye on the plane; grain and grid stay where they are in the scene.
void SurfaceDrawer::placePlane(const gpu::Program& program, const PlaneCollider& plane,
                               const Eye& eye) const {
    const auto [foot, reach] = seenOf(plane, eye.origin.exact);
    const auto [along, across] = tangentsOf(glm::normalize(plane.normal));
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

void SurfaceDrawer::drawLook(const Drawn& surface, const Look& look, const Eye& eye, const Lighting& lighting,
                             double time) const {
    const gpu::Program& program = *look.lit;
    const SurfaceMaterial& material = look.material;
    program.use();
    lighting.apply(program, eye);
    program.set("toClip", eye.toClip);
    program.set("meshColor", glm::vec4(material.color));
    program.set("emissive", glm::vec3(material.emissive));
    program.set("roughness", float(material.roughness));
    program.set("metallic", float(material.metallic));
    program.set("detail", surface.detail);
    const auto image = [&](const char* name, int number) {
        if (number >= 0) program.texture(name, surface.images[size_t(number)]);
    };
    image("image", material.colorImage);
    image("normalImage", material.normalImage);
    image("roughnessImage", material.roughnessImage);
    image("emissiveImage", material.emissiveImage);
    if (material.normalImage >= 0) program.set("normalScale", float(material.normalScale));
    if (cutOut(material)) program.set("alphaCut", float(material.alphaCut));
    const Pose pose = poseOf(surface.path, time);
    program.set("meshTurn", glm::mat3(glm::mat3_cast(pose.rotation)));
    if (surface.plane) {
        placePlane(program, {placed(pose, surface.plane->point), pose.rotation * surface.plane->normal}, eye);
    } else {
        program.set("meshOrigin", glm::vec3(placed(pose, surface.origin) - eye.origin.exact));
        program.set("meshScale", 1.0f);
        program.set("grainOffset", glm::vec3(0));
    }
    submit(surface, look);
}

// Whether the near plane, too, lies outside of a box, in a view of up to 140 degrees across corners.
static bool outside(const Box& box, const Eye& eye) {
    const glm::dvec3 x = eye.origin.exact, margin(3.0 * eye.nearest);
    return glm::any(glm::lessThan(x, box.low - margin)) || glm::any(glm::greaterThan(x, box.high + margin));
}

void SurfaceDrawer::draw(const Eye& eye, const Lighting& lighting, double time, bool multisampled) const {
    for (const Drawn& surface : surfaces_) {
        const bool culls = surface.closed && outside(*surface.closed, eye);
        if (culls) glEnable(GL_CULL_FACE);
        for (const Look& look : surface.looks) {
            if (blended(look.material)) continue;
            const bool covers = multisampled && cutOut(look.material);
            if (covers) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
            drawLook(surface, look, eye, lighting, time);
            if (covers) glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
        }
        if (culls) glDisable(GL_CULL_FACE);
    }
}

void SurfaceDrawer::drawBlended(const Eye& eye, const Lighting& lighting, double time,
                                const Behind& behind) const {
    struct Far {
        double distance;
        const Drawn* surface;
        const Look* look;
    };
    std::vector<Far> order;
    for (const Drawn& surface : surfaces_)
        for (const Look& look : surface.looks)
            if (blended(look.material))
                order.push_back(
                    {glm::distance(placed(poseOf(surface.path, time), surface.origin + look.middle),
                                   eye.origin.exact),
                     &surface, &look});
    std::stable_sort(order.begin(), order.end(),
                     [](const Far& a, const Far& b) { return a.distance > b.distance; });
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_CULL_FACE);
    for (const Far& far : order) {
        if (refracting(far.look->material)) applyGlass(*far.look, eye, behind);
        // A closed surface has all that faces away from the eye behind what faces it.
        for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
            glCullFace(hidden);
            drawLook(*far.surface, *far.look, eye, lighting, time);
        }
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
}

void SurfaceDrawer::applyGlass(const Look& look, const Eye& eye, const Behind& behind) const {
    const gpu::Program& program = *look.lit;
    program.use();
    program.texture("lightBehind", *behind.light);
    program.texture("sceneDepth", *behind.depth);
    program.set("nearest", eye.nearest);
    program.set("viewToScene", eye.viewToScene);
    program.set("tangents", eye.tangents);
    program.set("refraction", float(look.material.refraction));
    program.set("plate", float(look.plate));
}

}  // namespace shoal
