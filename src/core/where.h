// Where the keys of an object stand, the limits of what they say, and the version of a file.
#pragma once

#include <string>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/box.h"
#include "core/json.h"

namespace shoal {

// Where the keys of an object stand: in its file, or, of what was made in code, their path. Paths are put
// together only when something is wrong; an object within another borrows that one's.
class Where {
  public:
    Where(const JsonReader& reader) : reader_(&reader) {}
    Where() = default;  // made in code: the whole
    Where in(const char* key) const { return {this, key, none}; }
    Where in(const char* key, size_t index) const { return {this, key, index}; }
    Where element(size_t index) const { return {this, "", index}; }  // of an array

    Location locate(const std::string& key) const;
    Location here() const;
    bool given(const std::string& key) const;  // the file has the key; of what was made in code: false
    double number(const std::string& key, double fallback) const;  // that the file gives
    void require(const std::string& key) const;                    // Error: the file has it not

  private:
    static constexpr size_t none = size_t(-1);
    Where(const Where* parent, const char* key, size_t index) : parent_(parent), key_(key), index_(index) {}
    std::string path() const;
    const JsonReader* root() const;
    const JsonValue* value() const;  // null: made in code, or not in the file

    const JsonReader* reader_ = nullptr;
    const Where* parent_ = nullptr;
    const char* key_ = "";
    size_t index_ = none;
};

bool contains(Range range, double number);  // and it is finite
// Error: it does not.
void needWithin(const Location& where, double number, Range range);
void needWithin(const Location& where, int number, Range range);
// Error: too many.
void needAtMost(const Where& where, const std::string& key, size_t count, size_t most);

// The key "format", such as "shoal-scene-1". Error: missing or another, with the one that is read; that of a
// newer version is told as such.
void needFormat(JsonReader& root, const std::string& expected);

// The limits of what must be above 0: in single precision smaller numbers are as good as 0.
constexpr double leastPositive = 1e-9;
inline Range aboveZero() {
    return Range::atLeast(leastPositive);
}

// Error: a box whose low is not below its high (or equal where `flat`).
void checkBox(const Box& box, bool flat, const Location& where);

}  // namespace shoal
