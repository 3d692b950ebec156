// Writes descriptions as JSON Schema for text editors and as tables for people, as they are committed.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "core/description_text.h"

namespace shoal::test {

using Kind = Key::Kind;

inline JsonValue text(const std::string& words) {
    return JsonValue::makeString(words);
}

inline JsonValue object(std::initializer_list<std::pair<const char*, JsonValue>> members) {
    JsonValue out = JsonValue::makeObject();
    for (const auto& [key, value] : members)
        out.add(key, value);
    return out;
}

inline JsonValue list(const std::vector<std::string>& words) {
    JsonValue out = JsonValue::makeArray();
    for (const std::string& word : words)
        out.items.push_back(text(word));
    return out;
}

inline JsonValue reference(const char* name) {
    return object({{"$ref", text(concat("#/$defs/", name))}});
}

inline JsonValue number(const char* type, const Range& range) {
    JsonValue out = object({{"type", text(type)}});
    if (std::isfinite(range.least))
        out.add(range.aboveLeast ? "exclusiveMinimum" : "minimum", JsonValue::makeNumber(range.least));
    if (std::isfinite(range.most)) out.add("maximum", JsonValue::makeNumber(range.most));
    return out;
}

inline JsonValue numbers(int count, const Range& range, const char* type = "number") {
    return object({{"type", text("array")},
                   {"minItems", JsonValue::makeNumber(count)},
                   {"maxItems", JsonValue::makeNumber(count)},
                   {"items", number(type, range)}});
}

inline bool limited(const Range& range) {
    return std::isfinite(range.least) || std::isfinite(range.most);
}

inline JsonValue schemaOf(const Description& description);

inline JsonValue textSchema(bool notEmpty) {
    JsonValue out = object({{"type", text("string")}});
    if (notEmpty) out.add("minLength", JsonValue::makeNumber(1));
    return out;
}

inline JsonValue schemaOf(const Form& form, const Key& key) {
    using Value = Form::Value;
    if (!form.constant.empty()) return object({{"const", text(form.constant)}});
    JsonValue out;
    if (form.value == Value::text) out = textSchema(form.notEmpty);
    if (form.value == Value::number) out = number("number", form.range);
    if (form.value == Value::whole) out = number("integer", form.range);
    if (form.value == Value::keys) out = schemaOf(*key.objects.at(0));
    if (form.value == Value::numberOrKeys) {
        JsonValue either = JsonValue::makeArray();
        either.items = {number("number", form.range), schemaOf(*key.objects.at(0))};
        out = object({{"anyOf", either}});
    }
    for (size_t i = form.lists.size(); i-- > 0;) {
        JsonValue list = object({{"type", text("array")}});
        const auto [least, most] = form.lists[i];
        if (least > 0) list.add("minItems", JsonValue::makeNumber(double(least)));
        if (most < std::numeric_limits<size_t>::max())
            list.add("maxItems", JsonValue::makeNumber(double(most)));
        list.add("items", std::move(out));
        out = std::move(list);
    }
    if (form.usual) out.add("default", JsonValue::makeNumber(*form.usual));
    return out;
}

inline JsonValue valueSchema(const Key& key) {
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
    case Kind::text:
        return textSchema(key.notEmpty);
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
        return schemaOf(key.form, key);
    case Kind::variant:
        break;
    }
    return JsonValue::makeObject();
}

inline std::string sentence(const Key& key) {
    const Says& says = key.says;
    return (says.unit.empty() || key.kind == Kind::text ? says.sentence
                                                        : concat(says.sentence, " [", says.unit, "]")) +
           meaningOf(key).substr(says.sentence.size());  // beside what it means something
}

// That an object meets a condition.
inline JsonValue isMet(const Condition& condition, const Description& of) {
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

inline JsonValue areMet(const std::vector<Condition>& conditions, const Description& of) {
    if (conditions.size() == 1) return isMet(conditions[0], of);
    JsonValue all = JsonValue::makeArray();
    for (const Condition& condition : conditions)
        all.items.push_back(isMet(condition, of));
    return object({{"allOf", all}});
}

inline bool same(const std::vector<Condition>& a, const std::vector<Condition>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Condition& one, const Condition& other) {
                          return one.key == other.key && one.words == other.words;
                      });
}

// Which keys may be there only beside which others, and which must be then.
inline void addConditions(const Description& of, std::vector<std::string>& rules) {
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

inline JsonValue usualValue(const Key& key, const Description& of) {
    return key.needed || key.unlessZero ? JsonValue() : of.usualValue(key);
}

// The keys of an object, but for those of a variant's word.
inline void addKeys(const Description& of, JsonValue& properties, std::vector<std::string>& required) {
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

inline JsonValue closed(const std::string& sentence, JsonValue properties,
                        const std::vector<std::string>& required, const std::vector<std::string>& rules) {
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

inline JsonValue schemaOfAlternative(const Description& of, const Key& variant, const Description& one) {
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

// The JSON Schema (2020-12) of an object. Refers to the definitions of schemaDefinitions().
inline JsonValue schemaOf(const Description& description) {
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

// "$defs": vectors, directions, colours, boxes, rotations, comments.
inline JsonValue schemaDefinitions() {
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

// The text of a schema's file, with those definitions that it refers to.
inline std::string schemaFile(const Description& description, const std::string& id,
                              const std::string& title) {
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

// The alternatives of its variant, a row each: the word, what it is, its keys with their defaults.
inline std::string kindsOf(const Description& description) {
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

// A table in Markdown, a row a key: name, type and unit, default, meaning.
inline std::string tableOf(const Description& description) {
    std::string out = "| key | type, unit | default | meaning |\n|---|---|---|---|\n";
    for (const Key& key : description.keys())
        out += concat("| `", key.name, "` | ", typeText(key), " | ", usualText(key, description), " | ",
                      meaningOf(key), " |\n");
    return out;
}

}  // namespace shoal::test
