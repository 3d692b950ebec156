#include "core/description_schema.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace shoal {

namespace {

using Kind = Key::Kind;

JsonValue text(const std::string& words) {
    return JsonValue::makeString(words);
}

JsonValue object(std::initializer_list<std::pair<const char*, JsonValue>> members) {
    JsonValue out = JsonValue::makeObject();
    for (const auto& [key, value] : members)
        out.add(key, value);
    return out;
}

JsonValue list(const std::vector<std::string>& words) {
    JsonValue out = JsonValue::makeArray();
    for (const std::string& word : words)
        out.items.push_back(text(word));
    return out;
}

JsonValue reference(const char* name) {
    return object({{"$ref", text(concat("#/$defs/", name))}});
}

JsonValue number(const char* type, const Range& range) {
    JsonValue out = object({{"type", text(type)}});
    if (std::isfinite(range.least))
        out.add(range.aboveLeast ? "exclusiveMinimum" : "minimum", JsonValue::makeNumber(range.least));
    if (std::isfinite(range.most)) out.add("maximum", JsonValue::makeNumber(range.most));
    return out;
}

JsonValue numbers(int count, const Range& range, const char* type = "number") {
    return object({{"type", text("array")},
                   {"minItems", JsonValue::makeNumber(count)},
                   {"maxItems", JsonValue::makeNumber(count)},
                   {"items", number(type, range)}});
}

bool limited(const Range& range) {
    return std::isfinite(range.least) || std::isfinite(range.most);
}

JsonValue valueSchema(const Key& key) {
    const Range range = key.says.range;
    switch (key.kind) {
    case Kind::number:
        return number("number", range);
    case Kind::whole:
        return number("integer", range);
    case Kind::whole3:
        return numbers(3, range, "integer");
    case Kind::seed:
        return number("integer", Range::between(0, 4294967295.0));
    case Kind::longSeed:
        return number("integer", Range::atLeast(0));
    case Kind::flag:
        return object({{"type", text("boolean")}});
    case Kind::text: {
        JsonValue out = object({{"type", text("string")}});
        if (key.notEmpty) out.add("minLength", JsonValue::makeNumber(1));
        return out;
    }
    case Kind::texts:
        return object({{"type", text("array")},
                       {"minItems", JsonValue::makeNumber(1)},
                       {"items", object({{"type", text("string")}})}});
    case Kind::vector2:
        return limited(range) ? numbers(2, range) : reference("vector2");
    case Kind::vector3:
        return limited(range) ? numbers(3, range) : reference("vector");
    case Kind::direction:
        return reference("direction");
    case Kind::color:
        return std::isfinite(range.most) ? numbers(3, range) : reference("color");
    case Kind::ends:
    case Kind::span: {
        JsonValue either = JsonValue::makeArray();
        either.items = {number("number", range), numbers(2, range)};
        return object({{"anyOf", either}});
    }
    case Kind::box:
        return reference("box");
    case Kind::rotation:
        return reference("rotation");
    case Kind::word:
        return object({{"enum", list(key.words)}});
    case Kind::object:
        return schemaOf(*key.objects[0]);
    case Kind::list:
        return object({{"type", text("array")}, {"items", schemaOf(*key.objects[0])}});
    case Kind::byHand:
        return parseJson(key.schema, "the schema of " + key.name);
    case Kind::variant:
        break;
    }
    return JsonValue::makeObject();
}

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

std::string sentence(const Key& key) {
    const Says& says = key.says;
    return (says.unit.empty() || key.kind == Kind::text ? says.sentence
                                                        : concat(says.sentence, " [", says.unit, "]")) +
           conditions(key);
}

// That an object meets a condition.
JsonValue isMet(const Condition& condition, const Description& of) {
    const Key& other = *of.find(condition.key);
    if (condition.words.empty()) return object({{"required", list({other.name})}});
    const bool flag = other.kind == Kind::flag;
    JsonValue words = flag ? JsonValue::makeArray() : list(condition.words);
    if (flag) words.items.push_back(JsonValue::makeBoolean(condition.words[0] == "true"));
    JsonValue out = object({{"properties", object({{other.name.c_str(), object({{"enum", words}})}})}});
    const JsonValue usual = of.usualValue(other);
    const std::string says = flag ? (usual.boolean ? "true" : "false") : usual.text;
    if (std::find(condition.words.begin(), condition.words.end(), says) == condition.words.end() ||
        other.needed)
        out.add("required", list({other.name}));
    return out;
}

JsonValue areMet(const std::vector<Condition>& conditions, const Description& of) {
    if (conditions.size() == 1) return isMet(conditions[0], of);
    JsonValue all = JsonValue::makeArray();
    for (const Condition& condition : conditions)
        all.items.push_back(isMet(condition, of));
    return object({{"allOf", all}});
}

bool same(const std::vector<Condition>& a, const std::vector<Condition>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Condition& one, const Condition& other) {
                          return one.key == other.key && one.words == other.words;
                      });
}

