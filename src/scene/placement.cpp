// Where the molecules of a group start.
//
// A host gives each molecule a point and an axis; the molecule's +Y goes along the axis. The rotation is
//   tilt * bend * arc * yaw
// from right to left: turned about +Y, laid along the axis by the shortest arc, drooped, tipped.
// Every instance draws from a stream of its own, seeded from (scene.seed, group, instance): a larger count
// leaves the instances before it as they were.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/describe.h"
#include "core/parallel.h"
#include "core/random.h"
#include "scene/json/reader.h"
#include "scene/scene.h"
#include "scene/selection.h"

namespace shoal {

const Description& describe(const Placement::Item*) {
    using Item = Placement::Item;
    static const Description description =
        Describe<Item>("item", "Where one molecule stands.")
            .key("position", &Item::position, {"m", "Where it is."})
            .rotation("rotation", &Item::rotation, {"", "How it is turned."})
            .key("scale", &Item::scale, {"", "Its size.", aboveZero()});
    return description;
}

const Description& describe(const Placement*) {
    using P = Placement;
    static const auto readModel = [](JsonReader& r, P& place, const SceneReading* reading) {
        place.model = needModel(r, "model", reading->models);
    };
    static const auto derive = [](P& place, const Where& where) {
        if (!where.given("align") && place.onModel()) place.align = P::Align::normal;
        if (!where.given("turn") && place.kind == P::Kind::list) place.turn = P::Turn::none;
    };
    static const auto rule = [](const P& place, const Where& where) {
        if (place.align == P::Align::normal && !place.onModel())
            throw Error(where.locate("align"),
                        "align \"normal\" needs a model to sit on (on \"vertices\" or \"surface\")");
    };
    static const Description description =
        Describe<P>("place", "Where molecules start, and how they stand.")
            .word("on", &P::kind, {"vertices", "surface", "volume", "grid", "list"},
                  {"",
                   "Random vertices of a model, or points of a cloud, each once before any twice; random "
                   "points of its surface, "
                   "evenly by area; random points of a box; a grid, x fastest, then y, then z; or a list."})
            .needed()
            .byHand<const SceneReading>("model", {}, {"the name of a model", "The model."}, readModel)
            .needed()
            .only("on", {"vertices", "surface"})
            .key("select", &P::select, {"", "Which part of the model; all of it without."})
            .only("on", {"vertices", "surface"})
            .box("box", &P::box, {"m", "The box, which may be flat."}, true)
            .needed()
            .only("on", {"volume"})
            .key("origin", &P::origin, {"m", "The first place of the grid."})
            .only("on", {"grid"})
            .key("spacing", &P::spacing, {"m", "The distances between places along x, y and z."})
            .needed()
            .only("on", {"grid"})
            .key("cells", &P::cells,
                 {"", "How many there are along x, y and z.", Range::between(1, maxGroupCount)})
            .needed()
            .only("on", {"grid"})
            .key("items", &P::items, {"", "One molecule an item; `align` does not change how they stand."})
            .needed()
            .only("on", {"list"})
            .word(
                "align", &P::align, {"none", "up", "normal"},
                {"", "The axis that the molecule's +Y follows: its own, straight up, or the model's normal."})
            .usually("`\"normal\"` on vertices and surfaces, else `\"none\"`")
            .word("turn", &P::turn, {"none", "yaw", "any"},
                  {"",
                   "A random turn about that axis, or any rotation at all, which leaves `tilt` and `droop` "
                   "without effect."})
            .usually("`\"none\"` for lists, else `\"yaw\"`")
            .key("droop", &P::droop,
                 {"", "The share of the way to straight down that the axis is bent.", Range::between(0, 1)})
            .key("tilt", &P::tilt,
                 {"rad", "The most by which it is then tipped in a random direction.",
                  Range::between(0, 3.141592653589794)})
            .span("scale", &P::scale, {"", "The size, random between the two.", aboveZero()})
            .key("offset", &P::offset, {"m", "How far it is moved along the axis, before that is bent."})
            .derive(derive)
            .rule(rule);
    return description;
}

namespace {

constexpr double pi = std::numbers::pi;
glm::dvec3 up() {
    return {0, 1, 0};
}

// splitmix64's finaliser [Steele 2014].
uint64_t mix(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

uint64_t streamOf(uint64_t seed, uint64_t group, uint64_t counter) {
    return mix(mix(mix(seed + 0x9E3779B97F4A7C15u) + group * 0xD1342543DE82EF95u + 1) +
               counter * 0x9E3779B97F4A7C15u);
}

glm::dquat about(const glm::dvec3& axis, double angle) {
    return glm::angleAxis(angle, axis);
}

// A unit vector at right angles to `axis`.
glm::dvec3 across(const glm::dvec3& axis) {
    return glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? up() : glm::dvec3(1, 0, 0)));
}

// The shortest rotation that takes unit a to unit b; half a turn about `fallback` when they are opposite.
glm::dquat arc(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& fallback) {
    const double cosine = glm::dot(a, b);
    if (cosine < -1 + 1e-12) return about(fallback, pi);
    const glm::dvec3 axis = glm::cross(a, b);
    return glm::normalize(glm::dquat(1 + cosine, axis.x, axis.y, axis.z));
}

// Shoemake's uniform random rotation [Shoemake 1992].
glm::dquat anyRotation(Random& random) {
    const double u = random.uniform(), v = 2 * pi * random.uniform(), w = 2 * pi * random.uniform();
    const double a = std::sqrt(1 - u), b = std::sqrt(u);
    return {b * std::cos(w), a * std::sin(v), a * std::cos(v), b * std::sin(w)};
}

struct Host {
    glm::dvec3 position{0};
    glm::dvec3 normal{0, 1, 0};
    glm::dquat rotation{1, 0, 0, 0};  // a list's own
    double scale = 1;
};

// Hands out hosts by instance number.
class Hosts {
  public:
    Hosts(const Scene& scene, size_t group) : group_(scene.groups[group]), place_(group_.place) {
        if (!place_.onModel()) return;
        model_ = &scene.models.at(size_t(place_.model));
        selected_ = select(model_->mesh, place_.select);
        if (place_.kind == Placement::Kind::vertices)
            shuffle(streamOf(scene.seed, group, ~uint64_t{0}));
        else
            accumulateAreas();
    }

