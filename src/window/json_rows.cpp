#include "window/json_rows.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "core/json_build.h"
#include "window/color_keys.h"
#include "window/edit_widgets.h"
#include "window/new_elements.h"

namespace shoal::window {

namespace {

using Kind = Key::Kind;
using Json = JsonValue::Kind;

JsonValue asJson(const std::vector<double>& numbers, bool list) {
    return list ? toJson(numbers) : JsonValue::makeNumber(numbers[0]);
}

bool isWhole(const Key& key) {
    return key.kind->row(key, {}) == RowForm::wholes;
}

bool drawWord(const Row& row, JsonValue& value, const std::vector<std::string>& words) {
    const std::optional<size_t> chosen = choose(row, value.text, words);
    if (chosen) value = JsonValue::makeString(words[*chosen]);
    return chosen.has_value();
}

// Returns the words between commas.
std::vector<std::string> wordsIn(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream all(text);
    for (std::string word; std::getline(all, word, ',');) {
        const size_t begin = word.find_first_not_of(' ');
        if (begin != std::string::npos)
            out.push_back(word.substr(begin, word.find_last_not_of(' ') + 1 - begin));
    }
    return out;
}

// A kind of a variant that has one, by the word that chooses it.
const Description* alternativeOf(const Key& key, const JsonValue& object) {
    const JsonValue* word = object.find(key.name);
    for (const Description* alternative : key.objects)
        if (word && word->text == alternative->name()) return alternative;
    return nullptr;
}

}  // namespace

std::string titleOf(const JsonValue& element, size_t index) {
    for (const char* key : {"name", "type", "from"})
        if (const JsonValue* value = element.find(key); value && !value->text.empty()) return value->text;
    for (const char* key : {"molecule", "file"})
        if (const JsonValue* value = element.find(key))
            return std::filesystem::path(value->text).stem().string();
    return std::to_string(index + 1);
}

// ---- New elements

void JsonRows::begin(const Scene& scene) {
    places_.clear();
    scene_ = &scene;
}

// Draws the button that adds to a list, and what there is to choose from.
std::optional<JsonValue> JsonRows::addedTo(const Key& key, const JsonValue& list) {
    std::optional<JsonValue> out;
    if (key.name == "groups") {
        if (const auto molecule = molecules_.add("Add", scene_->file))
            out = groupOf(list, *molecule, *scene_);
        return out;
    }
    const Description& element = *key.objects[0];
    const Key* kinds = variantOf(element);
    if (ImGui::SmallButton("Add")) {
        if (kinds)
            ImGui::OpenPopup("kinds");
        else
            out = key.name == "emitters" ? newEmitter(list) : smallestObject(element, text());
    }
    tip(element.sentence());
    if (!kinds || !ImGui::BeginPopup("kinds")) return out;
    for (const Description* kind : kinds->objects) {
        if (ImGui::Selectable(kind->name().c_str())) out = smallestObject(element, *kind, text());
        tip(kind->sentence());
    }
    if (out && key.name == "colliders") standInView(*out, *scene_);
    ImGui::EndPopup();
    return out;
}

TextOf JsonRows::text() const {
    return [this](const Key& key) {
        const std::vector<std::string> words = choices_(key.name);
        return words.empty() ? key.name : words.front();
    };
}

// ---- Rows

bool JsonRows::draw(const Description& keys, JsonValue& object, const void* runs) {
    bool changed = false;
    for (const Key& key : keys.keys()) {
        if (key.name == "$schema" || key.name == "format" || !meansSomething(keys, key, object)) continue;
        ImGui::PushID(key.name.c_str());
        changed |= key.kind == Kind::variant ? drawKind(key, object, runs) : drawKey(keys, key, object, runs);
        ImGui::PopID();
    }
    if (!changed) return false;
    // what a word or a tick has made meaningless or necessary
    for (const Key& key : keys.keys())
        if (!meansSomething(keys, key, object)) leaveOut(object, key.name);
    addNeeded(keys, text(), object);
    return true;
}

// What a key begins with: what acts now, if anything does.
JsonValue JsonRows::ticked(const Key& key, const void* runs) const {
    JsonValue out;
    if (runs && key.acts) out = key.acts(runs);
    const void* value = runs && key.kind->write && key.kind != Kind::byHand ? key.value(runs) : nullptr;
    if (value && key.kind->numbers) out = key.kind->write(key, value, nullptr, scene_);
    const std::vector<double> numbers = numbersOf(out);
    const bool finite =
        std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
    return out.kind == Json::null || !finite ? key.kind->least(key, text()) : out;
}

// The row of a key changes what the object says of it, or whether it says anything.
bool JsonRows::drawKey(const Description& keys, const Key& key, JsonValue& object, const void* runs) {
    JsonValue* found = object.find(key.name) ? &memberOf(object, key.name) : nullptr;
    JsonValue fresh = keys.usualValue(key);
    const bool tree = key.kind == Kind::list || (key.kind == Kind::object && !key.member.optional);
    const bool mayBeEmpty = key.kind == Kind::text && !key.needed;
    // what has no value of its own where it is left out gets a box to tick
    const bool ticks = !tree && !mayBeEmpty && !key.needed && fresh.kind == Json::null;
    if (tree && !found) fresh = key.kind == Kind::list ? JsonValue::makeArray() : JsonValue::makeObject();
    if (mayBeEmpty && !found) fresh = JsonValue::makeString("");
    const void* within = runs && key.kind != Kind::byHand ? key.value(runs) : nullptr;
    bool says = found != nullptr;
    if (ticks && !found) {
        const std::string label = inWords(key.name);
        if (!tick({label.c_str(), key.says.sentence.c_str()}, says)) return false;
        setMember(object, key.name, ticked(key, runs)), fresh_ = ImGui::GetID("node");
        return true;
    }
    JsonValue& value = found ? *found : fresh;
    if (inList_) addPlaces(key, value, object);
    bool* const mayTick = ticks ? &says : nullptr;
    const bool node = tree || (ticks && key.kind->row(key, value) == RowForm::node);
    const bool changed =
        node ? drawNode(key, value, within, mayTick) : drawPresent(keys, key, value, mayTick);
    if (ticks && !says) leaveOut(object, key.name);
    if (ticks || !changed) return changed || says != (found != nullptr);
    const bool empty = tree ? value.items.empty() && value.members.empty() : mayBeEmpty && value.text.empty();
    if (empty && !key.needed)
        leaveOut(object, key.name);
    else if (!found)
        setMember(object, key.name, std::move(fresh));
    return true;
}

// A node that holds a list or the keys of an object. `says`: whether the file says anything of it, which a
// box to tick changes.
bool JsonRows::drawNode(const Key& key, JsonValue& value, const void* runs, bool* says) {
    const std::string count = key.kind == Kind::list ? concat(" (", value.items.size(), ")") : std::string();
    const bool starts =
        !value.items.empty() && std::find(opens.begin(), opens.end(), key.name) != opens.end();
    if (fresh_ == ImGui::GetID("node")) ImGui::SetNextItemOpen(true), fresh_ = 0;
    const bool open = ImGui::TreeNodeEx(
        concat(inWords(key.name), count, "###node").c_str(),
        (starts ? ImGuiTreeNodeFlags_DefaultOpen : 0) | (says ? ImGuiTreeNodeFlags_FramePadding : 0));
    tip(key.says.sentence.c_str());
    if (says) {
        besideLabel();
        ImGui::Checkbox("##says", says);
    }
    if (!open) return false;
    const bool changed =
        key.kind == Kind::list ? drawList(key, value, runs) : draw(*key.objects[0], value, runs);
    ImGui::TreePop();
    return changed;
}

bool JsonRows::drawPresent(const Description& keys, const Key& key, JsonValue& value, bool* says) {
    const std::string label = inWords(key.name);
    Row row{label.c_str(), key.says.sentence.c_str()};
    row.says = says;
    switch (key.kind->row(key, value)) {
    case RowForm::tick:
        return tick(row, value.boolean);
    case RowForm::word:
        return drawWord(row, value, key.words);
    case RowForm::text:
        return drawText(key, value, row);
    case RowForm::texts:
        return drawTexts(row, value);
    case RowForm::color: {
        const std::vector<double> current = numbersOf(value);
        if (current.size() != 3) return false;
        glm::dvec3 color(current[0], current[1], current[2]);
        if (!pickColor(row, {0, std::min(key.says.range.most, 1000.0)}, color)) return false;
        constexpr double rounding = 0.0005;  // of channels that were not touched
        for (int i = 0; i < 3; ++i)
            if (std::abs(color[i] - current[size_t(i)]) <= rounding) color[i] = current[size_t(i)];
        value = toJson(color);
        return true;
    }
    case RowForm::box: {
        bool changed = false;
        for (const char* end : {"low", "high"}) {
            const std::string own = concat(label, ", ", end);
            row.label = own.c_str();
            if (value.find(end)) changed |= drawNumbers(key, memberOf(value, end), row);
            row.says = nullptr;
        }
        return changed;
    }
    case RowForm::rotation:
        return drawRotation(row, value);
    case RowForm::direction:
        return drawDirection(row, value);
    case RowForm::span:
        return drawSpan(keys, key, value, row);
    default:
        return drawNumbers(key, value, row);
    }
}

// Between commas.
bool JsonRows::drawTexts(const Row& row, JsonValue& value) {
    std::string words;
    for (const JsonValue& item : value.items)
        words += (words.empty() ? "" : ", ") + item.text;
    if (!type(row, words)) return false;
    value = toJson(wordsIn(words));
    return true;
}

bool JsonRows::drawDirection(const Row& row, JsonValue& value) {
    const std::vector<double> stored = numbersOf(value);
    if (stored.size() != 3) return false;
    glm::dvec3 direction(stored[0], stored[1], stored[2]);
    if (glm::length(direction) > 0) direction = glm::normalize(direction);
    if (row.says) tick({row.label, row.tip}, *row.says);
    if (!turnDirection(row.tip, direction, angles_[ImGui::GetID("angles")])) return false;
    value = toJson(direction);
    return true;
}

// Null: the description tells nothing of how far a slider would go.
Slider* JsonRows::sliderOf(const Key& key, const std::vector<double>& numbers) {
    const bool slides = key.kind->numbers && (numbers.size() == 1 || key.kind->form == RowForm::span);
    const bool share = key.says.range.least >= -10 && key.says.range.most <= 10;
    if (!slides || (key.says.slider.least == key.says.slider.most && !share)) return nullptr;
    Slider slider = shoal::sliderOf(key, numbers);
    slider.least = std::max(slider.least, key.says.range.least);  // 0 is not said, but left out
    return &sliders_.try_emplace(ImGui::GetID("slider"), slider).first->second;
}

namespace {

bool isAngle(const Key& key) {
    return key.says.unit.starts_with("rad");
}

// How the number of a row is written. Angles are shown in degrees.
std::string formatOf(const Key& key, const Slider* slider) {
    std::string digits = isWhole(key) ? "%.0f" : "%.5g";
    // ImGui takes the decimals for the smallest number of a logarithmic slider that begins at 0.
    if (slider && slider->steep && slider->least <= 0 && !isWhole(key))
        digits = concat("%.", std::clamp(4 - int(std::floor(std::log10(slider->most))), 1, 9), "f");
    if (isAngle(key)) return concat(digits, "\xC2\xB0", key.says.unit.substr(3));
    return key.says.unit.empty() || key.kind == Kind::byHand ? digits : concat(digits, " ", key.says.unit);
}

Limit numberLimit(const Key& key) {
    const Limit limit =
        key.kind == Kind::byHand ? Limit{key.form.range.least, key.form.range.most} : limitOf(key);
    return {std::max(limit.least, -largestNumber), std::min(limit.most, largestNumber)};
}

// Makes a slider reach what was typed.
void stretch(Slider& slider, const std::vector<double>& numbers) {
    for (const double number : numbers) {
        slider.least = std::min(slider.least, number);
        slider.most = std::max(slider.most, number);
    }
}

// By how much a pixel moves numbers that are shown times `scale`.
double dragSpeed(const Key& key, const std::vector<double>& numbers, double scale) {
    double largest = 0;
    for (const double number : numbers)
        largest = std::max(largest, std::abs(number * scale));
    return std::max(isWhole(key) ? 0.2 : 0.005, largest / 200);
}

// As many digits as were seen.
double rounded(const Key& key, double number) {
    return isWhole(key) ? std::round(number) : std::stod(formatted("%.6g", number));
}

}  // namespace

// Two numbers of which a file may say one.
bool JsonRows::drawSpan(const Description& keys, const Key& key, JsonValue& value, Row row) {
    const std::vector<double> stored = numbersOf(value);
    if (stored.empty() || stored.size() > 2) return drawNumbers(key, value, row);
    Slider* slider = sliderOf(key, stored);
    glm::dvec2 span(stored.front(), stored.back());
    const std::vector<double> usual = numbersOf(keys.usualValue(key));
    if (key.kind == Kind::ends && stored.size() == 1 && !usual.empty()) span.x = usual.front();
    const glm::dvec2 before = span;
    const std::string format = formatOf(key, slider);
    row.format = format.c_str();
    row.scale = isAngle(key) ? degrees : 1;
    row.free = key.kind == Kind::ends;
    row.steep = slider && slider->steep;
    if (slider ? !slideSpan(row, {slider->least, slider->most}, numberLimit(key), span)
               : !drag(row, numberLimit(key), &span.x, 2, dragSpeed(key, stored, row.scale)))
        return false;
    for (int i = 0; i < 2; ++i)
        if (span[i] != before[i]) span[i] = rounded(key, span[i]);
    if (slider) stretch(*slider, {span.x, span.y});
    const bool single = key.kind == Kind::span ? span.x == span.y : !usual.empty() && span.x == usual.front();
    value = single ? JsonValue::makeNumber(span.y) : toJson(span);
    return true;
}

bool JsonRows::drawNumbers(const Key& key, JsonValue& value, Row row) {
    std::vector<double> numbers = numbersOf(value);
    const std::vector<double> stored = numbers;
    if (numbers.empty() || numbers.size() > 4) {  // only in the file
        beginRow(row);
        ImGui::TextDisabled("%s", writeJsonLine(value).substr(0, 40).c_str());
        return false;
    }
    Slider* slider = sliderOf(key, numbers);
    const std::string format = numbers.size() > 1 && !isAngle(key) ? "%.5g" : formatOf(key, slider);
    row.format = format.c_str();
    row.scale = isAngle(key) ? degrees : 1;
    row.steep = slider && slider->steep;
    const bool slides = slider && numbers.size() == 1;
    if (slides ? !slide(row, {slider->least, slider->most}, numberLimit(key), numbers[0])
               : !drag(row, numberLimit(key), numbers.data(), int(numbers.size()),
                       dragSpeed(key, numbers, row.scale)))
        return false;
    for (size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] != stored[i]) numbers[i] = rounded(key, numbers[i]);
    if (slides) stretch(*slider, numbers);
    value = asJson(numbers, value.kind == Json::array);
    return true;
}

