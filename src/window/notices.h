// Messages and questions of the window, over the picture; scene_chooser.cpp asks for a scene.
#pragma once

#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "core/error.h"
#include "core/file_watch.h"
#include "core/json_edit.h"
#include "gpu/texture.h"
#include "run/scene_list.h"

namespace shoal::window {

// The current problems by their causes: each is shown until it is gone, or the user closes it.
class Troubles {
  public:
    // False: it was said already.
    bool begin(const std::string& cause, const std::string& words);
    void warn(const std::string& cause, const std::string& words);          // begin(), and on standard error
    bool end(const std::string& cause) { return words_.erase(cause) > 0; }  // true: it was shown
    void clear() { words_.clear(); }
    // Each attempt that fails is told anew; true: it did not.
    template <typename Work>
    bool attempt(const std::string& cause, const Work& work) {
        end(cause);
        try {
            work();
            return true;
        } catch (const Error& error) {
            if (begin(cause, error.message())) std::cerr << "shoal: warning: " << error.what() << std::endl;
            return false;
        }
    }
    std::string text() const;  // empty: nothing is wrong

  private:
    std::map<std::string, std::string> words_;  // by their causes
};

// At the top (of a narrow window, at the bottom), between `left` and `right` (from the window's right edge):
// why changed files do not run, as long as that is so, and a message with a button to close it. True: it was
// pressed. Empty: nothing is shown.
bool showNotices(const std::string& problem, const std::string& message, float left, float right);

// Folded until the user unfolds it, from the window's right and bottom edges: what is worth telling of a
// scene that runs all the same.
void showWarnings(const std::vector<Warning>& warnings, float right, float bottom);

// One line at the bottom.
class StatusLine {
  public:
    void say(const std::string& line);      // for some seconds
    void draw(const std::string& instead);  // of what goes on now; empty: nothing does

  private:
    std::string line_;
    double saidAt_ = -1e9;  // s
};

// Says what the window waits for, with a bar for the share of it that is done, where that is not 0.
void drawWaiting(const std::string& words, double share);

// Asks whether to save before `what` goes on ("close").
enum class Answer { none, save, discard, stay };
Answer askBeforeLeaving(const std::string& file, const char* what);

// Asks which wins of values edited in the window and changed in the file, too. Nothing: not answered yet.
// Without conflicts the question closes.
std::optional<Prefer> askWhoWins(const std::vector<std::string>& conflicts);

// Begins a window in the middle, in front of all else when it appears; `width`: points at most. `open`: null
// where it cannot be closed.
void beginMiddle(const char* title, bool* open, float width);

// Keys and what they do, over the picture: rows that a row of nulls ends. False: the user closed it.
struct HelpRow {
    const char* keys;
    const char* what;
};
bool showHelp(const char* title, const HelpRow* rows);

// A row of a list: a picture, which `draw` draws from corner to corner, a name and some words. True: it was
// chosen.
using DrawPicture = std::function<void(ImDrawList& list, ImVec2 low, ImVec2 high)>;
bool pictureRow(ImVec2 size, const DrawPicture& draw, const std::string& name, const std::string& words,
                const std::string& tip);

// A list of scenes in the middle of the window, each with its picture, where NAME.scene.png lies beside it,
// and with what it says of itself.
class SceneChooser {
  public:
    explicit SceneChooser(gpu::Context& context) : context_(&context) {}
    bool open = false;

    void list(const std::string& folder);  // what lies in it or below; opens
    // A scene that was chosen cannot be opened, until one of its files changes.
    void refused(const std::string& file);
    bool changed(double time) { return !refused_.changed(time).empty(); }  // such a file has; s

    // Which scene was chosen; empty: none. `mustChoose`: nothing runs yet, so that it cannot be closed.
    // `message`: above the list.
    std::string draw(bool mustChoose, const std::string& message);

  private:
    const gpu::Texture* pictureOf(const std::string& file);  // null: there is none
    bool drawRow(const ListedScene& scene);                  // true: it was chosen

    gpu::Context* context_;
    std::map<std::string, gpu::Texture> pictures_;  // by the scenes' files; without one where there is none
    std::vector<ListedScene> scenes_;
    std::string folder_;
    FileWatch refused_;
};

}  // namespace shoal::window
