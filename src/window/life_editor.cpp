#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "window/edit_widgets.h"
#include "window/panel.h"

namespace shoal::window {

namespace {

using From = Emitter::From;
using Along = Emitter::Along;

constexpr int kinds = int(From::death) + 1;

std::string titleOf(const Emitter& emitter, size_t index) {
    const std::string kind = name(emitter.from);
    return emitter.name.empty() ? concat("emitter ", index + 1, ": ", kind)
                                : concat(emitter.name, ": ", kind);
}

// Whether the group is `from`, or emits through a chain of deaths from its deaths: then `from` cannot emit
// from the group's deaths.
bool emitsFrom(const Scene& scene, const Group& group, const std::string& from, size_t depth = 0) {
    if (group.name == from || depth > scene.groups.size()) return true;
    if (!group.life) return false;
    for (const Emitter& emitter : group.life->emitters) {
        if (emitter.from != From::death) continue;
        for (const Group& source : scene.groups)
            if (source.name == emitter.group && emitsFrom(scene, source, from, depth + 1)) return true;
    }
    return false;
}

// Names of groups from whose deaths this one can emit.
std::vector<std::string> dyingGroups(const Scene& scene, const Group& group) {
    std::vector<std::string> out;
    for (const Group& other : scene.groups)
        if (other.life && !emitsFrom(scene, other, group.name)) out.push_back(other.name);
    return out;
}

// As another kind, about where it was.
void become(Emitter& emitter, From from, const Scene& scene, const std::string& dying) {
    glm::dvec3 middle = emitter.position;
    if (emitter.from == From::line) middle = 0.5 * (emitter.lineFrom + emitter.lineTo);
    if (emitter.from == From::box) middle = 0.5 * (emitter.box.low + emitter.box.high);
    emitter.from = from;
    emitter.position = middle;
    if (emitter.radius <= 0) emitter.radius = 0.1;
    emitter.lineFrom = middle - glm::dvec3(0.5, 0, 0);
    emitter.lineTo = middle + glm::dvec3(0.5, 0, 0);
    emitter.box = {middle - 0.25, middle + 0.25};
    emitter.along = Along::direction;
    if (from == From::sphere || from == From::surface || from == From::death) emitter.along = Along::outward;
    emitter.model = from == From::surface ? 0 : -1;
    emitter.group = from == From::death ? dying : "";
    if (from == From::surface || from == From::death) emitter.path.reset();
    if (!scene.models.empty() && from == From::surface) emitter.select = {};
    if (from == From::death) emitter.perDeath = std::max(1, emitter.perDeath);
}

bool drawKind(const Scene& scene, const Group& group, Emitter& emitter, Lifecycle& life) {
    const std::vector<std::string> dying = dyingGroups(scene, group);
    std::vector<From> possible;
    std::vector<std::string> words;
    for (int kind = 0; kind < kinds; ++kind) {
        const From from = From(kind);
        const bool can =
            from == From::surface ? !scene.models.empty() : from != From::death || !dying.empty();
        if (!can && from != emitter.from) continue;
        possible.push_back(from);
        words.emplace_back(name(from));
    }
    const auto chosen = choose(rowOf(*describe(&emitter).find("from")), name(emitter.from), words);
    if (!chosen) return false;
    become(emitter, possible[*chosen], scene, dying.empty() ? "" : dying.front());
    if (emitter.from == From::death) life.allocator = Allocator::gpu;  // the only one that can
    return true;
}

bool drawDying(const Scene& scene, const Group& group, Emitter& emitter) {
    const std::vector<std::string> dying = dyingGroups(scene, group);
    const auto chosen = choose(rowOf(*describe(&emitter).find("of")), emitter.group, dying);
    if (chosen) emitter.group = dying[*chosen];
    return chosen.has_value();
}

bool drawModel(const Scene& scene, Emitter& emitter) {
    std::vector<std::string> names;
    for (const Model& model : scene.models)
        names.push_back(model.name);
    const auto chosen = choose(rowOf(*describe(&emitter).find("model")), names[size_t(emitter.model)], names);
    if (!chosen) return false;
    emitter.model = int(*chosen);
    emitter.select = {};  // of the other model's parts
    return true;
}

bool drawEmitter(const Scene& scene, Group& group, size_t index, KeyRows& rows) {
    Lifecycle& life = *group.life;
    Emitter& emitter = life.emitters[index];
    KeyRows::Owns owns = {{"from", [&] { return drawKind(scene, group, emitter, life); }},
                          {"model", [&] { return drawModel(scene, emitter); }},
                          {"of", [&] { return drawDying(scene, group, emitter); }},
                          {"select", {}},
                          {"path", {}}};
    if (!emitter.path && emitter.from != From::death) owns["inherit"] = {};
    if (emitter.from == From::line || emitter.from == From::box) owns["along"] = {};
    if (emitter.along == Along::outward && emitter.from != From::disc) owns["direction"] = {};
    const bool changed = rows.draw(emitter, owns);
    // a group with no molecule at the start needs an emitter
    if (life.emitters.size() == 1 && group.count == 0) return changed;
    if (ImGui::SmallButton("Remove")) {
        life.emitters.erase(life.emitters.begin() + std::ptrdiff_t(index));
        rows = {};  // those below move up
        return true;
    }
    tip("Takes this emitter away; what it emitted lives on.");
    return changed;
}

bool drawCapacity(const Group& group, Lifecycle& life) {
    if (life.emitters.empty()) return false;
    const Key& key = *describe(&life).find("capacity");
    const int least = std::max(1, group.count);
    const Limit limit{double(least), std::max(double(least), sliderOf(key, &life).most)};
    bool changed = slide({key.name.c_str(), key.says.sentence.c_str(), "%d", true}, limit, life.capacity);
    const std::optional<int> usual = usualCapacity(group.count, life);
    if (!usual || *usual == life.capacity) return changed;
    beginRow({"", ""});
    if (ImGui::SmallButton(concat("Fit: ", *usual).c_str())) life.capacity = *usual, changed = true;
    tip("As many as these rates and lives can have at once.");
    return changed;
}

}  // namespace

bool drawEmitters(Scene& scene, size_t group, KeyRows& rows) {
    Lifecycle& life = *scene.groups[group].life;
    bool changed = false;
    for (size_t e = 0; e < life.emitters.size(); ++e) {
        ImGui::PushID(int(e));
        const int flags = life.emitters.size() == 1 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
        if (ImGui::TreeNodeEx("emitter", flags, "%s", titleOf(life.emitters[e], e).c_str())) {
            changed |= drawEmitter(scene, scene.groups[group], e, rows);
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    if (ImGui::SmallButton("Add an emitter")) {
        Emitter emitter;
        if (!life.emitters.empty()) emitter = life.emitters.back();
        emitter.name.clear();
        if (emitter.from == From::death || life.emitters.empty()) {
            emitter = {};
            emitter.rate = 20;
            emitter.speed = {1, 2};
            emitter.position = {0, 1, 0};
        }
        life.emitters.push_back(emitter);
        changed = true;
    }
    tip("Another one beside these, like the last.");
    return changed;
}

bool drawLife(Scene& scene, size_t index, KeyRows& rows) {
    Group& group = scene.groups[index];
    Lifecycle& life = *group.life;
    KeyRows::Owns owns = {{"capacity", [&] { return drawCapacity(group, life); }}};
    if (group.particle)
        for (const char* key : {"scale", "turn", "spin", "grow", "shrink"})
            owns[key] = {};
    if (life.emitters.empty() || emitsFromDeaths(life)) owns["allocator"] = {};
    return rows.draw(life, owns);
}

}  // namespace shoal::window
