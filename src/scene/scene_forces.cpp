// "forces": what accelerates molecules beside fields, gravity and springs.
#include <algorithm>

#include "scene/scene_reader.h"

namespace shoal {

template <typename V>
static void members(V&& v, Either<AttractForce> auto& force) {
    v.number("position", force.position);
    v.word("falloff", force.falloff, {"inverseSquare", "constant"});
    v.number("strength", force.strength);
    v.unlessZero("radius", force.radius, aboveZero());
}

template <typename V>
static void members(V&& v, Either<VortexLineForce> auto& force) {
    v.number("position", force.position);
    v.direction("axis", force.axis);
    v.number("pull", force.pull);
    v.number("turn", force.turn);
    v.number("core", force.core, aboveZero());
    v.unlessZero("radius", force.radius, aboveZero());
}

template <typename V>
static void members(V&& v, Either<ThrustForce> auto& force) {
    v.number("rate", force.rate);
    v.number("limit", force.limit, aboveZero());
}

template <typename V>
static void members(V&& v, Either<WindForce> auto& force) {
    v.number("velocity", force.velocity);
}

template <typename V>
static void members(V&& v, Either<ForcePath::Keyframe> auto& key) {
    v.number("time", key.time);
    v.number("offset", key.offset);
    v.number("factor", key.factor);
}

namespace {

AttractForce readAttract(JsonReader& r) {
    AttractForce force = readMembers<AttractForce>(r, {"strength"});
    if (force.falloff == AttractForce::Falloff::inverseSquare) {
        r.need("most", force.most, aboveZero());
    } else {
        r.require("radius");
        if (r.has("most"))
            throw Error(r.at("most"), "\"most\" bounds an inverse square: a constant falloff has none");
    }
    return force;
}

ThrustForce readThrust(JsonReader& r) {
    const ThrustForce force = readMembers<ThrustForce>(r, {"rate"});
    if (force.rate > 0) r.require("limit");
    return force;
}

ForceShape readShape(JsonReader& r) {
    int type = 0;
    r.require("type");
    r.choose("type", {"attract", "vortexLine", "thrust", "wind"}, type);
    switch (type) {
    case 0:
        return readAttract(r);
    case 1:
        return readMembers<VortexLineForce>(r);
    case 2:
        return readThrust(r);
    default:
        return readMembers<WindForce>(r, {"velocity"});
    }
}

// Thrust and wind are the same everywhere.
bool hasPlace(const ForceShape& shape) {
    return std::holds_alternative<AttractForce>(shape) || std::holds_alternative<VortexLineForce>(shape);
}

void checkMoves(bool hasPlace, const Location& where) {
    if (!hasPlace) throw Error(where, "thrust and wind act alike everywhere: they have no place to move");
}

void checkMouse(bool hasPlace, const Location& where) {
    if (!hasPlace) throw Error(where, "thrust and wind act alike everywhere: they cannot follow the mouse");
}

std::optional<ForcePath> readPath(JsonReader& force, bool hasPlace) {
    auto r = force.object("path");
    if (!r) return {};
    ForcePath path;
    r->get("repeats", path.repeats);
    r->require("keyframes");
    for (JsonReader& frame : r->objects("keyframes")) {
        const auto key = readMembers<ForcePath::Keyframe>(frame, {"time"});
        if (!path.keyframes.empty()) checkRises(key.time, path.keyframes.back().time, frame.at("time"));
        if (frame.has("offset")) checkMoves(hasPlace, frame.at("offset"));
        frame.finish();
        path.keyframes.push_back(key);
    }
    needTwoKeyframes(path.keyframes.size(), r->at("keyframes"));
    r->finish();
    return path;
}

void checkGroupNames(const std::vector<std::string>& names, const std::vector<Group>& groups,
                     const Where& where) {
    std::vector<std::string> known;
    for (const Group& group : groups)
        if (!group.name.empty()) known.push_back(group.name);
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw Error(where.at("groups"),
                        "no group is named \"" + name + "\"" +
                            (known.empty() ? " (none has a \"name\")" : suggestion(name, known)));
}

std::vector<std::string> readGroupNames(JsonReader& r, const std::vector<Group>& groups) {
    std::vector<std::string> names;
    if (!r.get("groups", names)) return {};
    if (names.empty()) throw Error(r.at("groups"), "expected the name of at least one group; all without it");
    checkGroupNames(names, groups, r);
    return names;
}

void checkForce(const Force& force, const Where& where) {
    const bool place = hasPlace(force.shape);
    std::visit([&](const auto& shape) { members(CheckScene(where), shape); }, force.shape);
    if (const auto* attract = std::get_if<AttractForce>(&force.shape)) {
        const bool square = attract->falloff == AttractForce::Falloff::inverseSquare;
        CheckScene(where).number(square ? "most" : "radius", square ? attract->most : attract->radius,
                                 aboveZero());
    }
    if (force.mouse) checkMouse(place, where.at("mouse"));
    if (!force.path) return;
    const Where path = where.in("path");
    const std::vector<ForcePath::Keyframe>& keys = force.path->keyframes;
    needTwoKeyframes(keys.size(), path.at("keyframes"));
    for (size_t i = 0; i < keys.size(); ++i) {
        const Where here = path.in("keyframes", i);
        members(CheckScene(here), keys[i]);
        if (i > 0) checkRises(keys[i].time, keys[i - 1].time, here.at("time"));
        if (keys[i].offset != glm::dvec3(0)) checkMoves(place, here.at("offset"));
    }
}

}  // namespace

std::vector<Force> readForces(JsonReader& scene, const std::vector<Group>& groups) {
    std::vector<Force> forces;
    std::vector<std::string> names;
    for (JsonReader& r : scene.objects("forces")) {
        Force force;
        force.location = r.here();
        r.get("name", force.name);
        refuseRepeated(r, names, force.name);
        names.push_back(force.name);
        force.shape = readShape(r);
        force.groups = readGroupNames(r, groups);
        force.path = readPath(r, hasPlace(force.shape));
        if (r.get("mouse", force.mouse) && force.mouse) checkMouse(hasPlace(force.shape), r.at("mouse"));
        r.finish();
        forces.push_back(std::move(force));
    }
    return forces;
}

void checkForces(const std::vector<Force>& forces, const std::vector<Group>& groups) {
    const Where whole;
    std::vector<std::string> names;
    for (size_t i = 0; i < forces.size(); ++i) {
        const Where where = whole.in("forces", i);
        refuseRepeated(where, names, forces[i].name);
        names.push_back(forces[i].name);
        checkForce(forces[i], where);
        checkGroupNames(forces[i].groups, groups, where);
    }
}

}  // namespace shoal
