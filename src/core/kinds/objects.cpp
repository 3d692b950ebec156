// Objects, lists of them, and what a function beside the description reads and writes.
#include <algorithm>
#include <optional>

#include "core/kinds/parts.h"
#include "core/smallest.h"

namespace shoal {

namespace {

void readObject(const Key& key, JsonReader& reader, void* object, void* context) {
    std::optional<JsonReader> inner = reader.object(key.name);
    if (!inner) return;
    key.objects[0]->readAny(*inner, key.member.make(key.place(object)), context);
    inner->finish();
}

JsonValue writeObject(const Key& key, const void* value, const void*, const void* context) {
    JsonValue out = JsonValue::makeObject();
    key.objects[0]->writeAny(value, out, context);
    return key.member.optional || !out.members.empty() ? out : JsonValue();
}

// ---- Lists

void readObjects(const Key& key, JsonReader& reader, void* object, void* context) {
    if (!reader.raw(key.name)) return;
    void* list = key.member.make(key.place(object));
    key.member.clear(list);
    for (JsonReader& inner : reader.objects(key.name)) {
        key.objects[0]->readAny(inner, key.member.append(list), context);
        inner.finish();
    }
}

void checkObjects(const Key& key, const void* value, const Where& where, double largest) {
    for (size_t i = 0; i < key.member.count(value); ++i)
        key.objects[0]->checkAny(key.member.element(value, i), where.in(key.name.c_str(), i), largest);
}

JsonValue writeObjects(const Key& key, const void* value, const void* usual, const void* context) {
    JsonValue out = JsonValue::makeArray();
    for (size_t i = 0; i < key.member.count(value); ++i) {
        out.items.push_back(JsonValue::makeObject());
        key.objects[0]->writeAny(key.member.element(value, i), out.items.back(), context);
    }
    const bool same =
        usual && writeJsonLine(out) == writeJsonLine(writeObjects(key, usual, nullptr, context));
    return out.items.empty() || same ? JsonValue() : out;
}

// ---- By hand

using FormValue = Form::Value;

// Makes the least value, `within` so many of its lists.
JsonValue leastForm(const Key& key, size_t within, const TextOf& textOf) {
    const Form& form = key.form;
    if (within < form.lists.size()) {
        const JsonValue element = leastForm(key, within + 1, textOf);
        return toJson(std::vector<JsonValue>(std::max<size_t>(1, form.lists[within].least), element));
    }
    if (!form.constant.empty()) return toJson(form.constant);
    if (form.value == FormValue::text) return toJson(textOf(key));
    if (form.value == FormValue::keys && key.objects.size() == 1)
        return smallestObject(*key.objects[0], textOf);
    return toJson(std::clamp(within > 0 ? 0.0 : 1.0, form.range.least, form.range.most));
}

// Makes the schema of what the lists hold.
JsonValue schemaWithin(const Key& key, const SchemaOf& schemaOf) {
    const Form& form = key.form;
    if (form.value == FormValue::text) return textSchema(form.notEmpty);
    if (form.value == FormValue::keys) return schemaOf(*key.objects.at(0));
    const JsonValue number = numberSchema(form.value == FormValue::whole ? "integer" : "number", form.range);
    return form.value == FormValue::numberOrKeys ? eitherSchema(number, schemaOf(*key.objects.at(0)))
                                                 : number;
}

JsonValue formSchema(const Key& key, const SchemaOf& schemaOf) {
    const Form& form = key.form;
    if (!form.constant.empty()) return object(shoal::key("const", form.constant));
    JsonValue out = schemaWithin(key, schemaOf);
    for (size_t i = form.lists.size(); i-- > 0;)
        out = listSchema(std::move(out), form.lists[i].least, form.lists[i].most);
    return form.usual ? out.add("default", toJson(*form.usual)) : out;
}

RowForm rowOfForm(const Key& key, const JsonValue& value) {
    const Form& form = key.form;
    if (form.value == FormValue::text && form.lists.size() == 1) return RowForm::texts;
    if (form.value == FormValue::text && value.kind == JsonValue::Kind::string) return RowForm::text;
    if (value.kind == JsonValue::Kind::object && key.objects.size() == 1) return RowForm::node;
    return form.value == FormValue::whole ? RowForm::wholes : RowForm::numbers;
}

}  // namespace

const KeyKind KeyKind::object = {
    .name = "object",
    .form = RowForm::node,
    .read = readObject,
    .check = [](const Key& key, const void* value, const Where& where,
                double largest) { key.objects[0]->checkAny(value, where.in(key.name.c_str()), largest); },
    .write = writeObject,
    .least = [](const Key& key, const TextOf& textOf) { return smallestObject(*key.objects[0], textOf); },
    .schema = [](const Key& key, const SchemaOf& schemaOf) { return schemaOf(*key.objects[0]); }};

const KeyKind KeyKind::list = {
    .name = "list of objects",
    .form = RowForm::list,
    .read = readObjects,
    .check = checkObjects,
    .write = writeObjects,
    .least =
        [](const Key& key, const TextOf& textOf) {
            const JsonValue element = smallestObject(*key.objects[0], textOf);
            return toJson(std::vector<JsonValue>(key.needed ? 1 : 0, element));
        },
    .schema = [](const Key& key, const SchemaOf& schemaOf) { return listSchema(schemaOf(*key.objects[0])); }};

const KeyKind KeyKind::byHand = {
    .name = "see the text",
    .tells = KeyKind::Tells::unit,
    .formOf = rowOfForm,
    .write = [](const Key&, const void*, const void*, const void*) { return JsonValue(); },
    .least = [](const Key& key, const TextOf& textOf) { return leastForm(key, 0, textOf); },
    .schema = formSchema};

}  // namespace shoal
