#include "scene/school.h"

#include <algorithm>

#include "core/describe.h"
#include "scene/json/reader.h"

namespace shoal {

const Description& describe(const SchoolTarget*) {
    using S = SchoolTarget;
    static const Description description =
        Describe<S>("target", "A group that is fled from, or hunted.")
            .location(&S::location)
            .key("group", &S::group, {"", "The name of the group."})
            .needed()
            .key("radius", &S::radius, {"m", "They are noticed within this distance.", aboveZero()})
            .key("strength", &S::strength,
                 {"m/s²", "The acceleration at the distance 0, down to none at the radius.",
                  Range::atLeast(0)});
    return description;
}

const Description& describe(const SchoolHome*) {
    using S = SchoolHome;
    static const auto rule = [](const S& home, const Where& where) {
        if (home.box) {
            for (const char* key : {"center", "radius"})
                if (where.given(key))
                    throw Error(where.locate(key), "\"", key, "\" has no effect beside \"box\"");
            return;
        }
        where.require("center");
        where.require("radius");
        needWithin(where.locate("radius"), home.radius, aboveZero());
    };
    static const Description description =
        Describe<S>("home", "Where they like to be: they are pulled back to it.")
            .box("box", &S::box, {"m", "A box; without it the home is a ball."})
            .key("center", &S::center, {"m", "The middle of the ball."})
            .key("radius", &S::radius, {"m", "The radius of the ball.", aboveZero()})
            .unlessZero()
            .key("strength", &S::strength,
                 {"1/s²", "The acceleration by the distance from it.", Range::atLeast(0)})
            .rule(rule, R"({"oneOf": [{"required": ["box"]}, {"required": ["center", "radius"]}]})");
    return description;
}

const Description& describe(const School*) {
    using S = School;
    static const auto derive = [](S& school, const Where& where) {
        if (!where.given("separationRadius"))
            school.separationRadius = std::min(school.separationRadius, school.radius);
    };
    static const auto rule = [](const S& school, const Where& where) {
        if (school.slowest > school.cruise || school.cruise > school.fastest)
            throw Error(where.here(), "expected slowest <= cruise <= fastest, found ", school.slowest, ", ",
                        school.cruise, " and ", school.fastest, " m/s");
        if (school.separationRadius > school.radius)
            throw Error(where.here(),
                        "expected a separationRadius of at most the radius in which others are seen (",
                        school.radius, " m), found ", school.separationRadius);
        if (school.depth && !(school.depth->x <= school.depth->y))
            throw Error(where.here(), "expected a depth from its lowest to its highest y, found ",
                        school.depth->x, " and ", school.depth->y);
    };
    static const Description description =
        Describe<S>("school",
                    "Flocking [Reynolds 1987]: the molecules of a group steer by one another, by walls, and "
                    "by those that they flee or hunt.")
            .location(&S::location)
            .key("radius", &S::radius, {"m", "Others nearer than this count.", aboveZero()})
            .key("blind", &S::blind,
                 {"rad", "Half the angle of the cone behind, in which none is seen.",
                  Range::between(0, 3.14159265358979323846)})
            .key("separationRadius", &S::separationRadius,
                 {"m", "Those nearer than this are kept away from.", aboveZero()})
            .key("separation", &S::separation,
                 {"m/s²",
                  "The acceleration away from each, at the distance 0, down to none at separationRadius.",
                  Range::atLeast(0)})
            .key("alignment", &S::alignment,
                 {"1/s", "How fast the velocity becomes that of the others.", Range::atLeast(0)})
            .key("cohesion", &S::cohesion,
                 {"1/s²", "The pull towards the others' middle.", Range::atLeast(0)})
            .key("slowest", &S::slowest, {"m/s", "The least speed.", Range::atLeast(0)})
            .key("cruise", &S::cruise, {"m/s", "The speed that it likes.", aboveZero()})
            .key("fastest", &S::fastest, {"m/s", "The largest speed.", aboveZero()})
            .key("acceleration", &S::acceleration,
                 {"m/s²", "The most that everything together may ask for.", aboveZero()})
            .key("turn", &S::turn, {"rad/s", "The fastest turn of its course.", aboveZero()})
            .key("steepest", &S::steepest,
                 {"rad", "The most that it swims up or down.", Range::between(0, 1.5)})
            .key("reaction", &S::reaction,
                 {"s", "Steering follows what is seen within this time.", Range::between(0.01, 100)})
            .key("bend", &S::bend,
                 {"rad", "The most that its ends turn to one another, by its muscles.", Range::between(0, 3)})
            .key("beat", &S::beat,
                 {"m/s", "The speed at which its muscles run at their own frequency; 0: at any.",
                  Range::atLeast(0)})
            .key("fins", &S::fins,
                 {"", "The share of the thrust that its tail does not give, added by un-damping.",
                  Range::between(0, 1)})
            .key("wander", &S::wander,
                 {"m/s²", "The acceleration to here and there at random.", Range::atLeast(0)})
            .key("depth", &S::depth, {"m", "The lowest and the highest y that it likes."})
            .key("depthStrength", &S::depthStrength,
                 {"1/s²", "The pull back to that depth.", Range::atLeast(0)})
            .key("walls", &S::walls,
                 {"m", "Colliders nearer than this are turned from; 0: none is.", Range::atLeast(0)})
            .key("look", &S::look, {"s", "How far ahead walls are seen.", Range::between(0, 10)})
            .key("home", &S::home, {"", "Where they like to be."})
            .key("flees", &S::flees, {"", "The groups that it flees, at most 8 with those that it hunts."})
            .key("hunts", &S::hunts, {"", "The groups that it hunts."})
            .derive(derive)
            .rule(rule);
    return description;
}

static bool targets(const std::vector<SchoolTarget>& list, const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const SchoolTarget& t) { return t.group == name; });
}

void checkSchools(const std::vector<Group>& groups) {
    const std::vector<std::string> names = namesOf(groups);
    for (const Group& group : groups) {
        if (!group.school) continue;
        const School& school = *group.school;
        if (school.flees.size() + school.hunts.size() > mostSchoolTargets)
            throw Error(school.location, "a group flees and hunts at most ", mostSchoolTargets,
                        " others, found ", school.flees.size() + school.hunts.size());
        for (const auto* list : {&school.flees, &school.hunts}) {
            for (const SchoolTarget& target : *list) {
                needNamed(target.group, names, target.location, "there is no group");
                if (target.group == group.name)
                    throw Error(target.location, "\"", group.name, "\" cannot ",
                                list == &school.flees ? "flee" : "hunt", " itself: expected another group");
            }
        }
        for (const SchoolTarget& target : school.hunts)
            if (targets(school.flees, target.group))
                throw Error(target.location, "\"", group.name, "\" cannot both flee and hunt \"",
                            target.group, "\"");
    }
}

}  // namespace shoal
