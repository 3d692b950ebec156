// The text of a scene that is edited in the window: the one place in which edits are.
//
// A trial is an edit for this run alone: it runs, is shown as such and is not saved, until it is kept or
// dropped. Comments, order and layout of the file stay in all of it.
#pragma once

#include <string>
#include <vector>

#include "core/json_edit.h"
#include "run/request.h"

namespace shoal::window {

class SceneDocument {
  public:
    struct Text {
        std::string text;
        JsonValue json;  // what it says
        bool operator==(const Text& other) const { return text == other.text; }
    };
    struct Texts {
        Text running, kept;  // with the trials, and without
        bool operator==(const Texts&) const = default;
    };

    // `request`: what is asked for in place of the scene's values is a trial. Error: the file cannot be read.
    SceneDocument(const Scene& scene, const RunRequest& request);

    const std::string& file() const { return file_; }
    const Texts& texts() const { return texts_; }
    const JsonValue& json() const { return texts_.running.json; }
    bool tries() const { return texts_.running != texts_.kept; }
    bool unsaved() const { return texts_.kept != saved_; }

    // Each of these tells what the texts would be; take() makes them so.
    Texts changed(const JsonValue& after, bool trial) const;  // json() says `after`
    Texts withTrials() const { return {texts_.running, texts_.running}; }
    Texts withoutTrials() const { return {texts_.kept, texts_.kept}; }
    Texts saved() const { return {saved_, saved_}; }
    // With what is in the file now. Values that both changed, each in its own way, are put into `conflicts`.
    Texts merged(const std::string& onDisk, Prefer prefer, std::vector<std::string>& conflicts) const;

    // A step that undo takes back; further texts of one gesture, such as a slider's, are one step.
    void take(Texts next, bool sameStep = false);
    const Texts* before() const { return undo_.empty() ? nullptr : &undo_.back(); }
    const Texts* after() const { return redo_.empty() ? nullptr : &redo_.back(); }
    void goBack();
    void goForth();

    // Writes the kept text into the file, anew where it is gone. Error: the file has changed since it was
    // read, or cannot be written.
    void save();
    // The file says `onDisk`, and the texts become `next`: no step leads back beyond it.
    void reread(const std::string& onDisk, Texts next);

  private:
    // `text`, which says `before`, with what differs in `after`.
    Text withJson(const Text& text, const JsonValue& before, const JsonValue& after) const;
    Text read(const std::string& text) const { return {text, parseJson(text, file_)}; }

    std::string file_;
    Text saved_;  // as the file says
    Texts texts_;
    std::vector<Texts> undo_, redo_;
};

}  // namespace shoal::window