bool JsonRows::drawText(const Key& key, JsonValue& value, const Row& row) {
    if (key.name == "molecule" && scene_) {
        const std::optional<std::string> chosen = molecules_.choose(row, value.text, scene_->file);
        if (chosen) value = toJson(*chosen);
        return chosen.has_value();
    }
    const std::vector<std::string> words = choices_(key.name);
    return words.empty() ? type(row, value.text) : drawWord(row, value, words);
}

// The word that says what an object is, and the keys that go with it.
bool JsonRows::drawKind(const Key& key, JsonValue& object, const void* runs) {
    const std::string current = object.find(key.name) ? object.find(key.name)->text : std::string();
    std::vector<std::string> words;
    for (const Description* alternative : key.objects)
        words.push_back(alternative->name());
    const std::optional<size_t> chosen = choose(rowOf(key), current, words);
    if (chosen) {
        if (const Description* before = alternativeOf(key, object))
            for (const Key& own : before->keys())
                if (!key.objects[*chosen]->find(own.name)) leaveOut(object, own.name);
        setMember(object, key.name, JsonValue::makeString(words[*chosen]));
        for (JsonMember& member : smallestObject(*key.objects[*chosen], text()).members)
            if (!object.find(member.first)) object.add(member.first, std::move(member.second));
        return true;
    }
    const Description* kind = alternativeOf(key, object);
    const void* variant = runs ? key.value(runs) : nullptr;
    const bool same = variant && kind == key.objects[size_t(key.member.index(variant))];
    return kind && draw(*kind, object, same ? key.member.held(variant) : nullptr);
}

