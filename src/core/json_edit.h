// Changes a JSON file where something changed and nowhere else: its layout, comments, key order and the way
// in which numbers are written stay. Puts two changes of one value, made apart, together.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"

namespace shoal {

// Bytes [begin, end) of a text become `replacement`.
struct TextChange {
    size_t begin = 0, end = 0;
    std::string replacement;
};

// Adds the changes of `text` that turn what `before` says into what `after` says. `original` was read from
// `text` and says the same as `before`, perhaps in other words: with defaults spelt out, in another order,
// with comments. All three are of one kind. Elements of arrays are matched by their index, except where some
// are left out or put in between equal ones; an array of numbers is one value.
void addChanges(const std::string& text, const JsonValue& original, const JsonValue& before,
                const JsonValue& after, std::vector<TextChange>& changes);

// Does so for an array whose elements are known by where they came from: `origins[i]` is the index in
// `before` of element i of `after`, ascending, or -1 where it is new.
void addArrayChanges(const std::string& text, const JsonValue& original, const JsonValue& before,
                     const JsonValue& after, const std::vector<int>& origins,
                     std::vector<TextChange>& changes);

// The changes must not overlap; those at one place keep their order.
std::string withChanges(const std::string& text, std::vector<TextChange> changes);

// Whether two values are equal, with members in the same order. Numbers compare by value; positions in the
// text do not count.
bool sameJson(const JsonValue& a, const JsonValue& b);

enum class Prefer { mine, theirs };

// `base` with what changed in `mine` and what changed in `theirs`. Objects go member by member, arrays of
// objects element by element: by their "name" where all have one of their own, else by their index where the
// arrays are of one length. Anything else is one value. Where both changed a value, and not
// into the same one, its path (from `path`) is put into `conflicts`, and the preferred one is taken.
JsonValue merged(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs, Prefer prefer,
                 const std::string& path, std::vector<std::string>& conflicts);

}  // namespace shoal
