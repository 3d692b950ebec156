#include "core/description_text.h"

#include <cmath>

namespace shoal {

// When the key means something.
static std::string conditions(const Key& key) {
    std::string out;
    for (const Condition& condition : key.only) {
        out += concat(out.empty() ? " Only with `" : " and `", condition.key, "`");
        for (size_t i = 0; i < condition.words.size(); ++i)
            out += concat(i == 0 ? " " : i + 1 == condition.words.size() ? " or " : ", ", condition.words[i]);
    }
    return out.empty() ? out : out + ".";
}

std::string typeText(const Key& key) {
    const auto [least, most, aboveLeast] = key.says.range;
    const std::string& unit = key.says.unit;
    const auto written = [](double number) { return writeJsonLine(JsonValue::makeNumber(number)); };
    std::string out = key.kind->name;
    for (const std::string& word : key.words)
        out += concat(out.empty() ? "" : ", ", "`\"", word, "\"`");
    if (key.kind->tells == KeyKind::Tells::unit && !unit.empty()) return unit;
    if (key.kind->tells != KeyKind::Tells::limits) return out;
    if (std::isfinite(least) && std::isfinite(most))
        out += concat(" from ", written(least), " to ", written(most));
    else if (std::isfinite(least))
        out += least == leastPositive || aboveLeast ? concat(" above ", aboveLeast ? least : 0)
                                                    : concat(" of at least ", least);
    return unit.empty() ? out : out + ", " + unit;
}

std::string meaningOf(const Key& key) {
    return key.says.sentence + conditions(key);
}

std::string usualText(const Key& key, const Description& keys) {
    if (key.needed) return "required";
    if (!key.usual.empty()) return key.usual;
    JsonValue usual = key.unlessZero ? JsonValue() : keys.usualValue(key);
    if (key.form.usual) usual = JsonValue::makeNumber(*key.form.usual);
    if (key.kind == Key::Kind::object && !key.member.optional) return "as below";
    if (usual.kind == JsonValue::Kind::null) return "none";
    std::string out = writeJsonLine(usual);
    if (usual.kind == JsonValue::Kind::string) out = concat("`", out, "`");
    return out;
}

}  // namespace shoal
