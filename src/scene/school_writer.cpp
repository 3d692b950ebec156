#include "scene/school_writer.h"

#include <algorithm>

#include "scene/key_writer.h"

namespace shoal {

static JsonValue write(const std::vector<SchoolTarget>& targets) {
    JsonValue out = JsonValue::makeArray();
    for (const SchoolTarget& target : targets) {
        KeyWriter keys;
        keys.word("group", target.group);
        keys.number("radius", target.radius, SchoolTarget().radius);
        keys.number("strength", target.strength, SchoolTarget().strength);
        out.items.push_back(std::move(keys.object));
    }
    return out;
}

static JsonValue write(const SchoolHome& home) {
    KeyWriter keys;
    if (home.box) {
        keys.value("box", JsonValue::makeObject()
                              .add("low", JsonValue::makeVector(home.box->low))
                              .add("high", JsonValue::makeVector(home.box->high)));
    } else {
        keys.value("center", JsonValue::makeVector(home.center));
        keys.value("radius", JsonValue::makeNumber(home.radius));
    }
    keys.number("strength", home.strength, SchoolHome().strength);
    return std::move(keys.object);
}

JsonValue writeSchool(const School& school) {
    const School usual;
    KeyWriter keys;
    keys.number("radius", school.radius, usual.radius);
    keys.number("blind", school.blind, usual.blind);
    keys.number("separationRadius", school.separationRadius, std::min(usual.separationRadius, school.radius));
    keys.number("separation", school.separation, usual.separation);
    keys.number("alignment", school.alignment, usual.alignment);
    keys.number("cohesion", school.cohesion, usual.cohesion);
    keys.number("slowest", school.slowest, usual.slowest);
    keys.number("cruise", school.cruise, usual.cruise);
    keys.number("fastest", school.fastest, usual.fastest);
    keys.number("acceleration", school.acceleration, usual.acceleration);
    keys.number("turn", school.turn, usual.turn);
    keys.number("steepest", school.steepest, usual.steepest);
    keys.number("reaction", school.reaction, usual.reaction);
    keys.number("bend", school.bend, usual.bend);
    keys.number("beat", school.beat, usual.beat);
    keys.number("fins", school.fins, usual.fins);
    keys.number("wander", school.wander, usual.wander);
    if (school.depth) keys.value("depth", JsonValue::makeVector(*school.depth));
    keys.number("depthStrength", school.depthStrength, usual.depthStrength);
    keys.number("walls", school.walls, usual.walls);
    keys.number("look", school.look, usual.look);
    if (school.home) keys.value("home", write(*school.home));
    if (!school.flees.empty()) keys.value("flees", write(school.flees));
    if (!school.hunts.empty()) keys.value("hunts", write(school.hunts));
    return std::move(keys.object);
}

}  // namespace shoal
