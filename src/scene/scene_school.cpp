// "school" of a group: how its molecules steer by one another.
#include <algorithm>
#include <cmath>

#include "scene/scene_reader.h"

namespace shoal {

static constexpr double pi = 3.14159265358979323846;

template <typename V>
static void members(V&& v, Either<SchoolTarget> auto& target) {
    v.number("radius", target.radius, aboveZero());
    v.number("strength", target.strength, Range::atLeast(0));
}

template <typename V>
static void members(V&& v, Either<School> auto& s) {
    v.number("radius", s.radius, aboveZero());
    v.number("blind", s.blind, Range::between(0, pi));
    v.number("separationRadius", s.separationRadius, aboveZero());
    v.number("separation", s.separation, Range::atLeast(0));
    v.number("alignment", s.alignment, Range::atLeast(0));
    v.number("cohesion", s.cohesion, Range::atLeast(0));
    v.number("slowest", s.slowest, Range::atLeast(0));
    v.number("cruise", s.cruise, aboveZero());
    v.number("fastest", s.fastest, aboveZero());
    v.number("acceleration", s.acceleration, aboveZero());
    v.number("turn", s.turn, aboveZero());
    v.number("steepest", s.steepest, Range::between(0, 1.5));
    v.number("reaction", s.reaction, Range::between(0.01, 100));
    v.number("bend", s.bend, Range::between(0, 3));
    v.number("beat", s.beat, Range::atLeast(0));
    v.number("fins", s.fins, Range::between(0, 1));
    v.number("wander", s.wander, Range::atLeast(0));
    v.number("depthStrength", s.depthStrength, Range::atLeast(0));
    v.number("walls", s.walls, Range::atLeast(0));
    v.number("look", s.look, Range::between(0, 10));
}

namespace {

std::vector<SchoolTarget> readTargets(JsonReader& r, const char* key) {
    std::vector<SchoolTarget> out;
    for (JsonReader& entry : r.objects(key)) {
        auto target = readMembers<SchoolTarget>(entry);
        target.location = entry.here();
        entry.need("group", target.group);
        entry.finish();
        out.push_back(std::move(target));
    }
    return out;
}

void readHome(JsonReader& r, School& school) {
    auto home = r.object("home");
    if (!home) return;
    SchoolHome out;
    Box box;
    if (getBox(*home, "box", box)) {
        out.box = box;
    } else {
        home->need("center", out.center);
        home->need("radius", out.radius, aboveZero());
    }
    home->get("strength", out.strength, Range::atLeast(0));
    home->finish();
    school.home = out;
}

void refuse(const School& school, const std::string& what) {
    throw Error(school.location, what);
}

bool targets(const std::vector<SchoolTarget>& list, const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const SchoolTarget& t) { return t.group == name; });
}

}  // namespace

void checkSchool(const School& school) {
    if (school.slowest > school.cruise || school.cruise > school.fastest)
        refuse(school, concat("expected slowest <= cruise <= fastest, found ", school.slowest, ", ",
                              school.cruise, " and ", school.fastest, " m/s"));
    if (school.separationRadius > school.radius)
        refuse(school, concat("expected a separationRadius of at most the radius in which others are seen (",
                              school.radius, " m), found ", school.separationRadius));
    if (school.depth && !(school.depth->x <= school.depth->y))
        refuse(school, concat("expected a depth from its lowest to its highest y, found ", school.depth->x,
                              " and ", school.depth->y));
}

void checkSchools(const std::vector<Group>& groups) {
    std::vector<std::string> names;
    for (const Group& group : groups)
        names.push_back(group.name);
    for (const Group& group : groups) {
        if (!group.school) continue;
        const School& school = *group.school;
        if (school.flees.size() + school.hunts.size() > mostSchoolTargets)
            throw Error(school.location,
                        concat("a group flees and hunts at most ", mostSchoolTargets, " others, found ",
                               school.flees.size() + school.hunts.size()));
        for (const auto* list : {&school.flees, &school.hunts}) {
            for (const SchoolTarget& target : *list) {
                if (std::find(names.begin(), names.end(), target.group) == names.end())
                    throw Error(target.location, concat("there is no group \"", target.group, "\"",
                                                        suggestion(target.group, names)));
                if (target.group == group.name)
                    throw Error(target.location, concat("\"", group.name, "\" cannot ",
                                                        list == &school.flees ? "flee" : "hunt",
                                                        " itself: expected another group"));
            }
        }
        for (const SchoolTarget& target : school.hunts)
            if (targets(school.flees, target.group))
                throw Error(target.location,
                            concat("\"", group.name, "\" cannot both flee and hunt \"", target.group, "\""));
    }
}

void readSchool(JsonReader& group, Group& out) {
    auto r = group.object("school");
    if (!r) return;
    School s;
    s.location = r->here();
    r->get("radius", s.radius, aboveZero());
    s.separationRadius = std::min(s.separationRadius, s.radius);
    members(ReadScene(*r), s);
    glm::dvec2 depth;
    if (r->get("depth", depth)) s.depth = depth;
    readHome(*r, s);
    s.flees = readTargets(*r, "flees");
    s.hunts = readTargets(*r, "hunts");
    r->finish();
    checkSchool(s);
    out.school = std::move(s);
}

void checkSchool(const School& school, const Where& where) {
    members(CheckScene(where), school);
    const CheckScene check(where);
    if (school.depth) check.number("depth", *school.depth);
    if (school.home) {
        const Where home = where.in("home");
        const CheckScene inner(home);
        inner.box("box", school.home->box);
        inner.number("center", school.home->center);
        if (!school.home->box) inner.number("radius", school.home->radius, aboveZero());
        inner.number("strength", school.home->strength, Range::atLeast(0));
    }
    for (size_t i = 0; i < school.flees.size(); ++i) {
        const Where target = where.in("flees", i);
        members(CheckScene(target), school.flees[i]);
    }
    for (size_t i = 0; i < school.hunts.size(); ++i) {
        const Where target = where.in("hunts", i);
        members(CheckScene(target), school.hunts[i]);
    }
    try {
        checkSchool(school);
    } catch (const Error& error) {
        throw Error(where.here(), error.message());
    }
}

}  // namespace shoal