bool JsonRows::drawList(const Key& key, JsonValue& list, const void* runs) {
    const Description& element = *key.objects[0];
    const bool within = std::exchange(inList_, true);
    const bool colors = key.name == "colors";
    const bool same = runs && key.member.count && key.member.count(runs) == list.items.size();
    const bool starts = std::find(opens.begin(), opens.end(), key.name) != opens.end();
    bool changed = false;
    std::optional<size_t> copied, removed;
    if (colors) drawColorBar(list);
    for (size_t i = 0; i < list.items.size(); ++i) {
        ImGui::PushID(int(i));
        const bool fresh = fresh_ == ImGui::GetID("element");
        if (fresh) ImGui::SetNextItemOpen(true), fresh_ = 0;
        if (ImGui::TreeNodeEx(concat(titleOf(list.items[i], i), "###element").c_str(),
                              starts && list.items.size() == 1 ? ImGuiTreeNodeFlags_DefaultOpen : 0)) {
            if (fresh && !ImGui::IsItemVisible()) ImGui::SetScrollHereY(0.1f);
            if (!colors && ImGui::SmallButton("Duplicate")) copied = i;
            if (!colors) ImGui::SameLine();
            if (ImGui::SmallButton("Remove")) removed = i;
            const bool edited = draw(element, list.items[i], same ? key.member.element(runs, i) : nullptr);
            if (edited && colors) keepAge(list, i);
            changed |= edited;
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    inList_ = within;
    std::optional<std::pair<size_t, JsonValue>> added;  // where, and what
    if (copied) added.emplace(*copied + 1, list.items[*copied]);
    if (removed) list.items.erase(list.items.begin() + std::ptrdiff_t(*removed)), changed = true;
    if (colors) {
        if (ImGui::SmallButton("Add")) addColorKey(list), changed = true;
        tip(element.sentence());
    } else if (std::optional<JsonValue> item = addedTo(key, list)) {
        added.emplace(list.items.size(), std::move(*item));
    }
    if (added) {
        auto& [index, item] = *added;
        if (const JsonValue* own = item.find("name"); own && !own->text.empty())
            setMember(item, "name", JsonValue::makeString(freeName(list, own->text)));
        list.items.insert(list.items.begin() + std::ptrdiff_t(index), std::move(item));
        ImGui::PushID(int(index));
        fresh_ = ImGui::GetID("element");
        ImGui::PopID();
        changed = true;
    }
    if (changed) places_.clear();  // they have moved
    return changed;
}

}  // namespace shoal::window
