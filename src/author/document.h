// The molecule that is being edited: its draft, undo and redo, saving, and a copy of what is not saved that
// outlives a crash.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "molecule/draft.h"

namespace shoal {

class Document {
  public:
    // Error: readMolecule's.
    explicit Document(const std::string& file);

    const Draft& draft() const { return now_.draft; }
    const Molecule& molecule() const { return now_.draft.molecule; }
    const std::string& file() const { return file_; }
    // Why it cannot be saved or run as it is; empty: it can.
    const std::string& problem() const { return problem_; }
    int version() const { return version_; }  // another number after every change

    // One step of undo by the name of `label`; calls with the same `gesture` (above 0) that follow one
    // another make one.
    void edit(const std::string& label, const std::function<void(Draft&)>& change, int gesture = 0);
    int newGesture() { return ++gestures_; }
    bool undo();
    bool redo();
    // The label of the step that undo or redo would take back; empty: there is none.
    std::string undoLabel() const { return past_.empty() ? "" : past_.back().label; }
    std::string redoLabel() const { return future_.empty() ? "" : future_.back().label; }

    bool unsaved() const { return unsaved_; }
    // Into its file's own text. Error: writeFile's, withEdits'; nothing is lost then.
    void save();
    // Takes the file as it is now; one step of undo. Error: readMolecule's; nothing changes then.
    void reload();
    // The file was written by someone else since it was read or saved.
    bool changedOnDisk() const;

    // Whether an earlier editor of the same file left unsaved work that is neither taken nor dropped yet.
    bool recovered() const { return recovered_.has_value(); }
    void takeRecovered();  // one step of undo
    void dropRecovered();
    // Writes what is not saved beside what programs keep for themselves (unsavedFolder()); call now and then.
    // Says once why it cannot.
    std::optional<std::string> keep();
    void closeInOrder();  // nothing is left to be recovered

  private:
    struct Step {
        Draft draft;
        std::string label;  // of what led away from it, in past_; to it, in future_
    };
    void changed();
    void restart(Molecule molecule);
    std::string kept() const;
    std::filesystem::path keptFile() const;

    std::string file_;
    std::string text_;  // of the file, as read or saved last
    Step now_;
    JsonValue saved_;  // what the file says
    std::vector<Step> past_, future_;
    int lastGesture_ = 0, gestures_ = 0, version_ = 0, keptVersion_ = 0;
    bool unsaved_ = false, toldOfKeeping_ = false;
    std::string problem_;
    std::optional<Draft> recovered_;
    std::filesystem::file_time_type written_{};
};

// $XDG_STATE_HOME/shoal/unsaved, ~/.local/state/shoal/unsaved; else empty.
std::string unsavedFolder();

}  // namespace shoal
