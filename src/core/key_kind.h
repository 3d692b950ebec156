// A kind of key: what a file may say for a key, and how that becomes a member of a struct, is checked,
// written, edited, and told to people and to text editors. To add a kind, add a source to core/kinds, its
// name below, and its row in tests/unit/test_key_kinds.cpp; nothing else lists the kinds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/where.h"

namespace shoal {

class Description;
struct Key;

// A text for a key that names something, such as a file.
using TextOf = std::function<std::string(const Key&)>;
// The JSON Schema of an object.
using SchemaOf = std::function<JsonValue(const Description&)>;

// How a window edits a value. A node opens to the keys of an object.
enum class RowForm {
    numbers,
    wholes,
    span,  // two numbers, of which a file may say one
    tick,
    word,
    text,
    texts,
    color,
    direction,
    box,
    rotation,
    node,
    list,
    variant,
};

struct KeyKind {
    // What tables say of the type of a key: the name, that with the limits and the unit, or what the unit
    // says.
    enum class Tells { name, limits, unit };

    const char* name = "";  // of a word: none, it tells its words
    Tells tells = Tells::name;
    RowForm form = RowForm::numbers;
    RowForm (*formOf)(const Key&, const JsonValue& value) = nullptr;  // instead of `form`
    const char* definition = nullptr;  // of the schema of numbers without limits; null: none
    double sliderReach = 0;            // of places, m; 0: sliders go by the number itself
    bool freeUsual = false;            // the default may be beyond the limits, such as infinity

    // Fills the key's member of an object, if the file has the key. Error: located.
    void (*read)(const Key&, JsonReader&, void* object, void* context) = nullptr;
    // Error, in the reader's words: a file could not say the value, or a number is further from 0 than
    // `largest`. Null: a file could say any.
    void (*check)(const Key&, const void* value, const Where&, double largest) = nullptr;
    // Null: the key is left out, because the value is the usual one (a null pointer: there is none), or says
    // nothing.
    JsonValue (*write)(const Key&, const void* value, const void* usual, const void* context) = nullptr;
    JsonValue (*least)(const Key&, const TextOf&) = nullptr;  // the least value that a file may say
    JsonValue (*schema)(const Key&, const SchemaOf&) = nullptr;
    std::vector<double> (*numbers)(const void* value) = nullptr;  // that sliders move; null: none

    RowForm row(const Key& key, const JsonValue& value) const { return formOf ? formOf(key, value) : form; }

    // The kinds that there are.
    static const KeyKind number, whole;
    static const KeyKind whole3;          // three of them
    static const KeyKind seed, longSeed;  // of 32 and of 64 bits
    static const KeyKind flag;
    static const KeyKind word;   // one of `words`
    static const KeyKind text;   // any string
    static const KeyKind texts;  // a list of strings
    static const KeyKind vector2, vector3;
    static const KeyKind direction;  // of any length above 0; made a unit vector
    static const KeyKind color;      // linear RGB, at least 0
    static const KeyKind span;       // [least, most], or one number for both
    static const KeyKind ends;       // [first, last], or one number for the last
    static const KeyKind box;        // {"low", "high"}
    static const KeyKind rotation;   // [x, y, z, w], or {"axis", "angle"}
    static const KeyKind object;
    static const KeyKind list;     // of objects
    static const KeyKind variant;  // a word that chooses an alternative, whose keys stand beside it
    static const KeyKind byHand;   // read by a function beside the description
};

// A key has a pointer to its kind, which is compared with one of the names above.
inline bool operator==(const KeyKind* kind, const KeyKind& other) {
    return kind == &other;
}

}  // namespace shoal
