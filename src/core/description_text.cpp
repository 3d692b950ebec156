#include "core/description_text.h"

#include <cmath>
#include <iterator>

namespace shoal {

namespace {

using Kind = Key::Kind;

// When the key means something.
std::string conditions(const Key& key) {
    std::string out;
    for (const Condition& condition : key.only) {
        out += concat(out.empty() ? " Only with `" : " and `", condition.key, "`");
        for (size_t i = 0; i < condition.words.size(); ++i)
            out += concat(i == 0 ? " " : i + 1 == condition.words.size() ? " or " : ", ", condition.words[i]);
    }
    return out.empty() ? out : out + ".";
}

// Tables call the kinds of keys so, in the order of Key::Kind; those that are limited also say how.
struct TypeWords {
    const char* words;
    bool limited = false;
};
constexpr TypeWords typeWords[] = {
    {"number", true},
    {"whole number", true},
    {"three whole numbers", true},
    {"whole number from 0 to 4294967295"},
    {"whole number of 64 bits"},
    {"true or false"},
    {""},  // a word
    {"string"},
    {"list of strings"},
    {"two numbers", true},
    {"[x, y, z]", true},
    {"direction"},
    {"colour"},
    {"number or [least, most]", true},
    {"number or [first, last]", true},
    {"box, m"},
    {"rotation"},
    {"object"},
    {"list of objects"},
    {""},  // a variant
    {"see the text"},
};
static_assert(std::size(typeWords) == size_t(Kind::byHand) + 1);

}  // namespace

std::string typeText(const Key& key) {
    const Range range = key.says.range;
    const auto withUnit = [&](std::string words) {
        if (std::isfinite(range.least) && std::isfinite(range.most))
            words += concat(" from ", writeJsonLine(JsonValue::makeNumber(range.least)), " to ",
                            writeJsonLine(JsonValue::makeNumber(range.most)));
        else if (std::isfinite(range.least))
            words += range.least == leastPositive || range.aboveLeast
                         ? concat(" above ", range.aboveLeast ? range.least : 0)
                         : concat(" of at least ", range.least);
        return key.says.unit.empty() ? words : words + ", " + key.says.unit;
    };
    if (key.kind == Kind::word || key.kind == Kind::variant) {
        std::string out;
        for (const std::string& word : key.words)
            out += concat(out.empty() ? "" : ", ", "`\"", word, "\"`");
        return out;
    }
    const bool own = key.kind == Kind::text || key.kind == Kind::byHand;  // the unit says what it is
    if (own && !key.says.unit.empty()) return key.says.unit;
    const TypeWords& type = typeWords[size_t(key.kind)];
    return type.limited ? withUnit(type.words) : type.words;
}

std::string meaningOf(const Key& key) {
    return key.says.sentence + conditions(key);
}

std::string usualText(const Key& key, const Description& keys) {
    if (key.needed) return "required";
    if (!key.usual.empty()) return key.usual;
    JsonValue usual = key.unlessZero ? JsonValue() : keys.usualValue(key);
    if (key.form.usual) usual = JsonValue::makeNumber(*key.form.usual);
    if (key.kind == Kind::object && !key.member.optional) return "as below";
    if (usual.kind == JsonValue::Kind::null) return "none";
    std::string out = writeJsonLine(usual);
    if (usual.kind == JsonValue::Kind::string) out = concat("`", out, "`");
    return out;
}

}  // namespace shoal
