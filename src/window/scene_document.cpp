#include "window/scene_document.h"

#include <algorithm>
#include <utility>

#include "core/file.h"
#include "core/json_build.h"

namespace shoal::window {

// Returns `text`, which says `before`, with what differs in `after`.
static std::string withJson(const std::string& text, const JsonValue& before, const JsonValue& after) {
    std::vector<TextChange> changes;
    addChanges(text, before, before, after, changes);
    return withChanges(text, std::move(changes));
}

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

// What a request asks for in place of values of the file, which was read with it as `scene`.
static JsonValue withRequest(JsonValue root, const Scene& scene, const RunRequest& request) {
    if (request.dt) setMember(root, "frameRate", toJson(scene.frameRate));
    if (request.seed) setMember(root, "seed", toJson(scene.seed));
    const auto setSolver = [&](const char* key, const JsonValue& value) {
        setMember(memberOf(root, "solver"), key, value);
    };
    if (request.solver) setSolver("method", toJson(*request.solver ? name(**request.solver) : "auto"));
    if (request.substeps) setSolver("substeps", toJson(scene.solver.substeps));
    if (request.sampling) setSolver("fieldSampling", toJson(name(*request.sampling)));
    for (size_t g = 0; request.count && g < scene.groups.size(); ++g) {
        const Group& group = scene.groups[g];
        JsonValue& says = memberOf(root, "groups").items[g];
        if (says.find("count")) setMember(says, "count", toJson(group.count));
        if (group.life) setMember(memberOf(says, "life"), "capacity", toJson(group.life->capacity));
    }
    return root;
}

SceneDocument::SceneDocument(const Scene& scene, const RunRequest& request)
    : file_(scene.file), saved_(readFile(file_)), texts_{saved_, saved_} {
    texts_ = changed(withRequest(json(), scene, request), true);
}

SceneDocument::Texts SceneDocument::changed(const JsonValue& after, bool trial) const {
    const JsonValue before = json();
    Texts out{withJson(texts_.running, before, after), texts_.kept};
    if (trial) return out;
    if (!tries()) return {out.running, out.running};
    std::vector<std::string> settled;  // an edit of what was tried settles it
    const JsonValue without = kept();
    out.kept =
        withJson(texts_.kept, without, shoal::merged(before, after, without, Prefer::mine, "$", settled));
    return out;
}

SceneDocument::Texts SceneDocument::merged(const std::string& onDisk, Prefer prefer,
                                           std::vector<std::string>& conflicts) const {
    if (onDisk == saved_) return texts_;
    const JsonValue base = parseJson(saved_, file_), theirs = parseJson(onDisk, file_);
    const auto merge = [&](const JsonValue& mine, std::vector<std::string>& differing) {
        return withJson(onDisk, theirs, shoal::merged(base, mine, theirs, prefer, "$", differing));
    };
    std::vector<std::string> kept;  // are among the others, unless a trial hides them
    return {merge(json(), conflicts), merge(this->kept(), kept)};
}

void SceneDocument::take(Texts next, bool sameStep) {
    if (!sameStep) undo_.push_back(texts_);
    redo_.clear();
    texts_ = std::move(next);
}

void SceneDocument::goBack() {
    redo_.push_back(std::exchange(texts_, undo_.back()));
    undo_.pop_back();
}

void SceneDocument::goForth() {
    undo_.push_back(std::exchange(texts_, redo_.back()));
    redo_.pop_back();
}

void SceneDocument::save() {
    if (readFile(file_) != saved_)
        throw Error(Location{file_}, "has changed since it was read: nothing was saved");
    if (unsaved()) writeFile(file_, texts_.kept);
    saved_ = texts_.kept;
}

void SceneDocument::reread(const std::string& onDisk, Texts next) {
    if (onDisk != saved_) {
        undo_.clear();
        redo_.clear();
        saved_ = onDisk;
        texts_ = saved();
    }
    if (next != texts_) take(std::move(next));
}

}  // namespace shoal::window
