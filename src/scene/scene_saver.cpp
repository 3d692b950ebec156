#include "scene/scene_saver.h"

#include <filesystem>

#include "core/file.h"
#include "core/json_edit.h"
#include "scene/life_writer.h"
#include "scene/particle_writer.h"
#include "scene/scene_reader.h"

namespace shoal {

namespace {

JsonValue editable(const Scene& scene, const Group& group) {
    JsonValue out = JsonValue::makeObject();
    const auto add = [&out](const char* key, std::optional<JsonValue> value) {
        if (value) out.add(key, std::move(*value));
    };
    if (group.particle) add("particle", writeParticle(*group.particle, scene.file));
    if (!group.life) return out;
    add("life", writeLife(group));
    add("emitters", writeEmitters(group, scene.models));
    return out;
}

// Where `groups` stand in the file, as long as they are the ones that were read.
const JsonValue& groupsOf(const JsonValue& root, const Scene& before) {
    const JsonValue* groups = root.find("groups");
    if (!groups || groups->kind != JsonValue::Kind::array || groups->items.size() != before.groups.size())
        throw Error(Location{before.file, 0, 0, "$.groups"},
                    "has other groups than when it was opened: nothing was saved");
    for (size_t g = 0; g < groups->items.size(); ++g) {
        const JsonValue* name = groups->items[g].find("name");
        if (name && name->text != before.groups[g].name)
            throw Error(Location{before.file, name->line, name->column, concat("$.groups[", g, "].name")},
                        concat("is not the group \"", before.groups[g].name,
                               "\" that was there when it was opened: nothing was saved"));
    }
    return *groups;
}

// Reads what was written as a scene is read, so that no file is left that nobody can open.
void checkReadable(const std::string& text, const Scene& after) {
    const JsonValue root = parseJson(text, after.file);
    refuseHugeNumbers(root, after.file);
    const JsonValue& groups = groupsOf(root, after);
    for (size_t g = 0; g < groups.items.size(); ++g) {
        Group group = after.groups[g];
        const JsonValue* count = groups.items[g].find("count");
        if (count && count->kind == JsonValue::Kind::number) group.count = int(count->number);
        JsonReader reader(groups.items[g], after.file, concat("$.groups[", g, "]"));
        if (auto particle = reader.object("particle")) readParticleType(*particle);
        readLife(reader, group, after.models);
    }
}

}  // namespace

std::string withEdits(const std::string& text, const Scene& before, const Scene& after) {
    const JsonValue root = parseJson(text, before.file);
    const JsonValue& groups = groupsOf(root, before);
    std::vector<TextChange> changes;
    for (size_t g = 0; g < groups.items.size(); ++g)
        addChanges(text, groups.items[g], editable(before, before.groups[g]),
                   editable(after, after.groups[g]), changes);
    if (changes.empty()) return text;
    std::string out = withChanges(text, std::move(changes));
    checkReadable(out, after);
    return out;
}

bool differ(const Scene& before, const Scene& after) {
    for (size_t g = 0; g < before.groups.size(); ++g)
        if (!sameJson(editable(before, before.groups[g]), editable(after, after.groups[g]))) return true;
    return false;
}

void saveEdits(const Scene& before, const Scene& after) {
    const std::string text = readFile(before.file), edited = withEdits(text, before, after);
    // through a link, into what it points to
    std::error_code code;
    const std::filesystem::path target = std::filesystem::canonical(before.file, code);
    if (edited != text) writeFile(code ? std::filesystem::path(before.file) : target, edited);
}

}  // namespace shoal
