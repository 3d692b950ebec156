// The call of a GLSL function with what it reads, as data: a kind of field or force says which function of
// shaders/physics it is. compile/call_writer.h makes its text and its uniforms. Numbers become uniforms, so
// that changing one compiles nothing; what shapes the code is text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace shoal {

// One 4-vector of parameters that is renewed at the start of a frame at time t:
//   angle    x: start + rate t, rad, less whole turns
//   cells    rate t in cells of a lattice:  x: less whole ones;  y, z: the lower and the upper 16 bits of
//   those frames   x: the frame of a sequence that was last passed;  y: s since then
struct FieldClock {
    enum class Kind { angle, cells, frames };
    Kind kind = Kind::angle;
    double rate = 0;              // rad/s, or cells per s
    double start = 0;             // rad
    std::vector<double> times{};  // s, of frames
    double period = 0;            // s, of frames that repeat; 0: they do not
};

class GlslCall {
  public:
    struct Argument {
        enum class Kind { from, vector, pair, number, text, clock, samples, numbers, call };
        Kind kind;
        glm::dvec3 value{0};
        std::string text = {};
        FieldClock clock = {};
        const std::vector<glm::vec3>* samples = nullptr;
        std::vector<double> numbers = {};
        std::vector<GlslCall> inner = {};
    };
    using Kind = Argument::Kind;

    explicit GlslCall(std::string function) : function_(std::move(function)) {}

    // The position relative to a point (vec3, m), exact far from the origin.
    GlslCall& from(const glm::dvec3& point) { return add({Kind::from, point}); }
    // The position in the world (vec3, m), and the time since the frame's start (float, s).
    GlslCall& place() { return text("anchor + position"); }
    GlslCall& time() { return text("time"); }
    GlslCall& vector(const glm::dvec3& value) { return add({Kind::vector, value}); }
    GlslCall& pair(const glm::dvec2& value) { return add({Kind::pair, {value, 0}}); }
    GlslCall& number(double value) { return add({Kind::number, {value, 0, 0}}); }
    GlslCall& text(std::string words) { return add({.kind = Kind::text, .text = std::move(words)}); }
    // One argument of an angle: what it is at the frame's start. Two of cells: the part of one (float) and
    // the whole ones (uint). Two of frames: the frame, and the time since it (float, s).
    GlslCall& clock(FieldClock clock) { return add({.kind = Kind::clock, .clock = std::move(clock)}); }
    // Where the values begin in the table of samples (int). Samples outlive the call.
    GlslCall& samples(const std::vector<glm::vec3>& values) {
        return add({.kind = Kind::samples, .samples = &values});
    }
    GlslCall& numbers(std::vector<double> values) {
        return add({.kind = Kind::numbers, .numbers = std::move(values)});
    }
    GlslCall& call(GlslCall inner) { return add({.kind = Kind::call, .inner = {std::move(inner)}}); }

    const std::string& function() const { return function_; }
    const std::vector<Argument>& arguments() const { return arguments_; }

  private:
    GlslCall& add(Argument argument) {
        arguments_.push_back(std::move(argument));
        return *this;
    }

    std::string function_;
    std::vector<Argument> arguments_;
};

using GlslCalls = std::vector<GlslCall>;  // their results add up

}  // namespace shoal
