#include "window/group_editors.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "window/edit_widgets.h"

namespace shoal::window {

namespace {

using From = Emitter::From;
using Along = Emitter::Along;

constexpr double degrees = 57.29577951308232;
constexpr int kinds = int(From::death) + 1;

std::string titleOf(const Emitter& emitter, size_t index) {
    const std::string kind = name(emitter.from);
    return emitter.name.empty() ? concat("emitter ", index + 1, ": ", kind)
                                : concat(emitter.name, ": ", kind);
}

// Whether some way along the deaths leads from `from` to the group: then it cannot be born from the group's.
bool bearsFrom(const Scene& scene, const Group& group, const std::string& from, size_t depth = 0) {
    if (group.name == from || depth > scene.groups.size()) return true;
    if (!group.life) return false;
    for (const Emitter& emitter : group.life->emitters) {
        if (emitter.from != From::death) continue;
        for (const Group& source : scene.groups)
            if (source.name == emitter.group && bearsFrom(scene, source, from, depth + 1)) return true;
    }
    return false;
}

// Names of groups from whose deaths this one can be born.
std::vector<std::string> dyingGroups(const Scene& scene, const Group& group) {
    std::vector<std::string> out;
    for (const Group& other : scene.groups)
        if (other.life && !bearsFrom(scene, other, group.name)) out.push_back(other.name);
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

template <typename Names, typename NameOf>
bool pickName(const Row& row, const Names& all, const NameOf& nameOf, std::string current, std::string& out) {
    beginRow(row);
    bool changed = false;
    if (!ImGui::BeginCombo((std::string("##") + row.label).c_str(), current.c_str())) return false;
    for (const auto& one : all) {
        const std::string& name = nameOf(one);
        if (!ImGui::Selectable(name.c_str(), name == current)) continue;
        out = name;
        changed = name != current;
    }
    ImGui::EndCombo();
    return changed;
}

}  // namespace

LifeEditor::LifeEditor(const Scene& scene, size_t group) : group_(group) {
    const Lifecycle& life = *scene.groups[group].life;
    limits_ = limitsOf(life, scene.groups[group].count);
    if (life.life.y < longestLife) span_ = life.life;
    if (life.within) within_ = *life.within;
    if (life.afterContact) afterContact_ = *life.afterContact;
}

bool LifeEditor::drawEmitters(Scene& scene) {
    Lifecycle& life = *scene.groups[group_].life;
    angles_.resize(life.emitters.size());
    bool changed = false;
    for (size_t e = 0; e < life.emitters.size(); ++e) {
        ImGui::PushID(int(e));
        const int flags = life.emitters.size() == 1 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
        if (ImGui::TreeNodeEx("emitter", flags, "%s", titleOf(life.emitters[e], e).c_str())) {
            changed |= drawEmitter(scene, e);
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
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Another one beside these, like the last.");
    return changed;
}

bool LifeEditor::drawEmitter(Scene& scene, size_t index) {
    Lifecycle& life = *scene.groups[group_].life;
    Emitter& emitter = life.emitters[index];
    bool changed = drawWhen(emitter);
    changed |= drawKind(scene, emitter, life);
    changed |= drawPlace(scene, emitter);
    changed |= drawVelocity(emitter, angles_[index]);
    if (emitter.from != From::death) changed |= drawBursts(emitter);
    // a group of which none is there and none is born would be nothing
    if (life.emitters.size() == 1 && scene.groups[group_].count == 0) return changed;
    if (emitter.from != From::death) ImGui::SameLine();
    if (ImGui::SmallButton("Remove")) {
        life.emitters.erase(life.emitters.begin() + std::ptrdiff_t(index));
        angles_.erase(angles_.begin() + std::ptrdiff_t(index));
        changed = true;
    } else if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("Takes this emitter away; what it bore lives on.");
    }
    return changed;
}

bool LifeEditor::drawKind(const Scene& scene, Emitter& emitter, Lifecycle& life) const {
    const std::vector<std::string> dying = dyingGroups(scene, scene.groups[group_]);
    const auto possible = [&](From from) {
        if (from == emitter.from) return true;
        if (from == From::surface) return !scene.models.empty();
        return from != From::death || !dying.empty();
    };
    beginRow({"from", "What it bears from."});
    bool changed = false;
    if (!ImGui::BeginCombo("##from", name(emitter.from))) return false;
    for (int kind = 0; kind < kinds; ++kind) {
        const From from = From(kind);
        if (!possible(from)) continue;
        if (!ImGui::Selectable(name(from), from == emitter.from) || from == emitter.from) continue;
        become(emitter, from, scene, dying.empty() ? "" : dying.front());
        if (from == From::death) life.allocator = Allocator::gpu;  // the only one that can
        changed = true;
    }
    ImGui::EndCombo();
    return changed;
}

bool LifeEditor::drawPlace(const Scene& scene, Emitter& emitter) const {
    bool changed = false;
    const Limit& far = limits_.position;
    switch (emitter.from) {
    case From::point:
        return drag({"position", "Where it is, in metres.", "%.5g"}, far, &emitter.position.x, 3, 0.01);
    case From::line:
        changed =
            drag({"start", "One end of the line, in metres.", "%.5g"}, far, &emitter.lineFrom.x, 3, 0.01);
        return drag({"end", "The other end of the line, in metres.", "%.5g"}, far, &emitter.lineTo.x, 3,
                    0.01) ||
               changed;
    case From::disc:
    case From::sphere:
        changed = drag({"position", "Its middle, in metres.", "%.5g"}, far, &emitter.position.x, 3, 0.01);
        changed |= slide({"radius", "How large it is.", "%.3f m", true}, limits_.radius, emitter.radius);
        return slide({"hollow", "The share of the radius that is left out.", "%.0f %%", false, 100},
                     limits_.hollow, emitter.hollow) ||
               changed;
    case From::box: {
        changed =
            drag({"low", "The box's lowest corner, in metres.", "%.5g"}, far, &emitter.box.low.x, 3, 0.01);
        if (changed) emitter.box.high = glm::max(emitter.box.high, emitter.box.low);
        if (!drag({"high", "The box's highest corner, in metres.", "%.5g"}, far, &emitter.box.high.x, 3,
                  0.01))
            return changed;
        emitter.box.low = glm::min(emitter.box.low, emitter.box.high);
        return true;
    }
    case From::surface: {
        std::string chosen;
        if (!pickName(
                {"model", "Each patch bears by its area."}, scene.models,
                [](const Model& model) { return model.name; }, scene.models[size_t(emitter.model)].name,
                chosen))
            return false;
        for (size_t m = 0; m < scene.models.size(); ++m)
            if (scene.models[m].name == chosen) emitter.model = int(m);
        emitter.select = {};  // of the other model's parts
        return true;
    }
    case From::death:
        changed = pickName(
            {"deaths of", "It bears where one of that group dies."}, dyingGroups(scene, scene.groups[group_]),
            [](const std::string& name) { return name; }, emitter.group, emitter.group);
        return slide({"for each", "How many are born for each that dies.", "%d"}, limits_.perDeath,
                     emitter.perDeath) ||
               changed;
    }
    return false;
}

bool LifeEditor::drawWhen(Emitter& emitter) const {
    if (emitter.from == From::death) return false;
    bool changed =
        slide({"rate", "How many are born a second.", "%.1f Hz", true}, limits_.rate, emitter.rate);
    changed |= tick({"at random", "At random moments of that rate, else evenly."}, emitter.random);
    if (slide({"begin", "The time at which it begins.", "%.2f s"}, limits_.time, emitter.begin)) {
        emitter.end = std::max(emitter.end, emitter.begin + 0.01);
        changed = true;
    }
    bool ends = std::isfinite(emitter.end);
    if (tick({"ends", "Whether it stops at some time."}, ends)) {
        emitter.end = ends ? emitter.begin + 5 : std::numeric_limits<double>::infinity();
        changed = true;
    }
    if (ends)
        changed |=
            slide({"until", "The time at which it stops.", "%.2f s"},
                  {emitter.begin + 0.01, std::max(limits_.time.most, emitter.begin + 60)}, emitter.end);
    return changed;
}

bool LifeEditor::drawBursts(Emitter& emitter) const {
    bool changed = false;
    for (size_t b = 0; b < emitter.bursts.size(); ++b) {
        Burst& burst = emitter.bursts[b];
        ImGui::PushID(int(b));
        changed |=
            slide({"burst", "How many are born at that moment.", "%d", true}, limits_.count, burst.count);
        changed |= slide({"  at", "When.", "%.2f s"}, limits_.time, burst.time);
        if (slide({"  again after", "0: only once.", "%.2f s"}, limits_.every, burst.every)) {
            if (burst.every < 0.02) burst.every = 0;
            changed = true;
        }
        if (ImGui::SmallButton("Remove this burst")) {
            emitter.bursts.erase(emitter.bursts.begin() + std::ptrdiff_t(b--));
            changed = true;
        }
        ImGui::PopID();
    }
    if (ImGui::SmallButton("Add a burst")) {
        emitter.bursts.push_back({0, 100, 2});
        changed = true;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Many at one moment, once or again and again.");
    return changed;
}

bool LifeEditor::drawVelocity(Emitter& emitter, glm::dvec2& angles) const {
    bool changed = false;
    int along = int(emitter.along);
    const bool sides = emitter.from != From::line && emitter.from != From::box;
    if (sides && pick({"along", "Where they fly: one way for all, or away from the middle."},
                      {"a direction", "outward"}, along)) {
        emitter.along = Along(along);
        changed = true;
    }
    const bool across = emitter.from == From::disc;  // which stands across the direction
    if (emitter.along == Along::direction || across)
        changed |=
            turnDirection("How far the direction points above the horizon.", emitter.direction, angles);
    changed |=
        slide({"spread", "Half the opening of the cone about the direction.", "%.1f\xC2\xB0", false, degrees},
              limits_.spread, emitter.spread);
    changed |=
        slideSpan({"speed", "Least and most speed at birth.", "%.2f m/s"}, limits_.speed, emitter.speed);
    if (emitter.path || emitter.from == From::death)
        changed |= slide({"inherit", "The share of the velocity of what bears them.", "%.2f"},
                         limits_.inherit, emitter.inherit);
    return changed;
}

bool LifeEditor::drawLife(Scene& scene) {
    Group& group = scene.groups[group_];
    Lifecycle& life = *group.life;
    bool forEver = life.life.y >= longestLife;
    bool changed = tick({"for ever", "Whether they live until something else ends them."}, forEver);
    if (changed) life.life = forEver ? glm::dvec2(longestLife) : span_;
    if (!forEver &&
        slideSpan({"span", "Shortest and longest life.", "%.2f s", true}, limits_.life, life.life)) {
        span_ = life.life;
        changed = true;
    }
    changed |= drawEnds(life);
    if (!group.particle) changed |= drawNewborn(life);
    changed |= drawPlaces(group, life);
    if (changed) settle(life, group.count);
    if (life.within) within_ = *life.within;
    if (life.afterContact) afterContact_ = *life.afterContact;
    return changed;
}

bool LifeEditor::drawEnds(Lifecycle& life) const {
    bool outside = life.within.has_value(), contact = life.afterContact.has_value();
    bool changed = tick({"dies outside", "Whether what leaves a box dies."}, outside);
    if (changed) life.within = outside ? std::optional(within_) : std::nullopt;
    if (life.within) {
        changed |= drag({"  low", "The box's lowest corner, in metres.", "%.5g"}, limits_.position,
                        &life.within->low.x, 3, 0.01);
        changed |= drag({"  high", "The box's highest corner, in metres.", "%.5g"}, limits_.position,
                        &life.within->high.x, 3, 0.01);
    }
    if (tick({"dies touching", "Whether what touches a collider has only so long to live."}, contact)) {
        life.afterContact = contact ? std::optional(afterContact_) : std::nullopt;
        changed = true;
    }
    if (life.afterContact)
        changed |= slide({"  after", "How long it lives on then.", "%.2f s"}, limits_.afterContact,
                         *life.afterContact);
    return changed;
}

bool LifeEditor::drawNewborn(Lifecycle& life) const {
    bool changed =
        slideSpan({"scale", "Smallest and largest size of newborns.", "%.2f"}, limits_.scale, life.scale);
    int turn = int(life.turn);
    if (pick({"turn", "How newborns are turned."}, {"none", "yaw", "any"}, turn)) {
        life.turn = Placement::Turn(turn);
        changed = true;
    }
    double spin = std::max({life.spin.x, life.spin.y, life.spin.z});
    if (slide({"spin", "How fast newborns turn at most, about each axis.", "%.1f\xC2\xB0/s", false, degrees},
              limits_.spin, spin)) {
        const double most = std::max({life.spin.x, life.spin.y, life.spin.z});
        life.spin = most > 0 ? life.spin * (spin / most) : glm::dvec3(spin);
        changed = true;
    }
    changed |=
        slide({"grow", "They are drawn growing for so long at birth.", "%.2f s"}, limits_.grow, life.grow);
    changed |= slide({"shrink", "They are drawn shrinking for so long before death.", "%.2f s"}, limits_.grow,
                     life.shrink);
    return changed;
}

bool LifeEditor::drawPlaces(const Group& group, Lifecycle& life) const {
    bool changed = false;
    int allocator = int(life.allocator);
    const bool deaths = std::any_of(life.emitters.begin(), life.emitters.end(),
                                    [](const Emitter& e) { return e.from == From::death; });
    if (!life.emitters.empty() && !deaths &&
        pick({"allocator", "How a newborn finds a free place; ring takes the oldest one's."},
             {"gpu", "ring", "stack", "heap"}, allocator)) {
        life.allocator = Allocator(allocator);
        changed = true;
    }
    if (!life.emitters.empty())
        changed |= slide({"capacity", "How many there may be; more find no place.", "%d", true},
                         limits_.capacity, life.capacity);
    const std::optional<int> usual = usualCapacity(group.count, life);
    if (!life.emitters.empty() && usual && *usual != life.capacity && *usual <= limits_.capacity.most) {
        beginRow({"", ""});
        if (ImGui::SmallButton(concat("Fit: ", *usual).c_str())) life.capacity = *usual, changed = true;
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("As many as these rates and lives can have at once.");
    }
    return changed;
}

}  // namespace shoal::window
