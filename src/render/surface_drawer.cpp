#include "render/surface_drawer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "render/picture.h"

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
        if (!mesh.uvs.empty()) corner.uv = glm::vec2(mesh.uvs[i]);
        out.corners.push_back(corner);
    }
    for (const MeshPiece& piece : piecesByLook(mesh, out.indices))
        out.pieces.push_back({piece.look, int(piece.first), int(piece.count)});
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
        return SurfaceMesh::Corner{glm::vec3(sphere.radius * n), glm::vec3(n)};
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
                out.corners.push_back({glm::vec3(turn * place), glm::vec3(turn * n)});
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
        return SurfaceMesh::Corner{glm::vec3(capsule.radius * n + (far ? span : glm::dvec3(0))),
                                   glm::vec3(n)};
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
        return SurfaceMesh::Corner{glm::vec3(place), glm::vec3(normal)};
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

static bool blended(const SurfaceMaterial& material) {
    return material.alpha == SurfaceMaterial::Alpha::blend;
}

// Whether its image has holes.
static bool cutOut(const SurfaceMaterial& material) {
    return material.alpha == SurfaceMaterial::Alpha::cut && material.colorImage >= 0;
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

SurfaceDrawer::Drawn SurfaceDrawer::drawnModel(gpu::Context& context, const Model& model) {
    Drawn drawn;
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
                             const ShadowMap* shadow, bool grid) {
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
    for (const Collider& collider : scene.colliders) {
        if (!collider.draw) continue;
        const SurfaceMesh mesh = std::visit([](const auto& kind) { return meshOf(kind); }, *collider.shape);
        if (mesh.indices.empty()) continue;
        Drawn drawn;
        Look look;
        look.material.color = glm::dvec4(collider.color, 1);
        look.indexCount = int(mesh.indices.size());
        drawn.path = collider.path;
        if (const auto* plane = std::get_if<PlaneCollider>(&*collider.shape)) {
            drawn.plane = *plane;
            drawn.casts = false;
            drawn.detail = grid ? 0.35f : 0.9f;
        } else {
            look.material.roughness = 0.5;
        }
        drawn.looks.push_back(look);
        add(context, mesh, std::move(drawn), collider.name.c_str());
    }
    choosePrograms(context, lighting, shadow != nullptr, grid);
}

void SurfaceDrawer::add(gpu::Context& context, const SurfaceMesh& mesh, Drawn drawn, const char* label) {
    using Corner = SurfaceMesh::Corner;
    drawn.origin = mesh.origin;
    for (Look& look : drawn.looks) {
        glm::vec3 low(INFINITY), high(-INFINITY);
        for (int i = 0; i < look.indexCount; ++i) {
            const glm::vec3& at = mesh.corners[mesh.indices[size_t(look.firstIndex + i)]].position;
            low = glm::min(low, at);
            high = glm::max(high, at);
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

// A program for each set of images that a material has.
void SurfaceDrawer::choosePrograms(gpu::Context& context, const Lighting& lighting, bool shadows, bool grid) {
    for (Drawn& surface : surfaces_) {
        for (Look& look : surface.looks) {
            const SurfaceMaterial& material = look.material;
            gpu::ProgramOptions lit{
                "render/surface.vert", "render/surface.frag", lighting.defines(), {}, "surfaces"};
            const auto define = [&](bool needed, const char* name) {
                if (needed) lit.defines.emplace_back(name);
            };
            define(surface.plane.has_value(), "PLANE");
            define(material.colorImage >= 0, "COLOR_IMAGE");
            define(material.normalImage >= 0, "NORMAL_IMAGE");
            define(material.roughnessImage >= 0, "ROUGHNESS_IMAGE");
            define(material.emissiveImage >= 0, "EMISSIVE_IMAGE");
            define(std::max({material.colorImage, material.normalImage, material.roughnessImage,
                             material.emissiveImage}) >= 0,
                   "IMAGES");
            define(cutOut(material), "CUT");
            define(refracting(material), "REFRACTS");
            if (surface.plane) lit.label = "planes";
            look.lit = &programs_.get(context, lit);
            if (surface.plane) {
                look.lit->use();
                look.lit->set("grid", int(grid));
            }
            if (!shadows || !surface.casts || blended(material)) continue;
            gpu::ProgramOptions depth{
                "render/surface.vert", "render/surface_shadow.frag", {"DEPTH_ONLY"}, {}, "surface depth"};
            if (cutOut(material)) depth.defines.insert(depth.defines.end(), {"IMAGES", "CUT"});
            look.depth = &programs_.get(context, depth);
        }
    }
}

void SurfaceDrawer::submit(const Drawn& surface, const Look& look) const {
    surface.array.bind();
    glDrawElements(GL_TRIANGLES, look.indexCount, GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(size_t(look.firstIndex) * sizeof(uint32_t)));
}

void SurfaceDrawer::drawShadows(const ShadowMap& shadow, std::optional<double> time) const {
    for (const Drawn& surface : surfaces_) {
        if (surface.path && !time) continue;
        const Pose pose = poseOf(surface.path, time.value_or(0));
        for (const Look& look : surface.looks) {
            if (!look.depth) continue;
            const gpu::Program& program = *look.depth;
            program.use();
            program.set("toClip", shadow.toClip());
            program.set("meshTurn", glm::mat3(glm::mat3_cast(pose.rotation)));
            program.set("meshOrigin", glm::vec3(placed(pose, surface.origin) - shadow.origin().exact));
            program.set("meshScale", 1.0f);
            if (cutOut(look.material)) {
                program.texture("image", unit::image, surface.images[size_t(look.material.colorImage)]);
                program.set("alphaCut", float(look.material.alphaCut));
                program.set("meshColor", glm::vec4(look.material.color));
            }
            submit(surface, look);
        }
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
    program.set("stony", int(surface.stony));
    const auto image = [&](const char* name, int textureUnit, int number) {
        if (number >= 0) program.texture(name, textureUnit, surface.images[size_t(number)]);
    };
    image("image", unit::image, material.colorImage);
    image("normalImage", unit::normalImage, material.normalImage);
    image("roughnessImage", unit::roughnessImage, material.roughnessImage);
    image("emissiveImage", unit::emissiveImage, material.emissiveImage);
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

void SurfaceDrawer::draw(const Eye& eye, const Lighting& lighting, double time, bool multisampled) const {
    for (const Drawn& surface : surfaces_)
        for (const Look& look : surface.looks) {
            if (blended(look.material)) continue;
            const bool covers = multisampled && cutOut(look.material);
            if (covers) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
            drawLook(surface, look, eye, lighting, time);
            if (covers) glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
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
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glEnable(GL_CULL_FACE);
    for (const Far& one : order) {
        if (refracting(one.look->material)) applyGlass(*one.look, eye, behind);
        // A closed surface has all that faces away from the eye behind what faces it.
        for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
            glCullFace(hidden);
            drawLook(*one.surface, *one.look, eye, lighting, time);
        }
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
}

void SurfaceDrawer::applyGlass(const Look& look, const Eye& eye, const Behind& behind) const {
    const gpu::Program& program = *look.lit;
    program.use();
    program.texture("lightBehind", unit::light, *behind.light);
    program.texture("sceneDepth", unit::sceneDepth, *behind.depth);
    program.set("nearest", eye.nearest);
    program.set("viewToScene", eye.viewToScene);
    program.set("tangents", eye.tangents);
    program.set("refraction", float(look.material.refraction));
    program.set("plate", float(look.plate));
}

}  // namespace shoal
