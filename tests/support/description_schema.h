// Writes descriptions as JSON Schema for text editors and as tables for people, as they are committed.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/description_text.h"
#include "core/kinds/parts.h"

namespace shoal::test {

using Kind = Key::Kind;

inline JsonValue schemaOf(const Description& description);

inline std::string sentence(const Key& key) {
    const Says& says = key.says;
    return (says.unit.empty() || key.kind == Kind::text ? says.sentence
                                                        : concat(says.sentence, " [", says.unit, "]")) +
           meaningOf(key).substr(says.sentence.size());  // beside what it means something
}

inline JsonValue areThere(const std::vector<std::string>& keys) {
    return object(key("required", keys));
}

inline JsonValue follows(const JsonValue& condition, const JsonValue& conclusion) {
    return object(key("if", condition), key("then", conclusion));
}

// That an object meets a condition.
inline JsonValue isMet(const Condition& condition, const Description& of) {
    const Key& other = *of.find(condition.key);
    if (condition.words.empty()) return areThere({other.name});
    const JsonValue words = other.kind == Kind::flag
                                ? toJson(std::vector<JsonValue>{toJson(condition.words[0] == "true")})
                                : toJson(condition.words);
    const JsonValue word = object(key(other.name.c_str(), object(key("enum", words))));
    JsonValue out = object(key("properties", word));
    const bool needed = other.needed || !condition.isMet(of.usualValue(other));
    return needed ? append(out, areThere({other.name}).members[0]) : out;
}

inline JsonValue areMet(const std::vector<Condition>& conditions, const Description& of) {
    std::vector<JsonValue> all;
    for (const Condition& condition : conditions)
        all.push_back(isMet(condition, of));
    return all.size() == 1 ? all[0] : object(key("allOf", all));
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
        std::vector<JsonValue> there;
        std::vector<std::string> needed;
        for (const Key& other : of.keys()) {
            if (!same(other.only, key.only)) continue;
            there.push_back(areThere({other.name}));
            if (other.needed) needed.push_back(other.name);
        }
        const JsonValue met = areMet(key.only, of);
        rules.push_back(writeJson(follows(object(shoal::key("anyOf", there)), met)));
        if (!needed.empty()) rules.push_back(writeJson(follows(met, areThere(needed))));
    }
}

inline JsonValue usualValue(const Key& key, const Description& of) {
    return key.needed || key.unlessZero ? JsonValue() : of.usualValue(key);
}

// The keys of an object, but for those of a variant's word.
inline void addKeys(const Description& of, JsonValue& properties, std::vector<std::string>& required) {
    for (const Key& key : of.keys()) {
        if (key.kind == Kind::variant) continue;
        JsonValue schema = key.kind->schema(key, schemaOf);
        std::erase_if(schema.members, [](const JsonMember& member) { return member.first == "description"; });
        schema.add("description", toJson(sentence(key)));
        const JsonValue usual = usualValue(key, of);
        if (usual.kind != JsonValue::Kind::null) schema.add("default", usual);
        properties.add(key.name, std::move(schema));
        if (key.needed && key.only.empty()) required.push_back(key.name);
    }
}

inline JsonValue closed(const std::string& sentence, JsonValue properties,
                        const std::vector<std::string>& required, const std::vector<std::string>& rules) {
    JsonValue out =
        object(key("description", sentence), key("type", "object"), key("additionalProperties", false));
    if (!required.empty()) append(out, key("required", required));
    append(out, key("properties", properties));
    std::vector<JsonValue> all;
    for (const std::string& rule : rules)
        if (!rule.empty()) all.push_back(parseJson(rule, "a rule of a schema"));
    return all.empty() ? out : append(out, key("allOf", all));
}

inline JsonValue schemaOfAlternative(const Description& of, const Key& variant, const Description& one) {
    JsonValue properties = object(key("comment", schemaReference("comment")),
                                  key(variant.name.c_str(), object(key("const", one.name()))));
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
        std::vector<JsonValue> alternatives;
        for (const Description* one : key.objects)
            alternatives.push_back(schemaOfAlternative(description, key, *one));
        return object(shoal::key("oneOf", alternatives));
    }
    JsonValue properties = object(key("comment", schemaReference("comment")));
    std::vector<std::string> required;
    addKeys(description, properties, required);
    std::vector<std::string> rules = {description.schema()};
    addConditions(description, rules);
    return closed(description.sentence(), std::move(properties), required, rules);
}

// "$defs": vectors, directions, colours, boxes, rotations, comments.
inline JsonValue schemaDefinitions() {
    const auto described = [](JsonValue schema, const char* words) {
        return append(schema, key("description", words));
    };
    const JsonMember comment = key("comment", schemaReference("comment"));
    const JsonValue vector = numbersSchema(3, {}), corner = schemaReference("vector");
    const JsonValue box =
        closed("A box along the axes, high above low. [m]",
               object(comment, key("low", corner), key("high", corner)), {"low", "high"}, {});
    const JsonValue turn = closed("A turn about an axis.",
                                  object(comment, key("axis", schemaReference("direction")),
                                         key("angle", described(numberSchema("number", {}), "rad"))),
                                  {"axis", "angle"}, {});
    const JsonValue quaternion =
        described(numbersSchema(4, {}), "A quaternion [x, y, z, w] of any length above 0.");
    return object(key("comment", textSchema(false)), key("vector2", numbersSchema(2, {})),
                  key("vector", vector),
                  key("direction", described(vector, "A vector of any length above 0.")),
                  key("color", described(numbersSchema(3, Range::atLeast(0)), "Linear red, green and blue.")),
                  key("box", box), key("rotation", eitherSchema(quaternion, turn)));
}

// The text of a schema's file, with those definitions that it refers to.
inline std::string schemaFile(const Description& description, const std::string& id,
                              const std::string& title) {
    JsonValue out = object(key("$schema", "https://json-schema.org/draft/2020-12/schema"), key("$id", id),
                           key("title", title));
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
