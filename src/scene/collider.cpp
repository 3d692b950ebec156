#include "scene/collider_kinds.h"

#include <algorithm>
#include <cmath>

#include "core/describe.h"

namespace shoal {

template class Boxed<ColliderShape>;
template Boxed<ColliderShape>::Boxed(PlaneCollider);
template Boxed<ColliderShape>::Boxed(HeightFieldCollider);

template <typename Kind>
const Kind* kindOf(const ColliderShape& shape) {
    return std::get_if<Kind>(&shape);
}
template const PlaneCollider* kindOf(const ColliderShape&);
template const HeightFieldCollider* kindOf(const ColliderShape&);
template const DistanceFieldCollider* kindOf(const ColliderShape&);

// ---- The kinds

const Description& describe(const PlaneCollider*) {
    using C = PlaneCollider;
    static const Description description =
        Describe<C>("plane", "A plane, solid behind.")
            .key("point", &C::point, {"m", "A point of the plane."})
            .direction("normal", &C::normal, {"", "The direction of the free side."});
    return description;
}

GlslCall PlaneCollider::call() const {
    return GlslCall("planeSurface").apart(point).vector(glm::normalize(normal));
}

const Description& describe(const SphereCollider*) {
    using C = SphereCollider;
    static const Description description = Describe<C>("sphere", "A sphere.")
                                               .key("center", &C::center, {"m", "Its centre."})
                                               .needed()
                                               .key("radius", &C::radius, {"m", "Its radius.", aboveZero()})
                                               .needed();
    return description;
}

GlslCall SphereCollider::call() const {
    return GlslCall("sphereSurface").from(center).number(radius);
}

const Description& describe(const BoxCollider*) {
    using C = BoxCollider;
    static const Description description = Describe<C>("box", "A box.")
                                               .key("center", &C::center, {"m", "Its centre."})
                                               .needed()
                                               .key("size", &C::size, {"m", "Its whole edges.", aboveZero()})
                                               .needed()
                                               .rotation("rotation", &C::rotation, {"", "How it is turned."});
    return description;
}

GlslCall BoxCollider::call() const {
    return GlslCall("boxSurface").from(center).vector(size / 2.0).turned(rotation);
}

const Description& describe(const CapsuleCollider*) {
    using C = CapsuleCollider;
    static const Description description =
        Describe<C>("capsule", "All within a radius of a line between two points.")
            .key("from", &C::from, {"m", "One end of the line."})
            .needed()
            .key("to", &C::to, {"m", "The other end; where both coincide it is a sphere."})
            .needed()
            .key("radius", &C::radius, {"m", "The radius.", aboveZero()})
            .needed();
    return description;
}

// Returns a unit vector across an axis of any length.
static glm::dvec3 asideOf(const glm::dvec3& axis) {
    const glm::dvec3 size = glm::abs(axis);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    const glm::dvec3 out = glm::cross(axis / std::max({size.x, size.y, size.z, 1e-300}), other);
    return glm::length(out) > 0 ? glm::normalize(out) : glm::dvec3(0, 1, 0);
}

GlslCall CapsuleCollider::call() const {
    constexpr double leastAxis = 1e-9;  // m: ends that are nearer coincide
    glm::dvec3 along = to - from;
    if (glm::length(along) < leastAxis) along = {};
    const double squared = glm::dot(along, along);
    return GlslCall("capsuleSurface")
        .from(from)
        .axis(along, squared > 0 ? 1 / squared : 0)
        .vector(asideOf(along))
        .number(radius);
}

// Appends a texel a sample: the unit normal by central differences, and the height. `cell`: m.
static void appendHeights(const HeightFieldCollider& field, glm::dvec2 cell, std::vector<glm::vec4>& table) {
    const auto height = [&](int x, int z) {
        x = std::clamp(x, 0, field.columns - 1);
        z = std::clamp(z, 0, field.rows - 1);
        return double(field.heights[size_t(z) * size_t(field.columns) + size_t(x)]);
    };
    table.reserve(table.size() + field.heights.size());
    for (int z = 0; z < field.rows; ++z) {
        for (int x = 0; x < field.columns; ++x) {
            const double spanX = cell.x * (std::min(x + 1, field.columns - 1) - std::max(x - 1, 0));
            const double spanZ = cell.y * (std::min(z + 1, field.rows - 1) - std::max(z - 1, 0));
            const glm::dvec3 normal =
                glm::normalize(glm::dvec3((height(x - 1, z) - height(x + 1, z)) / spanX, 1,
                                          (height(x, z - 1) - height(x, z + 1)) / spanZ));
            table.emplace_back(glm::vec3(normal), float(height(x, z)));
        }
    }
}

GlslCall HeightFieldCollider::call() const {
    const glm::dvec2 cell = (high - low) / glm::dvec2(columns - 1, rows - 1);
    return GlslCall(sampledNormals ? "heightSurfaceSampled" : "heightSurfaceStored")
        .from({low.x, level, low.y})
        .four({1 / cell.x, cell.x, cell.y, 1 / cell.y})
        .text(concat("ivec2(", columns, ", ", rows, ")"))
        .samples([this, cell](std::vector<glm::vec4>& table) { appendHeights(*this, cell, table); });
}

// Appends the distances. Of sample (i, j, k) the 4-vector at (j * size.x + i) * size.z + k holds those of (i,
// j), (i + 1, j), (i, j + 1) and (i + 1, j + 1) in layer k, so that a cell is two 4-vectors that follow one
// another.
static void appendDistances(const DistanceField& field, std::vector<glm::vec4>& table) {
    const SampleGrid& grid = field.grid;
    table.reserve(table.size() + grid.count());
    for (int y = 0; y < grid.size.y; ++y)
        for (int x = 0; x < grid.size.x; ++x)
            for (int z = 0; z < grid.size.z; ++z) {
                const int right = std::min(x + 1, grid.size.x - 1), up = std::min(y + 1, grid.size.y - 1);
                table.emplace_back(
                    field.distances[grid.index(x, y, z)], field.distances[grid.index(right, y, z)],
                    field.distances[grid.index(x, up, z)], field.distances[grid.index(right, up, z)]);
            }
}

GlslCall DistanceFieldCollider::call() const {
    return GlslCall("distanceSurface")
        .from(field.grid.low)
        .cell(field.grid.cell)
        .four({glm::dvec3(field.grid.size - 1), field.outside})
        .samples([this](std::vector<glm::vec4>& table) { appendDistances(field, table); });
}

std::optional<double> reachOf(const ColliderShape& shape, const glm::dvec3& point) {
    return std::visit([&](const auto& kind) { return kind.reach(point); }, shape);
}

GlslCall callOf(const ColliderShape& shape) {
    return std::visit([](const auto& kind) { return kind.call(); }, shape);
}

// ---- Colliders

const Description& describe(const Collider*) {
    using C = Collider;
    static const auto rule = [](const C& collider, const Where& where) {
        if (where.given("surface") && collider.surface.empty())
            throw Error(where.locate("surface"), "expected the name of a surface, found an empty string");
    };
    static const Description description =
        Describe<C>("collider", "What molecules collide with.")
            .key("name", &C::name, {"", "Its name in messages and in the panel; no two have the same."})
            .key("thickness", &C::thickness,
                 {"m",
                  "The distance at which vertices rest from the surface, unless the radius of their contact "
                  "is larger.",
                  Range::atLeast(0)})
            .alternatives("type", &C::shape, {"", "Which solid it is."})
            .key("surface", &C::surface, {"", "What it is made of, for `surfacePairs`."})
            .key("restitution", &C::restitution,
                 {"", "The speed after a bounce, as a share of that before.", Range::between(0, 1)})
            .key("friction", &C::friction,
                 {"", "Coulomb's coefficient: the tangential change is at most this times the normal one.",
                  Range::atLeast(0)})
            .key("draw", &C::draw,
                 {"", "Whether it is drawn; height and distance fields show as their model."})
            .color("color", &C::color, {"", "Its colour."})
            .key("path", &C::path, {"", "How it moves; without a path it stands still."})
            .rule(rule, R"({"properties": {"surface": {"minLength": 1}}})");
    return description;
}

const Description& describe(const SurfaceRule*) {
    using S = SurfaceRule;
    static const auto readPair = [](JsonReader& r, S& pair, void*) {
        std::vector<std::string> between;
        r.need("between", between);
        if (between.size() != 2)
            throw Error(r.locate("between"),
                        concat("expected the names of two surfaces, found ", between.size()));
        pair.a = between[0];
        pair.b = between[1];
    };
    static const auto rule = [](const S& pair, const Where& where) {
        if (!pair.restitution && !pair.friction)
            throw Error(where.here(), "expected a \"restitution\" or a \"friction\" between the two");
    };
    static const Description description =
        Describe<S>("surfacePair",
                    "Restitution and friction between two surfaces, in place of a collider's own.")
            .byHand("between", {.lists = {{2, 2}}, .notEmpty = true},
                    {"the names of two surfaces", "The two surfaces, in any order."}, readPair)
            .needed()
            .key("restitution", &S::restitution,
                 {"", "The speed after a bounce, as a share of that before.", Range::between(0, 1)})
            .key("friction", &S::friction, {"", "Coulomb's coefficient.", Range::atLeast(0)})
            .rule(rule, R"({"anyOf": [{"required": ["restitution"]}, {"required": ["friction"]}]})");
    return description;
}

size_t kindIndex(const ColliderShape& shape) {
    return shape.index();
}

std::optional<double> supportOf(const ColliderShape& shape, const glm::dvec3& direction) {
    return std::visit([&](const auto& kind) { return kind.support(direction); }, shape);
}

std::optional<double> girthOf(const ColliderShape& shape) {
    return std::visit([](const auto& kind) { return kind.girth(); }, shape);
}

ReadingCost costOf(const ColliderShape& shape) {
    return std::visit([](const auto& kind) { return kind.cost; }, shape);
}

const char* kindName(const ColliderShape& shape) {
    return std::visit([](const auto& kind) { return describe(&kind).name().c_str(); }, shape);
}

}  // namespace shoal
