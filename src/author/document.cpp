#include "author/edit.h"

#include <utility>

#include "core/cache_folder.h"
#include "core/file.h"
#include "core/json_edit.h"
#include "molecule/molecule_file.h"
#include "molecule/molecule_json.h"
#include "molecule/skin.h"

namespace shoal {

namespace {

constexpr size_t mostSteps = 500;

std::filesystem::file_time_type timeOf(const std::string& file) {
    std::error_code code;
    const auto time = std::filesystem::last_write_time(file, code);
    return code ? std::filesystem::file_time_type{} : time;
}

JsonValue listOf(const std::vector<int>& numbers) {
    JsonValue out = JsonValue::makeArray();
    for (const int number : numbers)
        out.items.push_back(JsonValue::makeNumber(number));
    return out;
}

// Reads the draft that an editor of the file kept; nothing: it cannot be understood. Its elements are those
// of the file as long as that has not changed since.
std::optional<Draft> readKept(const std::string& text, const std::string& file, const std::string& fileText) {
    try {
        const JsonValue root = parseJson(text, file);
        const JsonValue *molecule = root.find("molecule"), *base = root.find("base");
        if (!molecule || !base) return std::nullopt;
        Draft out(parseMolecule(writeJson(*molecule), file));
        JsonReader reader(root, file);
        const bool same = base->text == contentKey(fileText);
        for (const auto& [key, list] :
             {std::pair("vertices", &out.origins.vertices), std::pair("springs", &out.origins.springs),
              std::pair("bends", &out.origins.bends), std::pair("triangles", &out.origins.triangles)}) {
            std::vector<int> origins;
            reader.get(key, origins);
            if (same && origins.size() == list->size())
                *list = origins;
            else
                std::fill(list->begin(), list->end(), -1);
        }
        return out;
    } catch (const Error&) {
        return std::nullopt;
    }
}

// Through a link, into what it points to.
std::filesystem::path targetOf(const std::string& file) {
    std::error_code code;
    const std::filesystem::path target = std::filesystem::canonical(file, code);
    return code ? std::filesystem::path(file) : target;
}

// $XDG_STATE_HOME/shoal/unsaved, ~/.local/state/shoal/unsaved; else empty.
std::string unsavedFolder() {
    if (const std::string state = environment("XDG_STATE_HOME"); !state.empty())
        return state + "/shoal/unsaved";
    const std::string home = environment("HOME");
    return home.empty() ? home : home + "/.local/state/shoal/unsaved";
}

}  // namespace

Document::Document(const std::string& file) : file_(file) {
    text_ = readFile(file);
    now_ = Draft(parseMolecule(text_, file));
    saved_ = toJson(now_.molecule, true);
    written_ = timeOf(file);
    changed();
    findKept();
}

Document::Document(const std::string& file, Molecule begin)
    : file_(file), isNew_(true), now_(std::move(begin)) {
    std::error_code code;
    if (std::filesystem::exists(file, code)) throw Error(Location{file}, "is there already");
    checkWritable(file);
    now_.molecule.file = file;
    changed();
    findKept();
}

// Looks for what an earlier editor of the file has kept.
void Document::findKept() {
    std::error_code code;
    if (keptFile().empty() || !std::filesystem::is_regular_file(keptFile(), code)) return;
    recovered_ = readKept(readFile(keptFile()), file_, text_);
}

void Document::changed() {
    ++version_;
    placeSkin(now_.molecule);
    problem_ = problemOf(now_.molecule);
    unsaved_ = !sameJson(toJson(now_.molecule, true), saved_);
}

void Document::edit(const std::string& label, const std::function<void(Draft&)>& change, int gesture) {
    const bool goesOn = gesture > 0 && gesture == std::exchange(lastGesture_, gesture);
    if (!goesOn) {
        past_.push_back({now_, label});
        if (past_.size() > mostSteps) past_.erase(past_.begin());
    }
    future_.clear();
    change(now_);
    changed();
}

bool Document::step(std::vector<Step>& from, std::vector<Step>& to) {
    if (from.empty()) return false;
    to.push_back({std::move(now_), from.back().label});
    now_ = std::move(from.back().draft);
    from.pop_back();
    lastGesture_ = 0;
    changed();
    return true;
}

// Starts again from the molecule as its file has it now. The drafts of undo and redo came from the earlier
// file: their elements are new to this one.
void Document::restart(Molecule molecule) {
    now_ = Draft(std::move(molecule));
    saved_ = toJson(now_.molecule, true);
    for (std::vector<Step>* steps : {&past_, &future_})
        for (Step& step : *steps) {
            Draft::Origins& origins = step.draft.origins;
            for (std::vector<int>* list :
                 {&origins.vertices, &origins.springs, &origins.bends, &origins.triangles})
                std::fill(list->begin(), list->end(), -1);
        }
    lastGesture_ = 0;
}

void Document::save() {
    std::string edited;
    if (isNew_) {
        std::error_code code;
        if (std::filesystem::exists(file_, code))
            throw Error(Location{file_}, "was made by another program since it was opened");
        edited = writeMolecule(now_.molecule);
        parseMolecule(edited, file_);  // what is wrong is told before it is written
    } else {
        if (readFile(file_) != text_)
            throw Error(Location{file_}, "was changed by another program since it was opened");
        edited = withEdits(text_, now_);
    }
    if (edited != text_) writeFile(file_, edited);
    isNew_ = false;
    // The draft is now as the file is. The drafts of undo and redo keep their origins where they have the
    // same elements.
    text_ = edited;
    const Draft before = now_;
    restart(parseMolecule(text_, file_));
    for (std::vector<Step>* steps : {&past_, &future_})
        for (Step& step : *steps)
            if (step.draft.molecule.vertices.size() == before.molecule.vertices.size() &&
                step.draft.molecule.springs.size() == before.molecule.springs.size() &&
                step.draft.molecule.bends.size() == before.molecule.bends.size() &&
                step.draft.molecule.triangles.size() == before.molecule.triangles.size())
                step.draft.origins = now_.origins;
    written_ = timeOf(file_);
    changed();
    closeInOrder();
}

void Document::reload() {
    const std::string text = readFile(file_);
    Molecule molecule = parseMolecule(text, file_);
    past_.push_back({now_, "reload"});
    future_.clear();
    text_ = text;
    isNew_ = false;
    restart(std::move(molecule));
    written_ = timeOf(file_);
    changed();
}

bool Document::changedOnDisk() const {
    if (timeOf(file_) == written_) return false;
    try {
        return readFile(file_) != text_;
    } catch (const Error&) {
        return false;  // gone for a moment, while another program writes it
    }
}

void Document::takeRecovered() {
    edit("recover", [this](Draft& draft) { draft = *recovered_; });
    recovered_.reset();
}

void Document::dropRecovered() {
    recovered_.reset();
    closeInOrder();
}

// One name for each file, whatever way leads to it.
std::filesystem::path Document::keptFile() const {
    const std::string folder = unsavedFolder();
    if (folder.empty()) return {};
    const std::filesystem::path whole = targetOf(std::filesystem::absolute(file_).string());
    return std::filesystem::path(folder) /
           concat(whole.stem().string(), "-", contentKey(whole.string()).substr(0, 16), ".json");
}

std::string Document::kept() const {
    const Draft& draft = now_;
    JsonValue root = JsonValue::makeObject();
    root.add("file", JsonValue::makeString(file_))
        .add("base", JsonValue::makeString(contentKey(text_)))
        .add("vertices", listOf(draft.origins.vertices))
        .add("springs", listOf(draft.origins.springs))
        .add("bends", listOf(draft.origins.bends))
        .add("triangles", listOf(draft.origins.triangles))
        .add("molecule", toJson(draft.molecule, true));
    return writeJson(root);
}

std::optional<std::string> Document::keep() {
    if (keptVersion_ == version_ || recovered_) return std::nullopt;
    if (!unsaved_ && keptVersion_ == 0) return std::nullopt;
    keptVersion_ = version_;
    if (!unsaved_) {
        closeInOrder();
        return std::nullopt;
    }
    try {
        if (keptFile().empty()) throw Error("neither XDG_STATE_HOME nor HOME is set");
        writeFile(keptFile(), kept());
    } catch (const Error& error) {
        if (!std::exchange(toldOfKeeping_, true))
            return concat("what is not saved would be lost in a crash: ", error.what());
    }
    return std::nullopt;
}

void Document::closeInOrder() {
    if (recovered_) return;  // not decided yet: it stays
    std::error_code code;
    if (!keptFile().empty()) std::filesystem::remove(keptFile(), code);
}

}  // namespace shoal
