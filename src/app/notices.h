// What the window has to say or to ask, over the picture.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/json_merge.h"

namespace shoal::app {

// What is wrong now, each by its cause: it is shown until that is gone, or the user closes it.
class Troubles {
  public:
    // False: it was said already.
    bool begin(const std::string& cause, const std::string& words);
    bool end(const std::string& cause) { return words_.erase(cause) > 0; }  // true: it was shown
    void clear() { words_.clear(); }
    std::string text() const;  // empty: nothing is wrong

  private:
    std::map<std::string, std::string> words_;  // by their causes
};

// At the top (of a narrow window, at the bottom), between `left` and `right` (from the window's right edge):
// why changed files do not run, as long as that is so, and a message with a button to close it. True: it was
// pressed. Empty: nothing is shown.
bool showNotices(const std::string& problem, const std::string& message, float left, float right);

// One line at the bottom.
class StatusLine {
  public:
    void say(const std::string& line);      // for some seconds
    void draw(const std::string& instead);  // of what goes on now; empty: nothing does

  private:
    std::string line_;
    double saidAt_ = -1e9;  // s
};

void drawOpening(const std::string& file);  // that a scene is being opened

// Of the question whether to save, before something goes on ("close").
enum class Answer { none, save, discard, stay };
Answer askBeforeLeaving(const std::string& file, const char* what);

// Of what was edited in the window and changed in the file, too. Nothing: not answered yet. Without conflicts
// nothing is asked any more.
std::optional<Prefer> askWhoWins(const std::vector<std::string>& conflicts);

}  // namespace shoal::app
