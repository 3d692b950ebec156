#include "window/key_rows.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "window/edit_widgets.h"

namespace shoal::window {

namespace {

using Kind = Key::Kind;

// Angles are shown in degrees.
Row formattedRow(const std::string& label, const Key& key, std::string& format, const Slider& slider) {
    Row row{label.c_str(), key.says.sentence.c_str()};
    const std::string& unit = key.says.unit;
    const bool angle = unit.starts_with("rad");
    if (angle) row.scale = degrees;
    std::string digits = key.kind == Kind::whole ? "%d" : "%.5g";
    // ImGui takes the decimals for the smallest number of a logarithmic slider that begins at 0.
    if (slider.steep && slider.least <= 0 && key.kind != Kind::whole)
        digits = concat("%.", std::clamp(4 - int(std::floor(std::log10(slider.most))), 1, 9), "f");
    format = angle          ? concat(digits, "\xC2\xB0", unit.substr(3))
             : unit.empty() ? digits
                            : concat(digits, " ", unit);
    row.format = format.c_str();
    row.steep = slider.steep;
    row.free = key.kind == Kind::ends;
    return row;
}

bool dragBox(const Key& key, const Limit& limit, Box& box) {
    const std::string low = concat(inWords(key.name), ", low"), high = concat(inWords(key.name), ", high");
    const char* sentence = key.says.sentence.c_str();
    bool changed = drag({low.c_str(), sentence, "%.5g"}, limit, &box.low.x, 3, 0.01);
    if (changed) box.high = glm::max(box.high, box.low + (key.flatBox ? 0 : 0.01));
    if (drag({high.c_str(), sentence, "%.5g"}, limit, &box.high.x, 3, 0.01)) {
        box.low = glm::min(box.low, box.high - (key.flatBox ? 0 : 0.01));
        changed = true;
    }
    return changed;
}

bool hasRow(const Key& key) {
    const KeyKind* const kinds[] = {&Kind::number,  &Kind::whole,   &Kind::flag,      &Kind::word,
                                    &Kind::vector2, &Kind::vector3, &Kind::direction, &Kind::color,
                                    &Kind::span,    &Kind::ends,    &Kind::box,       &Kind::object,
                                    &Kind::list};
    return std::find(std::begin(kinds), std::end(kinds), key.kind) != std::end(kinds);
}

// A number that stands for none, as of what lives for ever.
bool isEndless(const Key& key, const void* value) {
    if (!value || key.usual.empty()) return false;
    if (key.kind == Kind::number) return *static_cast<const double*>(value) > largestNumber;
    return key.kind == Kind::span && static_cast<const glm::dvec2*>(value)->y > largestNumber;
}

}  // namespace

std::string inWords(const std::string& key) {
    std::string out;
    for (const char c : key) {
        if (std::isupper(static_cast<unsigned char>(c))) out += ' ';
        out += char(std::tolower(static_cast<unsigned char>(c)));
    }
    return out;
}

std::string KeyRows::ruleBroken(const std::function<void()>& check) {
    try {
        check();
        return {};
    } catch (const Error& error) {
        return error.message();
    }
}

bool KeyRows::drawKeys(const Description& keys, void* object, const Owns& owns) {
    bool changed = false;
    for (const Key& key : keys.keys()) {
        if (keys.unmet(key, object)) continue;
        ImGui::PushID(key.name.c_str());
        if (const auto own = owns.find(key.name); own != owns.end())
            changed |= own->second && own->second();
        else if (hasRow(key))
            changed |= drawKey(key, object);
        ImGui::PopID();
    }
    return changed;
}

// Draws the box to tick for a value that may be absent; its own row is below it.
bool KeyRows::drawPresence(const Key& key, void* object) {
    const void* value = key.value(object);
    const bool endless = isEndless(key, value);
    bool given = value && !endless;
    const std::string label = inWords(key.name);
    if (!tick({label.c_str(), key.says.sentence.c_str()}, given)) return false;
    const Slider slider = sliderOf(key, object);
    const double middle =
        slider.steep ? std::sqrt(slider.least * slider.most) : 0.5 * (slider.least + slider.most);
    if (key.kind == Kind::number && !key.member.optional)
        *static_cast<double*>(key.place(object)) = given ? middle : std::numeric_limits<double>::infinity();
    else if (key.kind == Kind::span)
        *static_cast<glm::dvec2*>(key.place(object)) = glm::dvec2(given ? middle : 1e30);
    else if (!given)
        key.member.reset(key.place(object));
    else if (void* made = key.member.make(key.place(object)); key.kind == Kind::number)
        *static_cast<double*>(made) = middle;
    sliders_.erase(ImGui::GetID("slider"));
    return true;
}

bool KeyRows::drawKey(const Key& key, void* object) {
    bool changed = false;
    const bool mayEnd = !key.usual.empty() && (key.kind == Kind::number || key.kind == Kind::span);
    if (key.member.optional || mayEnd) changed = drawPresence(key, object);
    void* value = const_cast<void*>(key.value(object));
    if (!value || isEndless(key, value)) return changed;
    if (key.kind == Kind::list) return drawList(key, value) || changed;
    if (key.kind == Kind::object && !key.member.optional) {
        ImGui::TextDisabled("%s", inWords(key.name).c_str());
        return drawKeys(*key.objects[0], value, {});
    }
    if (key.kind == Kind::object) {
        if (!ImGui::TreeNodeEx(inWords(key.name).c_str(), ImGuiTreeNodeFlags_DefaultOpen)) return changed;
        changed |= drawKeys(*key.objects[0], value, {});
        ImGui::TreePop();
        return changed;
    }
    const Slider& slider = sliders_.try_emplace(ImGui::GetID("slider"), sliderOf(key, object)).first->second;
    const std::string label = key.member.optional || mayEnd ? std::string() : inWords(key.name);
    return drawValue(key, label, value, slider) || changed;
}

bool KeyRows::drawValue(const Key& key, const std::string& label, void* value, const Slider& slider) {
    std::string format;
    const Row row = formattedRow(label, key, format, slider);
    const Limit limit{slider.least, slider.most};
    if (key.kind == Kind::number) {
        double& number = *static_cast<double*>(value);
        if (!slide(row, limit, number)) return false;
        if (key.unlessZero && number < key.says.range.least) number = 0;
        return true;
    }
    if (key.kind == Kind::whole) return slide(row, limit, *static_cast<int*>(value));
    if (key.kind == Kind::span || key.kind == Kind::ends)
        return slideSpan(row, limit, *static_cast<glm::dvec2*>(value));
    if (key.kind == Kind::vector2) return drag(row, limit, &static_cast<glm::dvec2*>(value)->x, 2, 0.01);
    if (key.kind == Kind::vector3)
        return drag({row.label, row.tip, "%.5g"}, limit, &static_cast<glm::dvec3*>(value)->x, 3, 0.01);
    if (key.kind == Kind::direction)
        return turnDirection(row.tip, *static_cast<glm::dvec3*>(value), angles_[ImGui::GetID("angles")]);
    if (key.kind == Kind::color)
        return pickColor(row, {0, std::min(key.says.range.most, 1000.0)}, *static_cast<glm::dvec3*>(value));
    if (key.kind == Kind::flag) return tick(row, *static_cast<bool*>(value));
    if (key.kind == Kind::box) return dragBox(key, limit, *static_cast<Box*>(value));
    if (key.kind != Kind::word) return false;
    const auto chosen = choose(row, key.words[size_t(key.member.index(value))], key.words);
    if (chosen) key.member.choose(value, int(*chosen));
    return chosen.has_value();
}

// Returns a text that an element needs and that nothing here can enter, such as the name of a group; null:
// none.
static const Key* nameOf(const Description& element) {
    for (const Key& key : element.keys())
        if (key.needed && key.kind == Kind::text) return &key;
    return nullptr;
}

bool KeyRows::drawList(const Key& key, void* list) {
    bool changed = false;
    const Key* name = nameOf(*key.objects[0]);
    for (size_t i = 0; i < key.member.count(list); ++i) {
        const void* element = key.member.element(list, i);
        const std::string title = name ? *static_cast<const std::string*>(name->member.look(
                                             static_cast<const char*>(element) + name->member.offset))
                                       : std::to_string(i + 1);
        ImGui::PushID(int(i));
        if (ImGui::TreeNodeEx("element", ImGuiTreeNodeFlags_DefaultOpen, "%s %s", inWords(key.name).c_str(),
                              title.c_str())) {
            changed |= drawKeys(*key.objects[0], const_cast<void*>(element), {});
            if (ImGui::SmallButton("Remove")) {
                key.member.erase(list, i--);
                changed = true;
            }
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    if (name) return changed;
    if (ImGui::SmallButton(concat("Add to ", inWords(key.name)).c_str())) {
        key.member.append(list);
        changed = true;
    }
    tip(key.says.sentence.c_str());
    return changed;
}

}  // namespace shoal::window