// Which keys may be there only beside which others, and which must be then.
void addConditions(const Description& of, std::vector<std::string>& rules) {
    for (const Key& key : of.keys()) {
        const auto first = std::find_if(of.keys().begin(), of.keys().end(),
                                        [&](const Key& other) { return same(other.only, key.only); });
        if (key.only.empty() || &*first != &key) continue;
        JsonValue there = JsonValue::makeArray();
        std::vector<std::string> needed;
        for (const Key& other : of.keys()) {
            if (!same(other.only, key.only)) continue;
            there.items.push_back(object({{"required", list({other.name})}}));
            if (other.needed) needed.push_back(other.name);
        }
        rules.push_back(
            writeJson(object({{"if", object({{"anyOf", there}})}, {"then", areMet(key.only, of)}})));
        if (!needed.empty())
            rules.push_back(writeJson(
                object({{"if", areMet(key.only, of)}, {"then", object({{"required", list(needed)}})}})));
    }
}

JsonValue usualValue(const Key& key, const Description& of) {
    return key.needed || key.unlessZero ? JsonValue() : of.usualValue(key);
}

// The keys of an object, but for those of a variant's word.
void addKeys(const Description& of, JsonValue& properties, std::vector<std::string>& required) {
    for (const Key& key : of.keys()) {
        if (key.kind == Kind::variant) continue;
        JsonValue schema = valueSchema(key);
        std::erase_if(schema.members, [](const JsonMember& member) { return member.first == "description"; });
        schema.add("description", text(sentence(key)));
        const JsonValue usual = usualValue(key, of);
        if (usual.kind != JsonValue::Kind::null) schema.add("default", usual);
        properties.add(key.name, std::move(schema));
        if (key.needed && key.only.empty()) required.push_back(key.name);
    }
}

JsonValue closed(const std::string& sentence, JsonValue properties, const std::vector<std::string>& required,
                 const std::vector<std::string>& rules) {
    JsonValue out = object({{"description", text(sentence)},
                            {"type", text("object")},
                            {"additionalProperties", JsonValue::makeBoolean(false)}});
    if (!required.empty()) out.add("required", list(required));
    out.add("properties", std::move(properties));
    JsonValue all = JsonValue::makeArray();
    for (const std::string& rule : rules)
        if (!rule.empty()) all.items.push_back(parseJson(rule, "a rule of a schema"));
    if (!all.items.empty()) out.add("allOf", std::move(all));
    return out;
}

// What tables call the kinds of keys, in the order of Key::Kind; those that are limited also say how.
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

JsonValue schemaOfAlternative(const Description& of, const Key& variant, const Description& one) {
    JsonValue properties = object(
        {{"comment", reference("comment")}, {variant.name.c_str(), object({{"const", text(one.name())}})}});
    std::vector<std::string> required = {variant.name};
    addKeys(one, properties, required);
    addKeys(of, properties, required);
    std::vector<std::string> rules = {of.schema(), one.schema()};
    addConditions(of, rules);
    addConditions(one, rules);
    return closed(one.sentence(), std::move(properties), required, rules);
}

}  // namespace

JsonValue schemaOf(const Description& description) {
    for (const Key& key : description.keys()) {
        if (key.kind != Kind::variant) continue;
        JsonValue alternatives = JsonValue::makeArray();
        for (const Description* one : key.objects)
            alternatives.items.push_back(schemaOfAlternative(description, key, *one));
        return object({{"oneOf", std::move(alternatives)}});
    }
    JsonValue properties = object({{"comment", reference("comment")}});
    std::vector<std::string> required;
    addKeys(description, properties, required);
    std::vector<std::string> rules = {description.schema()};
    addConditions(description, rules);
    return closed(description.sentence(), std::move(properties), required, rules);
}

