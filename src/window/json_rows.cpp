#include "window/json_rows.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "core/json_build.h"
#include "core/smallest.h"
#include "window/edit_widgets.h"
#include "window/key_rows.h"

namespace shoal::window {

namespace {

using Kind = Key::Kind;
using Json = JsonValue::Kind;

JsonValue* findIn(JsonValue& object, const std::string& key) {
    return const_cast<JsonValue*>(object.find(key));
}

void leaveOut(JsonValue& object, const std::string& key) {
    std::erase_if(object.members, [&](const JsonMember& member) { return member.first == key; });
}

// A number, or numbers in a list.
std::vector<double> numbersOf(const JsonValue& value) {
    std::vector<double> out;
    if (value.kind == Json::number) out.push_back(value.number);
    for (const JsonValue& item : value.items)
        if (item.kind == Json::number) out.push_back(item.number);
    return out.size() == std::max<size_t>(1, value.items.size()) ? out : std::vector<double>();
}

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

std::string freeName(const JsonValue& list, const std::string& wanted) {
    const auto taken = [&](const std::string& name) {
        return std::any_of(list.items.begin(), list.items.end(), [&](const JsonValue& item) {
            const JsonValue* own = item.find("name");
            return own && own->text == name;
        });
    };
    std::string out = wanted;
    for (int i = 2; taken(out); ++i)
        out = concat(wanted, " ", i);
    return out;
}

}  // namespace

void setMember(JsonValue& object, const std::string& key, JsonValue value) {
    if (JsonValue* found = findIn(object, key))
        *found = std::move(value);
    else
        object.add(key, std::move(value));
}

JsonValue smallestGroup(const JsonValue& groups, const std::string& molecule) {
    const JsonValue box = object(key("low", glm::dvec3(-1, 0.5, -1)), key("high", glm::dvec3(1, 2.5, 1)));
    return object(key("name", freeName(groups, std::filesystem::path(molecule).stem().string())),
                  key("molecule", molecule), key("place", object(key("on", "volume"), key("box", box))),
                  key("count", 100));
}

std::string titleOf(const JsonValue& element, size_t index) {
    for (const char* key : {"name", "type", "from"})
        if (const JsonValue* value = element.find(key); value && !value->text.empty()) return value->text;
    return std::to_string(index + 1);
}

// ---- New elements

TextOf JsonRows::text() const {
    return [this](const Key& key) {
        const std::vector<std::string> words = choices_(key.name);
        return words.empty() ? key.name : words.front();
    };
}

// ---- Rows

bool JsonRows::draw(const Description& keys, JsonValue& object) {
    bool changed = false;
    for (const Key& key : keys.keys()) {
        if (key.name == "$schema" || key.name == "format" || !meansSomething(keys, key, object)) continue;
        ImGui::PushID(key.name.c_str());
        changed |= key.kind == Kind::variant ? drawKind(key, object) : drawKey(keys, key, object);
        ImGui::PopID();
    }
    if (!changed) return false;
    // what a word or a tick has made meaningless or necessary
    for (const Key& key : keys.keys())
        if (!meansSomething(keys, key, object)) leaveOut(object, key.name);
    addNeeded(keys, text(), object);
    return true;
}

// Where something stands, by the words that scenes have for it.
static bool isPlace(const Key& key) {
    constexpr const char* names[] = {"position", "center", "point", "origin", "from", "to"};
    return key.kind == Kind::vector3 &&
           std::find(std::begin(names), std::end(names), key.name) != std::end(names);
}

void JsonRows::addPlaces(const Key& key, const JsonValue& value, JsonValue& object) {
    const auto add = [&](JsonValue& parent, const std::string& name, const JsonValue& numbers) {
        const std::vector<double> coordinates = numbersOf(numbers);
        if (coordinates.size() == 3)
            places_.push_back({&parent, name, {coordinates[0], coordinates[1], coordinates[2]}});
    };
    if (isPlace(key)) add(object, key.name, value);
    JsonValue* box = key.kind == Kind::box ? findIn(object, key.name) : nullptr;
    for (const char* corner : {"low", "high"})
        if (const JsonValue* numbers = box ? box->find(corner) : nullptr) add(*box, corner, *numbers);
}

// The row of a key changes what the object says of it, or whether it says anything.
bool JsonRows::drawKey(const Description& keys, const Key& key, JsonValue& object) {
    JsonValue* found = findIn(object, key.name);
    JsonValue fresh = keys.usualValue(key);
    std::string label = inWords(key.name);
    const bool tree = key.kind == Kind::list || (key.kind == Kind::object && !key.member.optional);
    if (tree && !found) fresh = key.kind == Kind::list ? JsonValue::makeArray() : JsonValue::makeObject();
    const bool mayBeEmpty = key.kind == Kind::text && !key.needed;
    if (mayBeEmpty && !found) fresh = JsonValue::makeString("");
    // what has no value of its own where it is left out gets a box to tick
    if (!tree && !mayBeEmpty && !key.needed && keys.usualValue(key).kind == Json::null) {
        bool says = found != nullptr;
        if (tick({label.c_str(), key.says.sentence.c_str()}, says)) {
            if (says)
                setMember(object, key.name, key.kind->least(key, text()));
            else
                leaveOut(object, key.name);
            return true;
        }
        if (!found) return false;
        label.clear();
    }
    JsonValue& value = found ? *found : fresh;
    if (inList_) addPlaces(key, value, object);
    if (!(tree ? drawNode(key, value, false) : drawPresent(key, value, label))) return false;
    const bool empty = tree ? value.items.empty() && value.members.empty() : mayBeEmpty && value.text.empty();
    if (empty && !key.needed)
        leaveOut(object, key.name);
    else if (!found)
        setMember(object, key.name, std::move(fresh));
    return true;
}

// A node that holds a list or the keys of an object.
bool JsonRows::drawNode(const Key& key, JsonValue& value, bool startsOpen) {
    const std::string count = key.kind == Kind::list ? concat(" (", value.items.size(), ")") : std::string();
    const bool open = ImGui::TreeNodeEx(concat(inWords(key.name), count, "###node").c_str(),
                                        startsOpen ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    tip(key.says.sentence.c_str());
    if (!open) return false;
    const bool changed = key.kind == Kind::list ? drawList(key, value) : draw(*key.objects[0], value);
    ImGui::TreePop();
    return changed;
}

bool JsonRows::drawPresent(const Key& key, JsonValue& value, const std::string& label) {
    const Row row{label.c_str(), key.says.sentence.c_str()};
    switch (key.kind->row(key, value)) {
    case RowForm::tick:
        return tick(row, value.boolean);
    case RowForm::word:
        return drawWord(row, value, key.words);
    case RowForm::text:
        return drawText(key, value, label);
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
            JsonValue* corner = findIn(value, end);
            changed |= corner && drawNumbers(key, *corner, concat(label, ", ", end));
        }
        return changed;
    }
    case RowForm::rotation:
        return drawRotation(key, value, label);
    case RowForm::node:
        return drawNode(key, value, true);
    default:
        return drawNumbers(key, value, label);
    }
}

