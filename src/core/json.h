// Strict JSON (RFC 8259) that remembers where each value stands and in which order keys came.
//
// `parseJson` gives a tree of `JsonValue`s; `JsonReader` takes an object's keys one by one, converts and
// checks them, and reports the first that is missing, mistyped or unknown as a located Error. A key
// "comment" is allowed in every object. Duplicate keys, NaN and infinities are refused.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"

namespace shoal {

struct JsonMember;

class JsonValue {
  public:
    enum class Kind { null, boolean, number, string, array, object };

    Kind kind = Kind::null;
    int line = 0, column = 0;        // where the value begins, from 1; columns count bytes
    int keyLine = 0, keyColumn = 0;  // where its key begins, for an object's members
    size_t begin = 0, end = 0;       // its bytes in the text; 0, 0: it was not read
    size_t keyBegin = 0;             // of its key
    bool boolean = false;
    double number = 0;
    std::string text;                 // a string's characters, or a number as it is written
    std::vector<JsonValue> items;     // array
    std::vector<JsonMember> members;  // object, in the file's order

    bool isContainer() const { return kind == Kind::array || kind == Kind::object; }
    const JsonValue* find(std::string_view key) const;

    // Builders for what we write.
    static JsonValue makeNumber(double value);
    static JsonValue makeString(std::string value);
    static JsonValue makeBoolean(bool value);
    static JsonValue makeArray();
    static JsonValue makeObject();
    template <int N, typename T>
    static JsonValue makeVector(const glm::vec<N, T>& v);
    JsonValue& add(std::string key, JsonValue value);  // returns *this, for chains
};

struct JsonMember {
    std::string first;  // the key
    JsonValue second;
};

template <int N, typename T>
JsonValue JsonValue::makeVector(const glm::vec<N, T>& v) {
    JsonValue array = makeArray();
    for (int i = 0; i < N; ++i)
        array.items.push_back(makeNumber(static_cast<double>(v[i])));
    return array;
}

const char* name(JsonValue::Kind kind);  // "a number", "an object", ...

// Error: not JSON (with line and column), nested deeper than 64, a repeated key, a number beyond a double,
// or text that is not UTF-8. A byte-order mark at the start is skipped.
JsonValue parseJson(const std::string& text, const std::string& file);
JsonValue readJson(const std::string& file);
// Indented by two; arrays of plain numbers stay on one line, and so does an element of an array that fits;
// ends with a newline. Numbers are written in the shortest form that reads back as the same double; what is
// not finite, which JSON cannot say, becomes null.
std::string writeJson(const JsonValue& value);
std::string writeJsonLine(const JsonValue& value);  // on one line, without a newline

// Limits of a number, inclusive unless `above`.
struct Range {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool aboveLeast = false;  // strictly above `least`

    static constexpr Range atLeast(double value) {
        return {value, std::numeric_limits<double>::infinity(), false};
    }
    static constexpr Range between(double least, double most) { return {least, most, false}; }
};

// Reads one object. Call a getter per key, then `finish()`, which refuses whatever was not asked for.
// A getter leaves its target alone when an optional key is absent and returns whether it was there.
class JsonReader {
  public:
    JsonReader(const JsonValue& object, std::string file, std::string path = "$");

    bool has(const std::string& key) const { return object_->find(key) != nullptr; }
    Location locate(const std::string& key) const;  // of the key's value, or of the object if it is absent
    Location here() const;
    const std::string& file() const { return file_; }
    const std::string& path() const { return path_; }
    const JsonValue& value() const { return *object_; }

    // Numbers, whole numbers, flags, strings, vectors of numbers, and lists of these. The range is that of
    // each number.
    template <typename T>
    bool get(const std::string& key, T& out, Range range = {}) {
        const JsonValue* value = raw(key);
        if (value) convert(*value, path_ + "." + key, range, out);
        return value != nullptr;
    }
    // One of a fixed set of words; `out` becomes its index.
    bool choose(const std::string& key, const std::vector<std::string>& words, int& out);
    template <typename T>
    void need(const std::string& key, T& out, Range range = {}) {
        require(key);
        get(key, out, range);
    }
    void require(const std::string& key) const;  // Error when the key is absent

    // The value of a key as an object or as the objects of an array; marks the key as used.
    std::optional<JsonReader> object(const std::string& key);
    std::vector<JsonReader> objects(const std::string& key);
    const JsonValue* raw(const std::string& key);

    // Error for the first key that no getter asked for, with the nearest known key.
    void finish();

  private:
    const JsonValue* take(const std::string& key, JsonValue::Kind kind);
    void convert(const JsonValue& value, const std::string& path, Range range, double& out) const;
    void convert(const JsonValue& value, const std::string& path, Range range, int& out) const;
    void convert(const JsonValue& value, const std::string& path, Range range, uint32_t& out) const;
    void convert(const JsonValue& value, const std::string& path, Range range, uint64_t& out) const;
    void convert(const JsonValue& value, const std::string& path, Range range, bool& out) const;
    void convert(const JsonValue& value, const std::string& path, Range range, std::string& out) const;
    template <int N, typename T>
    void convert(const JsonValue& value, const std::string& path, Range range, glm::vec<N, T>& out) const {
        checkCount(value, path, N);
        for (int i = 0; i < N; ++i)
            convert(value.items[size_t(i)], concat(path, "[", i, "]"), range, out[i]);
    }
    template <typename T>
    void convert(const JsonValue& value, const std::string& path, Range range, std::vector<T>& out) const {
        checkKind(value, path, JsonValue::Kind::array);
        out.assign(value.items.size(), T());
        for (size_t i = 0; i < out.size(); ++i)
            convert(value.items[i], concat(path, "[", i, "]"), range, out[i]);
    }
    void checkKind(const JsonValue& value, const std::string& path, JsonValue::Kind kind) const;
    void checkCount(const JsonValue& array, const std::string& path, size_t count) const;
    Location locate(const JsonValue& value, const std::string& path) const;

    const JsonValue* object_;
    std::string file_, path_;
    std::vector<std::string> known_;
};

}  // namespace shoal
