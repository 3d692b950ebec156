#include <algorithm>
#include <limits>

#include "compile/plan.h"
#include "render/lighting.h"
#include "scene/known_colliders.h"

namespace shoal {

static const Box emptyBox{glm::dvec3(std::numeric_limits<double>::infinity()),
                          glm::dvec3(-std::numeric_limits<double>::infinity())};

static void include(Box& box, const glm::dvec3& low, const glm::dvec3& high) {
    box.low = glm::min(box.low, low);
    box.high = glm::max(box.high, high);
}

static bool isEmpty(const Box& box) {
    return !(box.low.x <= box.high.x);
}

// Returns the bounds of a group's start state. Molecules are followed by their first vertex and padded by
// their size.
static Box boundsOf(const GroupPlan& group) {
    Box box = emptyBox;
    const size_t vertices = size_t(group.vertexCount);
    for (size_t m = 0; m < group.start.anchors.size(); ++m) {
        if (group.life && group.start.lives[m].y <= 0) continue;
        const glm::dvec3 place =
            glm::dvec3(group.start.anchors[m]) + glm::dvec3(group.start.positions[m * vertices]);
        include(box, place, place);
    }
    box.low -= group.size;
    box.high += group.size;
    return box;
}

static void includePlaced(Box& out, const Box& box, const Pose& pose) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 place = pose.position + pose.rotation * glm::mix(box.low, box.high, side);
        include(out, place, place);
    }
}

// Where an emitter's newborn go: as far as they are thrown, for a few seconds at most.
static Box reachOf(const Scene& scene, const Lifecycle& life, const Emitter& emitter) {
    if (emitter.from == Emitter::From::death) return emptyBox;
    Box out = placeOf(emitter, scene.models).box;
    constexpr double seconds = 3;
    const double speed = emitter.speed.y, gravity = glm::length(scene.gravity);
    double reach = speed * std::min(life.life.y, seconds);
    if (gravity > 0) reach = std::min(reach, speed * speed / gravity);
    out.low -= emitter.radius + reach;
    out.high += emitter.radius + reach;
    if (!emitter.path) return out;
    Box moved = emptyBox;
    for (const ColliderPath::Keyframe& frame : emitter.path->keyframes)
        includePlaced(moved, out, frame.pose);
    return moved;
}

// A tree's crown: many molecules with a surface, on a model, about as high as wide (not a lawn).
static bool isCrown(const Group& group, const Box& box) {
    const glm::dvec3 extent = box.high - box.low;
    return group.count >= 200 && group.place.model >= 0 && !group.molecule.triangles.empty() &&
           extent.y > 0.35 * std::max(extent.x, extent.z);
}

// Nothing of what has no end, or is drawn as its model.
static std::optional<Box> extentOf(const ColliderShape& shape) {
    Box out;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 along(0);
        along[axis] = 1;
        const std::optional<double> below = supportOf(shape, -along), above = supportOf(shape, along);
        if (!below || !above) return {};
        out.low[axis] = -*below, out.high[axis] = *above;
    }
    return out;
}

// The part of a box that shadows are worth drawing in: hills a kilometre away would leave none for what is
// near.
static Box near(const Box& box, const Camera& camera) {
    const double reach = 10 * std::max(glm::distance(camera.eye, camera.target), 1e-3);
    const Box part{glm::max(box.low, camera.target - reach), glm::min(box.high, camera.target + reach)};
    const glm::dvec3 extent = part.high - part.low;
    return std::min({extent.x, extent.y, extent.z}) >= 0 ? part : box;
}

SceneBounds boundsOf(const Scene& scene, const Plan& plan) {
    SceneBounds bounds;
    bounds.casters = bounds.models = emptyBox;
    for (const Model& model : scene.models)
        if (model.draw) include(bounds.models, model.mesh.low, model.mesh.high);
    Box crown = emptyBox;
    for (const GroupPlan& group : plan.groups) {
        if (group.start.anchors.empty()) continue;
        const Group& source = scene.groups[group.index];
        Box box = boundsOf(group);
        if (source.life) {
            for (const Emitter& emitter : source.life->emitters) {
                const Box reach = reachOf(scene, *source.life, emitter);
                if (!isEmpty(reach)) include(box, reach.low, reach.high);
            }
        }
        if (isEmpty(box)) continue;
        include(bounds.casters, box.low, box.high);
        if (isCrown(source, box)) include(crown, box.low, box.high);
        const int carrier = source.place.kind == Placement::Kind::vertices ? source.place.model : -1;
        if (carrier >= 0 && scene.models[size_t(carrier)].draw) {
            const Mesh& mesh = scene.models[size_t(carrier)].mesh;
            include(bounds.casters, mesh.low, mesh.high);
        }
    }
    for (const Collider& collider : scene.colliders) {
        if (!collider.draw) continue;
        const std::optional<Box> box = extentOf(*collider.shape);
        if (!box) continue;
        std::vector<ColliderPath::Keyframe> frames(1);
        if (collider.path) frames = collider.path->keyframes;
        for (const ColliderPath::Keyframe& frame : frames)
            includePlaced(bounds.casters, *box, frame.pose);
    }
    if (!isEmpty(bounds.models)) bounds.models = near(bounds.models, scene.camera);
    if (isEmpty(bounds.casters)) bounds.casters = bounds.models;
    if (isEmpty(bounds.casters)) bounds.casters = Box{};
    if (isEmpty(bounds.models)) bounds.models = bounds.casters;
    if (!isEmpty(crown)) {
        const glm::dvec3 half = 0.5 * (crown.high - crown.low);
        bounds.crown = {0.5 * (crown.low + crown.high), (half.x + half.y + half.z) / 3};
    }
    return bounds;
}

}  // namespace shoal
