// Building and writing JsonValues.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/json.h"
#include "core/printable.h"

namespace shoal {

namespace {

constexpr size_t lineWidth = 120;

// The name of a file may be no UTF-8, which JSON has no way to say.
std::string inQuotes(std::string_view text) {
    std::string out = "\"";
    while (!text.empty()) {
        const Utf8 character = firstCharacter(text);
        if (character.code == Utf8::nothing)
            out += "\\ufffd";
        else if (character.code == '"' || character.code == '\\')
            out += {'\\', char(character.code)};
        else if (hides(character.code))
            out += escape(character.code);
        else
            out += text.substr(0, character.bytes);
        text.remove_prefix(character.bytes);
    }
    return out + "\"";
}

std::string number(double value) {
    if (!std::isfinite(value)) return "null";
    char buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    return std::string(buffer, result.ptr);
}

std::string scalar(const JsonValue& value) {
    switch (value.kind) {
    case JsonValue::Kind::boolean:
        return value.boolean ? "true" : "false";
    case JsonValue::Kind::number:
        return value.end == 0 && !value.text.empty() ? value.text : number(value.number);
    case JsonValue::Kind::string:
        return inQuotes(value.text);
    default:
        return "null";
    }
}

bool isPlainNumbers(const JsonValue& value) {
    return value.kind == JsonValue::Kind::array &&
           std::all_of(value.items.begin(), value.items.end(),
                       [](const JsonValue& item) { return item.kind == JsonValue::Kind::number; });
}

JsonValue ofKind(JsonValue::Kind kind) {
    JsonValue out;
    out.kind = kind;
    return out;
}

constexpr int inOneLine = -1;

// `indent`: spaces, or inOneLine. `element`: the value stands in an array, where short things keep to
// one line.
void write(const JsonValue& value, int indent, bool element, std::string& out) {
    if (!value.isContainer()) {
        out += scalar(value);
        return;
    }
    const bool empty = value.items.empty() && value.members.empty();
    if (empty || isPlainNumbers(value)) indent = inOneLine;
    if (indent >= 0 && element && size_t(indent) + writeJsonLine(value).size() < lineWidth)
        indent = inOneLine;
    const bool lines = indent >= 0;
    const bool array = value.kind == JsonValue::Kind::array;
    const int inner = lines ? indent + 2 : inOneLine;
    const std::string start = lines ? "\n" + std::string(size_t(inner), ' ') : "";
    out += array ? "[" : "{";
    const char* separator = "";
    for (const JsonValue& item : value.items) {
        out += separator + start;
        write(item, inner, true, out);
        separator = lines ? "," : ", ";
    }
    for (const auto& [key, member] : value.members) {
        out += separator + start + inQuotes(key) + ": ";
        write(member, inner, false, out);
        separator = lines ? "," : ", ";
    }
    if (lines) out += "\n" + std::string(size_t(indent), ' ');
    out += array ? "]" : "}";
}

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
    for (const auto& [name, value] : members)
        if (name == key) return &value;
    return nullptr;
}

JsonValue JsonValue::makeNumber(double value) {
    JsonValue out = ofKind(Kind::number);
    out.number = value;
    return out;
}

JsonValue JsonValue::makeString(std::string value) {
    JsonValue out = ofKind(Kind::string);
    out.text = std::move(value);
    return out;
}

JsonValue JsonValue::makeBoolean(bool value) {
    JsonValue out = ofKind(Kind::boolean);
    out.boolean = value;
    return out;
}

JsonValue JsonValue::makeArray() {
    return ofKind(Kind::array);
}

JsonValue JsonValue::makeObject() {
    return ofKind(Kind::object);
}

JsonValue& JsonValue::add(std::string key, JsonValue value) {
    members.push_back({std::move(key), std::move(value)});
    return *this;
}

std::string writeJson(const JsonValue& value) {
    std::string out;
    write(value, 0, false, out);
    return out + "\n";
}

std::string writeJsonLine(const JsonValue& value) {
    std::string out;
    write(value, inOneLine, false, out);
    return out;
}

// ---- Changes

std::vector<double> numbersOf(const JsonValue& value) {
    std::vector<double> out;
    if (value.kind == JsonValue::Kind::number) out.push_back(value.number);
    for (const JsonValue& item : value.items)
        if (item.kind == JsonValue::Kind::number) out.push_back(item.number);
    return out.size() == std::max<size_t>(1, value.items.size()) ? out : std::vector<double>();
}

void setMember(JsonValue& object, const std::string& key, JsonValue value) {
    if (const JsonValue* found = object.find(key))
        const_cast<JsonValue&>(*found) = std::move(value);
    else
        object.add(key, std::move(value));
}

void leaveOut(JsonValue& object, const std::string& key) {
    std::erase_if(object.members, [&](const JsonMember& member) { return member.first == key; });
}

JsonValue& memberOf(JsonValue& object, const std::string& key) {
    if (!object.find(key)) object.add(key, JsonValue::makeObject());
    return const_cast<JsonValue&>(*object.find(key));
}

}  // namespace shoal
