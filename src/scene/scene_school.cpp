// "school" of a group: how its molecules steer by one another.
#include <algorithm>
#include <cmath>

#include "scene/scene_reader.h"

namespace shoal {

namespace {

constexpr double pi = 3.14159265358979323846;

std::vector<SchoolTarget> readTargets(JsonReader& r, const char* key) {
    std::vector<SchoolTarget> out;
    for (JsonReader& entry : r.objects(key)) {
        SchoolTarget target;
        target.location = entry.here();
        entry.need("group", target.group);
        entry.get("radius", target.radius, aboveZero());
        entry.get("strength", target.strength, Range::atLeast(0));
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
    r->get("blind", s.blind, Range::between(0, pi));
    s.separationRadius = std::min(s.separationRadius, s.radius);
    r->get("separationRadius", s.separationRadius, aboveZero());
    r->get("separation", s.separation, Range::atLeast(0));
    r->get("alignment", s.alignment, Range::atLeast(0));
    r->get("cohesion", s.cohesion, Range::atLeast(0));
    r->get("slowest", s.slowest, Range::atLeast(0));
    r->get("cruise", s.cruise, aboveZero());
    r->get("fastest", s.fastest, aboveZero());
    r->get("acceleration", s.acceleration, aboveZero());
    r->get("turn", s.turn, aboveZero());
    r->get("steepest", s.steepest, Range::between(0, 1.5));
    r->get("reaction", s.reaction, Range::between(0.01, 100));
    r->get("bend", s.bend, Range::between(0, 3));
    r->get("beat", s.beat, Range::atLeast(0));
    r->get("fins", s.fins, Range::between(0, 1));
    r->get("wander", s.wander, Range::atLeast(0));
    glm::dvec2 depth;
    if (r->get("depth", depth)) s.depth = depth;
    r->get("depthStrength", s.depthStrength, Range::atLeast(0));
    r->get("walls", s.walls, Range::atLeast(0));
    r->get("look", s.look, Range::between(0, 10));
    readHome(*r, s);
    s.flees = readTargets(*r, "flees");
    s.hunts = readTargets(*r, "hunts");
    r->finish();
    checkSchool(s);
    out.school = std::move(s);
}

}  // namespace shoal
