#include "scene/json/saver.h"

#include "core/description.h"
#include "core/json_edit.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

// The keys of a group that can be edited while a scene runs.
constexpr std::initializer_list<const char*> edited = {"particle", "color", "secondColor", "variation",
                                                       "school",   "life",  "emitters"};

JsonValue editable(const Scene& scene, const Group& group) {
    return describe(&group).writeSome(edited, group, &scene);
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
                        "is not the group \"", before.groups[g].name,
                        "\" that was there when it was opened: nothing was saved");
    }
    return *groups;
}

// Reads what was written as a scene is read, so that no file is left that nobody can open.
std::vector<Group> readEdited(const std::string& text, const Scene& after) {
    const JsonValue root = parseJson(text, after.file);
    refuseHugeNumbers(root, after.file);
    const JsonValue& groups = groupsOf(root, after);
    std::vector<Group> out = after.groups;
    for (size_t g = 0; g < groups.items.size(); ++g) {
        Group& group = out[g];
        const JsonValue* count = groups.items[g].find("count");
        if (count && count->kind == JsonValue::Kind::number) group.count = int(count->number);
        JsonReader reader(groups.items[g], after.file, concat("$.groups[", g, "]"));
        copyEdited(Group(), group);
        std::vector<Warning> warnings;
        SceneReading reading{after.models, warnings};
        describe(&group).readSome(edited, reader, group, &reading);
        deriveLife(group, reader);
    }
    return out;
}

}  // namespace

void copyEdited(const Group& from, Group& to) {
    to.particle = from.particle;
    to.life = from.life;
    to.school = from.school;
    to.color = from.color;
    to.secondColor = from.secondColor;
    to.variation = from.variation;
}

std::string withEdits(const std::string& text, const Scene& before, const Scene& after) {
    const JsonValue root = parseJson(text, before.file);
    const JsonValue& groups = groupsOf(root, before);
    std::vector<TextChange> changes;
    for (size_t g = 0; g < groups.items.size(); ++g)
        addChanges(text, groups.items[g], editable(before, before.groups[g]),
                   editable(after, after.groups[g]), changes);
    if (changes.empty()) return text;
    std::string out = withChanges(text, std::move(changes));
    readEdited(out, after);
    return out;
}

bool differ(const Scene& before, const Scene& after) {
    for (size_t g = 0; g < before.groups.size(); ++g)
        if (!sameJson(editable(before, before.groups[g]), editable(after, after.groups[g]))) return true;
    return false;
}

}  // namespace shoal
