// Writes calls of GLSL functions (scene/glsl_call.h) as text, and lays out the numbers that they read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/clocks.h"
#include "scene/glsl_call.h"

namespace shoal {

// Lays numbers out in 4-vectors of parameters: each takes the first room that is left for it.
class NumberLayout {
  public:
    struct Slice {  // so many components of a parameter
        size_t slot = 0;
        int from = 0, count = 0;
    };
    struct Point {  // a SplitPoint
        Slice rest;
        std::optional<Slice> lattice;
    };
    Slice put(const glm::dvec4& value, int count);
    // `far`: whether the point takes both parts; by default as it needs them.
    Point put(const glm::dvec3& point, std::optional<bool> far);

    std::vector<glm::vec4> parameters;

  private:
    std::vector<Slice> free_;
};

// The parameters of a call that has neither clocks nor samples, laid out as its text names them.
std::vector<glm::vec4> parametersOf(const GlslCall& call, bool far);

// The expressions of the position that calls read: the anchor from a point on (m), and the vertex from there.
struct CallFrame {
    std::string anchor = "anchor", position = "position";
    glm::dvec3 origin{0};
};

class CallWriter : private NumberLayout {
  public:
    using NumberLayout::parameters;

    // `name` of a parameter has # for its number, which is counted from `first` on. `samples` is the plan's
    // table, where calls read it.
    explicit CallWriter(std::string name, size_t first = 0, std::vector<glm::vec4>* samples = nullptr,
                        CallFrame frame = {})
        : name_(std::move(name)), first_(first), samples_(samples), frame_(std::move(frame)) {}

    // The text of a call. `far`: of its point (NumberLayout). The layout of the parameters depends on nothing
    // else but the kinds of the arguments.
    std::string text(const GlslCall& call, std::optional<bool> far = {});
    // The sum of some.
    std::string text(const GlslCalls& calls);
    // Appends a 4-vector and returns the text that reads it. What is left of it stays free.
    std::string slot(const glm::dvec3& v, double w = 0);
    // The way from a point to the anchor.
    std::string fromPoint(const glm::dvec3& point, std::optional<bool> far = {});
    // Lays a number out and returns the text that reads it.
    std::string number(double value) { return textOf(put({value, 0, 0, 0}, 1)); }

    std::vector<ClockSlot> clocks;
    std::vector<NoiseTile> tiles;  // that calls read, each once
    std::string cell;              // text of the cell of the call that has one

  private:
    std::string parameter(size_t slot) const;
    std::string textOf(const Slice& slice) const;
    std::string argument(const GlslCall::Argument& argument, std::optional<bool> far);

    std::string name_;
    size_t first_;
    std::vector<glm::vec4>* samples_;
    CallFrame frame_;
    std::vector<std::pair<glm::dvec3, std::string>> points_;  // that are there already, and their texts
};

}  // namespace shoal
