// Makes the least that a file has to say of a struct, by its description (core/description.h): the keys that
// it needs, each with a value that it may have. Rules between keys may ask for more.
#pragma once

#include "core/description.h"
#include "core/json.h"

namespace shoal {

JsonValue smallestObject(const Description& keys, const TextOf& text);
// The description has a variant, which becomes this kind.
JsonValue smallestObject(const Description& keys, const Description& kind, const TextOf& text);

// Adds what an object needs and does not say yet.
void addNeeded(const Description& keys, const TextOf& text, JsonValue& object);

const Key* variantOf(const Description& keys);  // null: there is none

// Whether a key means something beside what the object says; what is left out counts as what it then is.
bool meansSomething(const Description& keys, const Key& key, const JsonValue& object);

}  // namespace shoal
