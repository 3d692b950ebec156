// Writes calls of GLSL functions (scene/glsl_call.h) as text, and lays out the numbers that they read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/clocks.h"
#include "scene/glsl_call.h"

namespace shoal {

class CallWriter {
  public:
    // Parameters are elements of `array`, from `first` on. `samples` is the plan's table, where calls read
    // it.
    explicit CallWriter(std::string array, size_t first = 0, std::vector<glm::vec4>* samples = nullptr)
        : array_(std::move(array)), first_(first), samples_(samples) {}

    // The text of a call. `far`: whether its point takes two parameters (SplitPoint); by default as the point
    // needs them. The layout of the parameters depends on nothing else but the kinds of the arguments.
    std::string text(const GlslCall& call, std::optional<bool> far = {});
    // The sum of some.
    std::string text(const GlslCalls& calls);
    // Appends a 4-vector and returns the text that reads it. What is left of it stays free.
    std::string slot(const glm::dvec3& v, double w = 0);
    // The way from a point to the anchor.
    std::string fromPoint(const glm::dvec3& point, std::optional<bool> far = {});

    std::vector<glm::vec4> parameters;
    std::vector<ClockSlot> clocks;

  private:
    struct Space {  // components of the last slots that no number has taken yet
        size_t slot = 0;
        int next = 0;
    };
    std::string component(size_t slot, int from, int count) const;
    std::string numbers(const glm::dvec3& value, int count);
    std::string argument(const GlslCall::Argument& argument, std::optional<bool> far);

    std::string array_;
    size_t first_;
    std::vector<glm::vec4>* samples_;
    std::vector<Space> free_;
    std::vector<std::pair<glm::dvec3, std::string>> points_;  // that are there already, and their texts
};

}  // namespace shoal
