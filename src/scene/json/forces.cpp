// "forces": what accelerates molecules beside fields, gravity and springs.
#include <algorithm>

#include "core/description.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

void checkGroupNames(const Force& force, const std::vector<Group>& groups, const Where& where) {
    std::vector<std::string> known;
    for (const Group& group : groups)
        if (!group.name.empty()) known.push_back(group.name);
    if (where.given("groups") && force.groups.empty())
        throw Error(where.at("groups"), "expected the name of at least one group; all without it");
    for (const std::string& name : force.groups)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw Error(where.at("groups"),
                        "no group is named \"" + name + "\"" +
                            (known.empty() ? " (none has a \"name\")" : suggestion(name, known)));
}

}  // namespace

std::vector<Force> readForces(JsonReader& scene, const std::vector<Group>& groups) {
    std::vector<Force> forces;
    std::vector<std::string> names;
    for (JsonReader& reader : scene.objects("forces")) {
        Force force;
        describe(&force).read(reader, force);
        takeName(reader, names, force.name);
        checkGroupNames(force, groups, reader);
        reader.finish();
        forces.push_back(std::move(force));
    }
    return forces;
}

void checkForces(const std::vector<Force>& forces, const std::vector<Group>& groups) {
    const Where whole;
    std::vector<std::string> names;
    for (size_t i = 0; i < forces.size(); ++i) {
        const Where where = whole.in("forces", i);
        describe(&forces[i]).check(forces[i], where, largestNumber);
        takeName(where, names, forces[i].name);
        checkGroupNames(forces[i], groups, where);
    }
}

}  // namespace shoal
