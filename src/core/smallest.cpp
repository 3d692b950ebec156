#include "core/smallest.h"

#include <algorithm>

#include "core/json_build.h"

namespace shoal {

const Key* variantOf(const Description& keys) {
    for (const Key& key : keys.keys())
        if (key.kind == Key::Kind::variant) return &key;
    return nullptr;
}

bool meansSomething(const Description& keys, const Key& key, const JsonValue& object) {
    return std::all_of(key.only.begin(), key.only.end(), [&](const Condition& condition) {
        const JsonValue* given = object.find(condition.key);
        const JsonValue value = given ? *given : keys.usualValue(*keys.find(condition.key));
        if (condition.words.empty()) return value.kind != JsonValue::Kind::null;
        const std::string word =
            value.kind == JsonValue::Kind::boolean ? (value.boolean ? "true" : "false") : value.text;
        return std::find(condition.words.begin(), condition.words.end(), word) != condition.words.end();
    });
}

// Makes a value that is read by hand, `within` so many of its lists.
static JsonValue smallestForm(const Key& key, size_t within, const TextOf& text) {
    const Form& form = key.form;
    if (within < form.lists.size()) {
        const JsonValue element = smallestForm(key, within + 1, text);
        return toJson(std::vector<JsonValue>(std::max<size_t>(1, form.lists[within].least), element));
    }
    if (!form.constant.empty()) return JsonValue::makeString(form.constant);
    if (form.value == Form::Value::text) return JsonValue::makeString(text(key));
    if (form.value == Form::Value::keys && key.objects.size() == 1)
        return smallestObject(*key.objects[0], text);
    return JsonValue::makeNumber(std::clamp(within > 0 ? 0.0 : 1.0, form.range.least, form.range.most));
}

JsonValue smallestValue(const Key& key, const TextOf& text) {
    const Range& range = key.says.range;
    const double number = std::clamp(1.0, range.least, range.most);
    switch (key.kind) {
    case Key::Kind::flag:
        return JsonValue::makeBoolean(true);
    case Key::Kind::word:
        return JsonValue::makeString(key.words.front());
    case Key::Kind::text:
        return JsonValue::makeString(text(key));
    case Key::Kind::texts:
        return JsonValue::makeArray();
    case Key::Kind::list:
        return toJson(std::vector<JsonValue>(key.needed ? 1 : 0, smallestObject(*key.objects[0], text)));
    case Key::Kind::vector2:
        return toJson(glm::dvec2(number));
    case Key::Kind::vector3:
        return toJson(glm::dvec3(range.least >= 0 ? number : 0));
    case Key::Kind::whole3:
        return toJson(glm::ivec3(int(std::clamp(8.0, range.least, range.most))));
    case Key::Kind::direction:
        return toJson(glm::dvec3(0, 1, 0));
    case Key::Kind::color:
        return toJson(glm::dvec3(number));
    case Key::Kind::span:
    case Key::Kind::ends:
        return toJson(glm::dvec2(number));
    case Key::Kind::box:
        return object(shoal::key("low", glm::dvec3(-1)), shoal::key("high", glm::dvec3(1)));
    case Key::Kind::rotation:
        return object(shoal::key("axis", glm::dvec3(0, 1, 0)), shoal::key("angle", 0.0));
    case Key::Kind::object:
        return smallestObject(*key.objects[0], text);
    case Key::Kind::variant:
        return JsonValue::makeString(key.objects[0]->name());
    case Key::Kind::byHand:
        return smallestForm(key, 0, text);
    case Key::Kind::number:
    case Key::Kind::whole:
    case Key::Kind::seed:
    case Key::Kind::longSeed:
        break;
    }
    return JsonValue::makeNumber(number);
}

void addNeeded(const Description& keys, const TextOf& text, JsonValue& out) {
    for (const Key& key : keys.keys())
        if (key.needed && key.kind != Key::Kind::variant && !out.find(key.name) &&
            meansSomething(keys, key, out))
            out.add(key.name, smallestValue(key, text));
}

JsonValue smallestObject(const Description& keys, const TextOf& text) {
    if (const Key* kinds = variantOf(keys)) return smallestObject(keys, *kinds->objects[0], text);
    JsonValue out = JsonValue::makeObject();
    addNeeded(keys, text, out);
    return out;
}

JsonValue smallestObject(const Description& keys, const Description& kind, const TextOf& text) {
    JsonValue out = object(key(variantOf(keys)->name.c_str(), kind.name()));
    addNeeded(kind, text, out);
    addNeeded(keys, text, out);
    return out;
}

}  // namespace shoal
