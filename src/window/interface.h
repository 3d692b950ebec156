// ImGui's context and backends, for as long as the window lives, how the panels look, and the events of
// pointer and keys (input.cpp).
//
// Panels are laid out in points: pixels of a screen of ordinary density. On a denser one, and with --scale, a
// point is more pixels, and the letters (font.h) are made anew at that size, so that they stay sharp.
#pragma once

#include <deque>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <imgui.h>

#include "window/font.h"

struct GLFWwindow;

namespace shoal::window {

// Events of pointer and keys, in the order in which they came. A frame may take longer than a click or a key:
// events since the last frame wait, and each frame takes as many as it can tell apart.
class Input {
  public:
    // After ImGui's own backend was made without callbacks: these pass on to it.
    explicit Input(GLFWwindow* window);
    ~Input();
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    // What this frame holds; once a frame. `chooses`: the user moves among rows or in what has popped up,
    // where Space, Home and Escape are not the window's.
    void next(bool chooses);
    void wait();    // instead: a frame that takes nothing, because the program is busy
    void settle();  // after ImGui's backend has asked the window itself, which knows only how things are now

    // ---- Keys, by GLFW's numbers

    // `heard`: else keys are someone else's, such as a text that is typed.
    void look(bool heard) { heard_ = heard; }
    bool pressed(int key) const { return heard_ && pressed_.contains(key); }  // went down in this frame
    bool held(int key) const { return down_.contains(key); }
    bool control() const;                                                  // is held
    bool waits() const { return !waiting_.empty() || !arrived_.empty(); }  // an event, for the next frame
    bool acts() const { return acts_; }  // something is held, or happened in this frame, but for moves
    const std::vector<std::string>& dropped() const { return dropped_; }  // files, in this frame

  private:
    struct Event {
        enum class Kind { move, wheel, button, key, text } kind;
        int code = 0;       // of the button or key; the letter
        bool down = false;  // pressed, not released
        int scan = 0, modifiers = 0;
        double x = 0, y = 0;
    };
    struct Taken {
        bool moved = false, rolled = false, ends = false;
        std::set<int> released;  // keys
    };
    void listen();
    bool fits(const Event& event, const Taken& taken) const;
    void take(const Event& event, Taken& taken);
    void add(const Event& event) { waiting_.push_back(event); }

    GLFWwindow* window_;
    std::deque<Event> waiting_;
    std::vector<std::string> arrived_, dropped_;  // files, for the next frame and of this one
    std::set<int> down_, pressed_;                // keys
    bool heard_ = true, acts_ = false;
    std::set<int> buttons_;  // that are held
    ImVec2 place_{0, 0};     // of the pointer
    std::ofstream frames_;   // $SHOAL_FRAMES: "." for each frame with no event left, "w" for each that waits
};

class Interface {
  public:
    // `scale`: pixels a point; nothing: what the window's screen asks for, also when it moves to another one.
    explicit Interface(GLFWwindow* window, std::optional<double> scale = {});
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    void begin();  // of a frame; what the user does in it is in input()
    void end();    // draws the panels over what is there
    // Instead of a frame, while the program is busy: draws the panels as they were, and says what is waited
    // for (notices.h). Nothing that the user does or holds is taken or lost.
    void wait(const std::string& words, double share);
    Input& input() { return *input_; }
    double pixelsPerPoint() const { return double(made_.unitsPerPoint * made_.pixelsPerUnit); }

  private:
    // How many of the interface's units a point is, and how many pixels the window system counts as a unit.
    struct Density {
        float unitsPerPoint = 1, pixelsPerUnit = 1;
        bool operator==(const Density&) const = default;
    };
    Density density() const;
    void makeFont(const Density& density);

    GLFWwindow* window_;
    std::unique_ptr<Input> input_;
    std::optional<double> scale_;
    std::optional<FontFile> outlines_;  // nothing: the built-in font
    bool begun_ = false;                // a frame
    Density made_;                      // what font and style are made for
};

constexpr double leastScale = 0.5, mostScale = 4;  // of --scale

// So many points in the interface's units, between begin() and end().
float points(float count);

}  // namespace shoal::window