JsonValue schemaDefinitions() {
    const JsonValue vector = numbers(3, {});
    JsonValue direction = vector;
    direction.add("description", text("A vector of any length above 0."));
    JsonValue color = numbers(3, Range::atLeast(0));
    color.add("description", text("Linear red, green and blue."));
    JsonValue quaternion = numbers(4, {});
    quaternion.add("description", text("A quaternion [x, y, z, w] of any length above 0."));
    const JsonValue turn =
        closed("A turn about an axis.",
               object({{"comment", reference("comment")},
                       {"axis", reference("direction")},
                       {"angle", object({{"type", text("number")}, {"description", text("rad")}})}}),
               {"axis", "angle"}, {});
    JsonValue either = JsonValue::makeArray();
    either.items = {quaternion, turn};
    return object({{"comment", object({{"type", text("string")}})},
                   {"vector2", numbers(2, {})},
                   {"vector", vector},
                   {"direction", direction},
                   {"color", color},
                   {"box", closed("A box along the axes, high above low. [m]",
                                  object({{"comment", reference("comment")},
                                          {"low", reference("vector")},
                                          {"high", reference("vector")}}),
                                  {"low", "high"}, {})},
                   {"rotation", object({{"anyOf", either}})}});
}

std::string schemaFile(const Description& description, const std::string& id, const std::string& title) {
    JsonValue out = object({{"$schema", text("https://json-schema.org/draft/2020-12/schema")},
                            {"$id", text(id)},
                            {"title", text(title)}});
    for (JsonMember& member : schemaOf(description).members)
        out.members.push_back(std::move(member));
    JsonValue definitions = JsonValue::makeObject();
    std::string all = writeJson(out);
    const JsonValue known = schemaDefinitions();
    for (size_t before = 0, now = 1; before != now; before = now, now = definitions.members.size() + 1)
        for (const auto& [name, definition] : known.members) {
            if (definitions.find(name) || all.find(concat("\"#/$defs/", name, "\"")) == std::string::npos)
                continue;
            definitions.add(name, definition);
            all += writeJson(definition);
        }
    out.add("$defs", std::move(definitions));
    return writeJson(out);
}

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

std::string usualText(const Key& key, const Description& of) {
    if (key.needed) return "required";
    if (!key.usual.empty()) return key.usual;
    JsonValue usual = usualValue(key, of);
    if (key.kind == Kind::byHand) {
        const JsonValue schema = parseJson(key.schema, "the schema of " + key.name);
        if (const JsonValue* value = schema.find("default")) usual = *value;
    }
    if (key.kind == Kind::object && !key.member.optional) return "as below";
    if (usual.kind == JsonValue::Kind::null) return "none";
    std::string out = writeJsonLine(usual);
    if (usual.kind == JsonValue::Kind::string) out = concat("`", out, "`");
    return out;
}

std::string kindsOf(const Description& description) {
    constexpr size_t most = 7;  // keys in a row
    std::string out = "| word | what it is | keys (default) |\n|---|---|---|\n";
    for (const Key& variant : description.keys())
        for (const Description* kind :
             variant.kind == Kind::variant ? variant.objects : decltype(variant.objects)()) {
            std::string keys;
            for (const Key& key : kind->keys()) {
                const std::string usual = usualText(key, *kind);
                keys += concat(keys.empty() ? "" : ", ", "`", key.name, "`",
                               key.says.unit.empty() ? "" : " " + key.says.unit,
                               usual == "none" ? "" : concat(" (", usual, ")"));
            }
            out += concat("| `", kind->name(), "` | ", kind->sentence(), " | ",
                          kind->keys().size() > most ? "below" : keys, " |\n");
        }
    return out;
}

std::string tableOf(const Description& description) {
    std::string out = "| key | type, unit | default | meaning |\n|---|---|---|---|\n";
    for (const Key& key : description.keys())
        out += concat("| `", key.name, "` | ", typeText(key), " | ", usualText(key, description), " | ",
                      meaningOf(key), " |\n");
    return out;
}

}  // namespace shoal