    Host host(size_t instance, Random& random) const {
        switch (place_.kind) {
        case Placement::Kind::vertices:
            return onVertex(instance);
        case Placement::Kind::surface:
            return onSurface(random);
        case Placement::Kind::volume:
            return inVolume(random);
        case Placement::Kind::grid:
            return onGrid(instance);
        case Placement::Kind::list:
            break;
        }
        const Placement::Item& item = place_.items[instance % place_.items.size()];
        return {item.position, item.rotation * up(), item.rotation, item.scale};
    }

  private:
    Error nothing(const std::string& what) const {
        return Error(group_.location, "nothing of model \"", model_->name, "\" matches the selection, ", what,
                     " to place molecules on: ", selected_.report);
    }

    // Fisher and Yates: the first n are a random choice of n distinct vertices. A count above the number
    // of vertices goes round again.
    void shuffle(uint64_t stream) {
        if (selected_.vertices.empty()) throw nothing("expected vertices");
        Random random(stream);
        std::vector<int>& vertices = selected_.vertices;
        for (size_t i = 0; i + 1 < vertices.size(); ++i) {
            const double left = static_cast<double>(vertices.size() - i);
            const size_t j = i + static_cast<size_t>(random.uniform() * left);
            std::swap(vertices[i], vertices[std::min(j, vertices.size() - 1)]);
        }
    }

    void accumulateAreas() {
        double sum = 0;
        for (const int t : selected_.triangles)
            areas_.push_back(sum += glm::length(areaVector(t)));
        if (!(sum > 0)) throw nothing("expected triangles with an area");
    }

    const glm::dvec3& corner(int triangle, int i) const {
        return model_->mesh.positions[size_t(model_->mesh.triangles[size_t(triangle)][i])];
    }
    glm::dvec3 areaVector(int t) const {
        return glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    }

    Host onVertex(size_t instance) const {
        const size_t v = size_t(selected_.vertices[instance % selected_.vertices.size()]);
        return {model_->mesh.weldedPositions[v], model_->mesh.weldedNormals[v], {1, 0, 0, 0}, 1};
    }

