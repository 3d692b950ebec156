// Taking a JSON object apart, key by key, with located errors.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/json.h"
#include "core/where.h"

namespace shoal {

using Kind = JsonValue::Kind;

const char* name(JsonValue::Kind kind) {
    constexpr const char* names[] = {"null",     "true or false", "a number",
                                     "a string", "an array",      "an object"};
    return names[size_t(kind)];
}

// The message about a number outside a range.
static std::string outside(Range range, const std::string& noun, const std::string& text) {
    const auto digits = [&noun](double number) {  // a whole number in full: 16777216
        return noun == "a whole number" ? writeJsonLine(JsonValue::makeNumber(number)) : concat(number);
    };
    const bool below = std::isfinite(range.most), above = std::isfinite(range.least);
    std::string out = "expected " + noun;
    if (above && range.aboveLeast) out += concat(" above ", digits(range.least));
    if (above && !range.aboveLeast) out += concat(below ? " from " : " of at least ", digits(range.least));
    if (below && above) out += concat(range.aboveLeast ? " and at most " : " to ", digits(range.most));
    if (below && !above) out += concat(" of at most ", digits(range.most));
    return out + ", found " + text;
}

static const char* found(const JsonValue& value) {
    if (value.kind == Kind::boolean) return value.boolean ? "true" : "false";
    return name(value.kind);
}

// A number as it was written.
static std::string written(const JsonValue& value) {
    return value.text.empty() ? concat(value.number) : value.text;
}

JsonReader::JsonReader(const JsonValue& object, std::string file, std::string path)
    : object_(&object), file_(std::move(file)), path_(std::move(path)) {
    checkKind(object, path_, Kind::object);
}

Location JsonReader::locate(const JsonValue& value, const std::string& path) const {
    return {file_, value.line, value.column, path};
}

Location JsonReader::here() const {
    return locate(*object_, path_);
}

Location JsonReader::locate(const std::string& key) const {
    const JsonValue* value = object_->find(key);
    return value ? locate(*value, path_ + "." + key) : here();
}

void JsonReader::checkKind(const JsonValue& value, const std::string& path, Kind kind) const {
    if (value.kind != kind)
        throw Error(locate(value, path), "expected ", name(kind), ", found ", found(value));
}

void JsonReader::checkCount(const JsonValue& array, const std::string& path, size_t count) const {
    if (array.kind != Kind::array)
        throw Error(locate(array, path), "expected an array of ", count, " numbers, found ", found(array));
    if (array.items.size() != count)
        throw Error(locate(array, path), "expected an array of ", count, " numbers, found ",
                    array.items.size());
}

bool contains(Range range, double number) {
    return std::isfinite(number) && number <= range.most &&
           (range.aboveLeast ? number > range.least : number >= range.least);
}

void needWithin(const Location& where, double number, Range range) {
    if (contains(range, number)) return;
    char digits[32];  // the shortest that says which double it is
    const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, number);
    throw Error(where, outside(range, "a number", std::string(digits, end.ptr)));
}

void needWithin(const Location& where, int number, Range range) {
    if (!contains(range, number)) throw Error(where, outside(range, "a whole number", concat(number)));
}

void JsonReader::convert(const JsonValue& value, const std::string& path, Range range, double& out) const {
    checkKind(value, path, Kind::number);
    if (!contains(range, value.number))
        throw Error(locate(value, path), outside(range, "a number", written(value)));
    out = value.number;
}

void JsonReader::convert(const JsonValue& value, const std::string& path, Range range, int& out) const {
    checkKind(value, path, Kind::number);
    const double number = value.number;
    const bool inside = number >= std::numeric_limits<int>::min() &&
                        number <= std::numeric_limits<int>::max() && contains(range, number);
    if (!inside || number != std::floor(number))
        throw Error(locate(value, path), outside(range, "a whole number", written(value)));
    out = static_cast<int>(number);
}

void JsonReader::convert(const JsonValue& value, const std::string& path, Range range, uint32_t& out) const {
    uint64_t wide = 0;
    convert(value, path, range, wide);
    if (wide > 0xFFFFFFFFu)
        throw Error(locate(value, path), "expected a seed of at most 4294967295 (32 bits)");
    out = uint32_t(wide);
}

// From the text, since a double holds only 53 of the 64 bits.
void JsonReader::convert(const JsonValue& value, const std::string& path, Range, uint64_t& out) const {
    checkKind(value, path, Kind::number);
    const std::string text = written(value);
    const auto result = std::from_chars(text.data(), text.data() + text.size(), out);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size())
        throw Error(locate(value, path),
                    "expected a whole number from 0 to 18446744073709551615, found " + text);
}

void JsonReader::convert(const JsonValue& value, const std::string& path, Range, bool& out) const {
    checkKind(value, path, Kind::boolean);
    out = value.boolean;
}

void JsonReader::convert(const JsonValue& value, const std::string& path, Range, std::string& out) const {
    checkKind(value, path, Kind::string);
    out = value.text;
}

const JsonValue* JsonReader::raw(const std::string& key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
    return object_->find(key);
}

const JsonValue* JsonReader::take(const std::string& key, Kind kind) {
    const JsonValue* value = raw(key);
    if (value) checkKind(*value, path_ + "." + key, kind);
    return value;
}

bool JsonReader::choose(const std::string& key, const std::vector<std::string>& words, int& out) {
    const JsonValue* value = take(key, Kind::string);
    if (!value) return false;
    const auto word = std::find(words.begin(), words.end(), value->text);
    if (word == words.end())
        throw Error(locate(key), "unknown word \"" + value->text + "\"" + suggestion(value->text, words));
    out = static_cast<int>(word - words.begin());
    return true;
}

void JsonReader::require(const std::string& key) const {
    if (has(key)) return;
    // A misspelt key is missing as well: the place of the mistake says more. Short keys are all near one
    // another.
    for (const auto& [other, value] : object_->members)
        if (key.size() > 3 && std::find(known_.begin(), known_.end(), other) == known_.end() &&
            nearest(other, {key}) == key)
            throw Error({file_, value.keyLine, value.keyColumn, path_ + "." + other},
                        "unknown key \"" + other + "\"" + suggestion(other, {key}));
    throw Error(here(), "missing key \"" + key + "\"");
}

std::optional<JsonReader> JsonReader::object(const std::string& key) {
    const JsonValue* value = raw(key);
    if (!value) return std::nullopt;
    return JsonReader(*value, file_, path_ + "." + key);
}

std::vector<JsonReader> JsonReader::objects(const std::string& key) {
    std::vector<JsonReader> out;
    const JsonValue* value = take(key, Kind::array);
    if (!value) return out;
    out.reserve(value->items.size());
    for (const JsonValue& item : value->items)
        out.emplace_back(item, file_, concat(path_, ".", key, "[", out.size(), "]"));
    return out;
}

void JsonReader::finish() {
    for (const auto& [key, value] : object_->members) {
        // a comment anywhere; at the top what editors look for
        if (key == "comment" || (key == "$schema" && path_ == "$")) {
            checkKind(value, path_ + "." + key, Kind::string);
        } else if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
            throw Error({file_, value.keyLine, value.keyColumn, path_ + "." + key},
                        "unknown key \"" + key + "\"" + suggestion(key, known_));
        }
    }
}

}  // namespace shoal
