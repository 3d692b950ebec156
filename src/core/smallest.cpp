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
        return condition.isMet(given ? *given : keys.usualValue(*keys.find(condition.key)));
    });
}

void addNeeded(const Description& keys, const TextOf& text, JsonValue& out) {
    for (const Key& key : keys.keys())
        if (key.needed && key.kind != Key::Kind::variant && !out.find(key.name) &&
            meansSomething(keys, key, out))
            out.add(key.name, key.kind->least(key, text));
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
