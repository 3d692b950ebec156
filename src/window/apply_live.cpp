#include "window/apply_live.h"

#include <algorithm>
#include <initializer_list>

#include "core/json_build.h"
#include "core/json_edit.h"
#include "scene/json/scene_file.h"

namespace shoal::window {

namespace {

using Keys = std::initializer_list<const char*>;

JsonValue without(Keys keys, JsonValue object) {
    for (const char* key : keys)
        leaveOut(object, key);
    return object;
}

bool differ(Keys keys, const JsonValue& before, const JsonValue& after) {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) {
        const JsonValue *old = before.find(key), *fresh = after.find(key);
        return !sameJson(old ? *old : JsonValue(), fresh ? *fresh : JsonValue());
    });
}

// Takes the edits of one group; false: none of them, or some.
bool applyEdit(const SceneDifference::Live& edit, const Group& before, const Group& after, size_t planGroup,
               Simulation& simulation, Renderer& renderer) {
    if (before.particle.has_value() != after.particle.has_value()) return false;
    if (edit.school && !(before.school && after.school && simulation.changeSchool(planGroup, *after.school)))
        return false;
    if (edit.life && !(before.life && after.life && simulation.changeLife(planGroup, *after.life)))
        return false;
    if (!after.particle) return renderer.changeLooks(planGroup, after);
    return after.particle->mass == before.particle->mass &&  // which the plan has
           renderer.changeParticle(planGroup, *after.particle);
}

}  // namespace

SceneDifference differenceOf(const JsonValue& before, const JsonValue& after) {
    SceneDifference out;
    const JsonValue &old = *before.find("groups"), *fresh = after.find("groups");
    out.simulation = !fresh || fresh->items.size() != old.items.size() ||
                     !sameJson(without({"groups", "light", "sky", "camera"}, before),
                               without({"groups", "light", "sky", "camera"}, after));
    out.picture = differ({"light", "sky", "camera"}, before, after);
    for (size_t g = 0; !out.simulation && g < old.items.size(); ++g) {
        const JsonValue &from = old.items[g], &to = fresh->items[g];
        out.simulation = !sameJson(without(liveKeys, from), without(liveKeys, to));
        const SceneDifference::Live edit{
            g, differ({"particle", "color", "secondColor", "variation"}, from, to),
            differ({"life", "emitters"}, from, to), differ({"school"}, from, to)};
        if (edit.looks || edit.life || edit.school) out.live.push_back(edit);
    }
    return out;
}

std::optional<size_t> planGroupOf(const Plan& plan, size_t group) {
    for (size_t g = 0; g < plan.groups.size(); ++g)
        if (plan.groups[g].index == group) return g;
    return {};
}

bool applyLive(const std::vector<SceneDifference::Live>& edits, const std::vector<Group>& before,
               const std::vector<Group>& after, Simulation& simulation, Renderer& renderer) {
    const auto apply = [&](const SceneDifference::Live& edit, const std::vector<Group>& to) {
        const std::optional<size_t> g = planGroupOf(simulation.plan(), edit.group);
        return g && applyEdit(edit, before[edit.group], to[edit.group], *g, simulation, renderer);
    };
    for (size_t i = 0; i < edits.size(); ++i) {
        if (apply(edits[i], after)) continue;
        for (size_t taken = 0; taken <= i; ++taken)
            apply(edits[taken], before);
        return false;
    }
    return true;
}

}  // namespace shoal::window
