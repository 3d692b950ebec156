// Writes descriptions as tables for people and as JSON Schema for text editors.
#pragma once

#include "core/description.h"

namespace shoal {

// The JSON Schema (2020-12) of an object. Refers to the definitions of schemaDefinitions().
JsonValue schemaOf(const Description& description);
// "$defs": vectors, directions, colours, boxes, rotations, comments.
JsonValue schemaDefinitions();

// The text of a schema's file, with those definitions that it refers to.
std::string schemaFile(const Description& description, const std::string& id, const std::string& title);

// A table in Markdown, a row a key: name, type and unit, default, meaning.
std::string tableOf(const Description& description);

// The alternatives of its variant, a row each: the word, what it is, its keys with their defaults.
std::string kindsOf(const Description& description);

// "vector, m", "0 to 1", "\"none\", \"yaw\" or \"any\""; and what holds where the key is left out, such as
// "0.5", "required" or "none".
std::string typeText(const Key& key);
std::string meaningOf(const Key& key);  // its sentence, and beside what it means something
std::string usualText(const Key& key, const Description& of);

}  // namespace shoal
