// ImGui's context and backends, for as long as the window lives, and how the panels look.
//
// Panels are laid out in points: pixels of a screen of ordinary density. On a denser one, and with --scale, a
// point is more pixels, and the font is made anew at that size, so that letters stay sharp.
#pragma once

#include <memory>
#include <optional>

#include "window/input.h"

namespace shoal::window {

class Interface {
  public:
    // `scale`: pixels a point; nothing: what the window's screen asks for, also when it moves to another one.
    explicit Interface(GLFWwindow* window, std::optional<double> scale = {});
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    void begin();  // of a frame; what the user does in it is in input()
    void end();    // draws the panels over what is there
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
    Density made_;  // what font and style are made for
};

constexpr double leastScale = 0.5, mostScale = 4;  // of --scale

// So many points in the interface's units, between begin() and end().
float points(float count);

}  // namespace shoal::window