    Host onSurface(Random& random) const {
        const double area = random.uniform() * areas_.back();
        const auto found = std::upper_bound(areas_.begin(), areas_.end(), area);
        const auto last = areas_.end() - 1;
        const int t = selected_.triangles[size_t(std::min(found, last) - areas_.begin())];
        // Uniform over the triangle [Turk 1990].
        const double root = std::sqrt(random.uniform()), v = random.uniform();
        const glm::dvec3 position =
            (1 - root) * corner(t, 0) + root * (1 - v) * corner(t, 1) + root * v * corner(t, 2);
        const glm::dvec3 normal = areaVector(t);
        const double length = glm::length(normal);
        return {position, length > 0 ? normal / length : up(), {1, 0, 0, 0}, 1};
    }

    Host inVolume(Random& random) const {
        const double x = random.uniform(), y = random.uniform(), z = random.uniform();
        return {glm::mix(place_.box.low, place_.box.high, glm::dvec3(x, y, z)), up(), {1, 0, 0, 0}, 1};
    }

    // x fastest, then y, then z; a count above the product goes on along z.
    Host onGrid(size_t instance) const {
        const size_t columns = size_t(place_.cells.x), rows = size_t(place_.cells.y);
        const size_t row = instance / columns, layer = row / rows;
        const glm::dvec3 cell(double(instance % columns), double(row % rows), double(layer));
        return {place_.origin + cell * place_.spacing, up(), {1, 0, 0, 0}, 1};
    }

    const Group& group_;
    const Placement& place_;
    const Model* model_ = nullptr;
    Selected selected_;
    std::vector<double> areas_;  // running sums over the selected triangles
};

Instance orient(const Placement& place, const Host& host, Random& random) {
    // Drawn in a fixed order and always, so that changing one setting leaves the others' values alone.
    const glm::dquat any = anyRotation(random);
    const double yaw = 2 * pi * random.uniform(), heading = 2 * pi * random.uniform();
    const double tipped = place.tilt * random.uniform(), tipHeading = 2 * pi * random.uniform();
    const double size = glm::mix(place.scale.x, place.scale.y, random.uniform());

    const bool list = place.kind == Placement::Kind::list;
    const glm::dvec3 axis = list || place.align == Placement::Align::normal ? host.normal : up();
    const glm::dvec3 heads(std::cos(heading), 0, std::sin(heading));
    glm::dquat rotation = list ? host.rotation : arc(up(), axis, heads);
    if (place.turn == Placement::Turn::any) {
        rotation = any;
    } else {
        if (place.turn == Placement::Turn::yaw) rotation = rotation * about(up(), yaw);
        if (place.droop > 0) {
            const double toDown = std::acos(glm::clamp(-axis.y, -1.0, 1.0));
            const glm::dvec3 hinge = glm::cross(axis, -up());
            const double length = glm::length(hinge);
            // Straight up there is no way that leads down: the random heading picks one.
            if (length > 1e-9)
                rotation = about(hinge / length, place.droop * toDown) * rotation;
            else if (axis.y > 0)
                rotation = about(heads, place.droop * pi) * rotation;
        }
        if (tipped > 0) {
            const glm::dvec3 along = rotation * up(), side = across(along);
            rotation = about(about(along, tipHeading) * side, tipped) * rotation;
        }
    }

    Instance instance;
    instance.position = host.position + axis * place.offset;
    instance.rotation = glm::normalize(rotation);
    instance.scale = host.scale * size;
    return instance;
}

}  // namespace

void forEachInstance(const Scene& scene, size_t group,
                     const std::function<void(size_t, const Instance&)>& visit) {
    const Group& g = scene.groups.at(group);
    if (g.place.kind == Placement::Kind::list && g.place.items.empty())
        throw Error(g.location, "the list of places is empty, expected at least one item");
    const Hosts hosts(scene, group);
    const size_t count = size_t(std::max(g.count, 0));
    constexpr size_t piece = 1 << 14;
    parallel(int((count + piece - 1) / piece), allThreads(), [&](int number) {
        const size_t first = size_t(number) * piece;
        for (size_t i = first; i < std::min(first + piece, count); ++i) {
            const uint64_t stream = streamOf(scene.seed, group, i);
            Random random(stream);
            const Host host = hosts.host(i, random);
            Instance instance = orient(g.place, host, random);
            instance.seed = static_cast<uint32_t>(mix(stream) >> 32);
            visit(i, instance);
        }
    });
}

std::vector<Instance> place(const Scene& scene, size_t group) {
    std::vector<Instance> out(size_t(std::max(scene.groups.at(group).count, 0)));
    forEachInstance(scene, group, [&](size_t i, const Instance& instance) { out[i] = instance; });
    return out;
}

}  // namespace shoal
