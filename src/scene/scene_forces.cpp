// "forces": what accelerates molecules beside fields, gravity and springs.
#include <algorithm>

#include "scene/scene_reader.h"

namespace shoal {

namespace {

AttractForce readAttract(JsonReader& r) {
    AttractForce force;
    r.get("position", force.position);
    int falloff = 0;
    r.choose("falloff", {"inverseSquare", "constant"}, falloff);
    force.falloff = static_cast<AttractForce::Falloff>(falloff);
    r.need("strength", force.strength);
    if (force.falloff == AttractForce::Falloff::inverseSquare) {
        r.get("radius", force.radius, aboveZero());
        r.need("most", force.most, aboveZero());
    } else {
        r.need("radius", force.radius, aboveZero());
        if (r.has("most"))
            throw Error(r.at("most"), "\"most\" bounds an inverse square: a constant falloff has none");
    }
    return force;
}

VortexLineForce readVortexLine(JsonReader& r) {
    VortexLineForce force;
    r.get("position", force.position);
    getDirection(r, "axis", force.axis);
    r.get("pull", force.pull);
    r.get("turn", force.turn);
    r.get("core", force.core, aboveZero());
    r.get("radius", force.radius, aboveZero());
    return force;
}

ThrustForce readThrust(JsonReader& r) {
    ThrustForce force;
    r.need("rate", force.rate);
    if (force.rate > 0)
        r.need("limit", force.limit, aboveZero());
    else
        r.get("limit", force.limit, aboveZero());
    return force;
}

WindForce readWind(JsonReader& r) {
    WindForce force;
    r.need("velocity", force.velocity);
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
        return readVortexLine(r);
    case 2:
        return readThrust(r);
    default:
        return readWind(r);
    }
}

// Thrust and wind are the same everywhere.
bool hasPlace(const ForceShape& shape) {
    return std::holds_alternative<AttractForce>(shape) || std::holds_alternative<VortexLineForce>(shape);
}

std::optional<ForcePath> readPath(JsonReader& force, bool hasPlace) {
    auto r = force.object("path");
    if (!r) return {};
    ForcePath path;
    r->get("repeats", path.repeats);
    r->require("keyframes");
    for (JsonReader& frame : r->objects("keyframes")) {
        ForcePath::Keyframe key;
        frame.need("time", key.time);
        if (!path.keyframes.empty() && !(key.time > path.keyframes.back().time))
            throw Error(frame.at("time"), concat("expected a time after that of the keyframe before, ",
                                                 path.keyframes.back().time, " s, found ", key.time));
        if (frame.get("offset", key.offset) && !hasPlace)
            throw Error(frame.at("offset"),
                        "thrust and wind act alike everywhere: they have no place to move");
        frame.get("factor", key.factor);
        frame.finish();
        path.keyframes.push_back(key);
    }
    if (path.keyframes.size() < 2)
        throw Error(r->at("keyframes"),
                    concat("expected at least two keyframes, found ", path.keyframes.size()));
    r->finish();
    return path;
}

std::vector<std::string> readGroupNames(JsonReader& r, const std::vector<Group>& groups) {
    std::vector<std::string> names, known;
    for (const Group& group : groups)
        if (!group.name.empty()) known.push_back(group.name);
    if (!r.get("groups", names)) return {};
    if (names.empty()) throw Error(r.at("groups"), "expected the name of at least one group; all without it");
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw Error(r.at("groups"),
                        "no group is named \"" + name + "\"" +
                            (known.empty() ? " (none has a \"name\")" : suggestion(name, known)));
    return names;
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
        if (r.get("mouse", force.mouse) && force.mouse && !hasPlace(force.shape))
            throw Error(r.at("mouse"), "thrust and wind act alike everywhere: they cannot follow the mouse");
        r.finish();
        forces.push_back(std::move(force));
    }
    return forces;
}

}  // namespace shoal
