#include "app/check_start.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/generate.h"
#include "reference/colliders.h"

namespace shoal::app {

namespace {

constexpr size_t mostLookedAt = 2000;  // molecules of a group, vertices of a model
// m: what contact leaves, and rounding, is no mistake. Deeper than this a molecule is pushed out before one's
// eyes.
constexpr double deepEnough = 1e-3;

// The share of a group from which to warn. Some of the molecules that are scattered over a surface or a
// volume always start inside a collider, and come out unseen.
constexpr double fewInside = 0.05;

glm::dvec3 positionOf(const GroupPlan& group, size_t molecule, size_t vertex) {
    const GroupState& state = group.start;
    return glm::dvec3(state.anchors[molecule]) +
           glm::dvec3(state.positions[molecule * size_t(group.vertexCount) + vertex]);
}

// Calls look(molecule) for evenly chosen molecules that are there at the start.
template <typename Look>
void forSome(const GroupPlan& group, const Look& look) {
    const size_t count = group.start.anchors.size(), step = std::max<size_t>(1, count / mostLookedAt);
    for (size_t m = 0; m < count; m += step)
        if (group.start.lives.empty() || group.start.lives[m].y > 0) look(m);
}

void findInside(const Scene& scene, const GroupPlan& group, std::vector<Warning>& out) {
    const reference::RestSurfaces surfaces(scene.colliders);
    for (size_t c = 0; c < surfaces.count(); ++c) {
        size_t inside = 0, looked = 0;
        forSome(group, [&](size_t m) {
            bool whole = true;  // what only dips in will lie on it
            for (size_t v = 0; v < size_t(group.vertexCount) && whole; ++v)
                whole = surfaces.at(c, positionOf(group, m, v)).distance < -deepEnough;
            ++looked;
            inside += whole;
        });
        if (inside == 0 || double(inside) < fewInside * double(looked)) continue;
        const std::string& name = scene.colliders[c].name;
        out.push_back(
            {group.location,
             concat(looked < group.start.anchors.size() ? concat(inside, " of the ", looked, " looked at")
                                                        : concat(inside, " of ", looked),
                    " molecules of \"", group.name, "\" start inside the ",
                    kindName(scene.colliders[c].shape), name.empty() ? "" : concat(" \"", name, "\""),
                    ", which pushes them out: move one or the other")});
    }
}

// Whether the camera has x in its picture, 16 wide and 9 high.
class Sight {
  public:
    explicit Sight(const Camera& camera) : eye_(camera.eye) {
        forward_ = glm::normalize(camera.target - camera.eye);
        const glm::dvec3 up = std::abs(forward_.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        right_ = glm::normalize(glm::cross(forward_, up));
        high_ = std::tan(camera.fieldOfView / 2);
    }
    bool has(const glm::dvec3& x) const {
        const glm::dvec3 d = x - eye_;
        const double depth = glm::dot(d, forward_);
        return depth > 0 && std::abs(glm::dot(d, glm::cross(right_, forward_))) <= high_ * depth &&
               std::abs(glm::dot(d, right_)) <= high_ * depth * 16 / 9;
    }

  private:
    glm::dvec3 eye_, forward_, right_;
    double high_ = 0;
};

bool seesAnything(const Scene& scene, const Plan& plan) {
    const Sight sight(scene.camera);
    bool seen = false;
    for (const GroupPlan& group : plan.groups) {
        forSome(group, [&](size_t m) { seen = seen || sight.has(positionOf(group, m, 0)); });
        if (!group.life) continue;
        const std::vector<Emitter>& emitters = group.life->cycle.emitters;
        for (size_t i = 0; i < emitters.size() && i < group.life->middles.size(); ++i)  // deaths are anywhere
            seen = seen || emitters[i].from == Emitter::From::death || sight.has(group.life->middles[i]);
    }
    for (const Model& model : scene.models) {
        const auto& points = model.mesh.positions;
        for (size_t i = 0; i < points.size() && model.draw && !seen; i += points.size() / mostLookedAt + 1)
            seen = sight.has(glm::dvec3(points[i]));
    }
    return seen;
}

}  // namespace

std::vector<Warning> checkStart(const Scene& scene, const Plan& plan) {
    std::vector<Warning> out;
    for (const GroupPlan& group : plan.groups)
        if (group.needs.collide) findInside(scene, group, out);
    if (!seesAnything(scene, plan))
        out.push_back(
            {{scene.file, 0, 0, "$.camera"},
             "the camera sees no molecule, emitter or model at the start: turn its \"target\" towards them"});
    return out;
}

}  // namespace shoal::app
