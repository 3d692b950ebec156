// Flags, texts, and words of a fixed set, with what they choose.
#include "core/kinds/parts.h"

namespace shoal {

namespace {

bool getText(const Key& key, JsonReader& reader, std::string& out) {
    if (!getPlain(key, reader, out)) return false;
    if (key.notEmpty && out.empty())
        throw Error(reader.locate(key.name), "expected ", key.says.unit, ", found an empty string");
    return true;
}

JsonValue textsJson(const std::vector<std::string>& texts) {
    return texts.empty() ? JsonValue() : toJson(texts);
}

void checkWord(const Key& key, const void* value, const Where& where, double) {
    const Range indices = Range::between(0, double(key.words.size()) - 1);
    needWithin(where.locate(key.name), key.member.index(value), indices);
}

void readVariant(const Key& key, JsonReader& reader, void* object, void* context) {
    int index = 0;
    reader.choose(key.name, key.words, index);
    void* alternative = key.member.choose(key.place(object), index);
    key.objects[size_t(index)]->readAny(reader, alternative, context);
}

JsonValue writeWord(const Key& key, const void* value, const void* usual, const void*) {
    const int index = key.member.index(value);
    return usual && index == key.member.index(usual) ? JsonValue() : toJson(key.words[size_t(index)]);
}

JsonValue firstWord(const Key& key, const TextOf&) {
    return toJson(key.words.front());
}

JsonValue wordSchema(const Key& key, const SchemaOf&) {
    return object(shoal::key("enum", key.words));
}

}  // namespace

const KeyKind KeyKind::flag = {
    .name = "true or false",
    .form = RowForm::tick,
    .read = readValue<bool>,
    .write = writeValue<bool>,
    .least = [](const Key&, const TextOf&) { return toJson(true); },
    .schema = [](const Key&, const SchemaOf&) { return shoal::object(key("type", "boolean")); }};

const KeyKind KeyKind::text = {
    .name = "string",
    .tells = KeyKind::Tells::unit,
    .form = RowForm::text,
    .read = readValue<std::string, getText>,
    .write = writeValue<std::string>,
    .least = [](const Key& key, const TextOf& textOf) { return toJson(textOf(key)); },
    .schema = [](const Key& key, const SchemaOf&) { return textSchema(key.notEmpty); }};

const KeyKind KeyKind::texts = {
    .name = "list of strings",
    .form = RowForm::texts,
    .read = readValue<std::vector<std::string>>,
    .write = writeValue<std::vector<std::string>, textsJson>,
    .least = [](const Key&, const TextOf&) { return JsonValue::makeArray(); },
    .schema = [](const Key&, const SchemaOf&) { return listSchema(textSchema(false), 1); }};

const KeyKind KeyKind::word = {.form = RowForm::word,
                               .read =
                                   [](const Key& key, JsonReader& reader, void* object, void*) {
                                       int index = key.member.index(key.value(object));
                                       if (reader.choose(key.name, key.words, index))
                                           key.member.choose(key.place(object), index);
                                   },
                               .check = checkWord,
                               .write = writeWord,
                               .least = firstWord,
                               .schema = wordSchema};

const KeyKind KeyKind::variant = {
    .form = RowForm::variant,
    .read = readVariant,
    .check =
        [](const Key& key, const void* value, const Where& where, double largest) {
            checkWord(key, value, where, largest);
            const Description& chosen = *key.objects[size_t(key.member.index(value))];
            chosen.checkAny(key.member.held(value), where, largest);
        },
    .write = writeWord,
    .least = firstWord,
    .schema = wordSchema};

}  // namespace shoal
