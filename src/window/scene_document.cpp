#include "window/scene_document.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/file.h"
#include "core/json_build.h"

namespace shoal::window {

SceneDocument::Text SceneDocument::withJson(const Text& text, const JsonValue& before,
                                            const JsonValue& after) const {
    std::vector<TextChange> changes;
    addChanges(text.text, before, before, after, changes);
    return changes.empty() ? text : read(withChanges(text.text, std::move(changes)));
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
    : file_(scene.file), saved_(read(readFile(file_))), texts_{saved_, saved_} {
    texts_ = changed(withRequest(json(), scene, request), true);
}

SceneDocument::Texts SceneDocument::changed(const JsonValue& after, bool trial) const {
    Texts out{withJson(texts_.running, json(), after), texts_.kept};
    if (trial) return out;
    if (!tries()) return {out.running, out.running};
    std::vector<std::string> settled;  // an edit of what was tried settles it
    const JsonValue& without = texts_.kept.json;
    out.kept =
        withJson(texts_.kept, without, shoal::merged(json(), after, without, Prefer::mine, "$", settled));
    return out;
}

SceneDocument::Texts SceneDocument::merged(const std::string& onDisk, Prefer prefer,
                                           std::vector<std::string>& conflicts) const {
    if (onDisk == saved_.text) return texts_;
    const Text theirs = read(onDisk);
    const auto merge = [&](const Text& mine, std::vector<std::string>& differing) {
        return withJson(theirs, theirs.json,
                        shoal::merged(saved_.json, mine.json, theirs.json, prefer, "$", differing));
    };
    std::vector<std::string> kept;  // are among the others, unless a trial hides them
    return {merge(texts_.running, conflicts), merge(texts_.kept, kept)};
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
    const bool gone = !std::filesystem::exists(file_);
    if (!gone && readFile(file_) != saved_.text)
        throw Error(Location{file_}, "has changed since it was read: nothing was saved");
    if (gone || unsaved()) writeFile(file_, texts_.kept.text);
    saved_ = texts_.kept;
}

void SceneDocument::reread(const std::string& onDisk, Texts next) {
    if (onDisk != saved_.text) {
        undo_.clear();
        redo_.clear();
        saved_ = read(onDisk);
        texts_ = saved();
    }
    if (next != texts_) take(std::move(next));
}

}  // namespace shoal::window