// An axis and an angle, whether the file has these or a quaternion.
bool JsonRows::drawRotation(const Key& key, JsonValue& value, const std::string& label) {
    glm::dvec3 axis(0, 1, 0);
    double angle = 0;  // degrees
    if (const std::vector<double> q = numbersOf(value); q.size() == 4) {
        const glm::dvec3 imaginary(q[0], q[1], q[2]);
        if (glm::length(imaginary) > 0) axis = glm::normalize(imaginary);
        angle = 2 * std::atan2(glm::length(imaginary), q[3]) * degrees;
    }
    if (const JsonValue* given = value.find("axis"))
        if (const std::vector<double> components = numbersOf(*given); components.size() == 3)
            axis = {components[0], components[1], components[2]};
    if (const JsonValue* given = value.find("angle")) angle = given->number * degrees;
    const std::string axisLabel = label.empty() ? "axis" : label + ", axis";
    const char* sentence = key.says.sentence.c_str();
    bool changed = drag({axisLabel.c_str(), sentence, "%.5g"}, {-1e3, 1e3}, &axis.x, 3, 0.01);
    changed |= drag({"angle", sentence, "%.5g\xC2\xB0"}, {-360, 360}, &angle, 1, 1);
    if (changed) value = object(shoal::key("axis", axis), shoal::key("angle", angle / degrees));
    return changed;
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

bool JsonRows::drawNumbers(const Key& key, JsonValue& value, const std::string& label) {
    std::vector<double> numbers = numbersOf(value);
    const std::vector<double> stored = numbers;
    if (numbers.empty() || numbers.size() > 4) {  // only in the file
        beginRow({label.c_str(), key.says.sentence.c_str()});
        ImGui::TextDisabled("%s", writeJsonLine(value).substr(0, 40).c_str());
        return false;
    }
    const bool angle = key.says.unit == "rad";
    Limit limit = limitOf(key);
    if (key.kind == Kind::byHand) limit = {key.form.range.least, key.form.range.most};
    limit = {std::max(limit.least, -largestNumber), std::min(limit.most, largestNumber)};
    const std::string unit = key.says.unit.empty() || key.kind == Kind::byHand || numbers.size() > 1
                                 ? std::string()
                                 : " " + key.says.unit;
    const std::string format = isWhole(key) ? "%.0f" : concat("%.5g", angle ? "\xC2\xB0" : unit);
    double largest = 0;
    for (double& number : numbers) {
        if (angle) number *= degrees;
        largest = std::max(largest, std::abs(number));
    }
    if (angle) limit = {limit.least * degrees, limit.most * degrees};
    const std::vector<double> shown = numbers;
    const double speed = isWhole(key) ? std::max(0.2, largest / 200) : std::max(0.005, largest / 200);
    if (!drag({label.c_str(), key.says.sentence.c_str(), format.c_str()}, limit, numbers.data(),
              int(numbers.size()), speed))
        return false;
    for (size_t i = 0; i < numbers.size(); ++i) {
        if (numbers[i] == shown[i]) {  // not touched
            numbers[i] = stored[i];
            continue;
        }
        if (angle) numbers[i] /= degrees;
        // as many digits as were seen
        numbers[i] = isWhole(key) ? std::round(numbers[i]) : std::stod(formatted("%.6g", numbers[i]));
    }
    value = asJson(numbers, value.kind == Json::array);
    return true;
}

bool JsonRows::drawText(const Key& key, JsonValue& value, const std::string& label) {
    const Row row{label.c_str(), key.says.sentence.c_str()};
    const std::vector<std::string> words = choices_(key.name);
    return words.empty() ? type(row, value.text) : drawWord(row, value, words);
}

// The word that says what an object is, and the keys that go with it.
bool JsonRows::drawKind(const Key& key, JsonValue& object) {
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
    return kind && draw(*kind, object);
}

bool JsonRows::drawList(const Key& key, JsonValue& list) {
    bool changed = false;
    const Description& element = *key.objects[0];
    const bool within = std::exchange(inList_, true);
    std::optional<size_t> copied, removed;
    for (size_t i = 0; i < list.items.size(); ++i) {
        ImGui::PushID(int(i));
        if (ImGui::TreeNodeEx(concat(titleOf(list.items[i], i), "###element").c_str())) {
            if (ImGui::SmallButton("Duplicate")) copied = i;
            ImGui::SameLine();
            if (ImGui::SmallButton("Remove")) removed = i;
            changed |= draw(element, list.items[i]);
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    if (copied) {
        JsonValue copy = list.items[*copied];
        if (const JsonValue* own = copy.find("name"); own && !own->text.empty())
            setMember(copy, "name", JsonValue::makeString(freeName(list, own->text)));
        list.items.insert(list.items.begin() + std::ptrdiff_t(*copied + 1), std::move(copy));
    }
    if (removed) list.items.erase(list.items.begin() + std::ptrdiff_t(*removed));
    if (copied || removed) {
        places_.clear();  // they have moved
        changed = true;
    }
    inList_ = within;
    const auto addOne = [&](JsonValue item) {
        list.items.push_back(std::move(item));
        places_.clear();  // they have moved
        changed = true;
    };
    const Key* kinds = variantOf(element);
    if (ImGui::SmallButton("Add")) {
        if (kinds)
            ImGui::OpenPopup("kinds");
        else
            addOne(key.name == "groups" ? smallestGroup(list, choices_("molecule").front())
                                        : smallestObject(element, text()));
    }
    tip(element.sentence().c_str());
    if (kinds && ImGui::BeginPopup("kinds")) {
        for (const Description* kind : kinds->objects) {
            if (ImGui::Selectable(kind->name().c_str())) addOne(smallestObject(element, *kind, text()));
            tip(kind->sentence().c_str());
        }
        ImGui::EndPopup();
    }
    return changed;
}

}  // namespace shoal::window
