// The call of a GLSL function with what it reads, as data: a kind of field, force or collider says which
// function of the shaders it is. compile/call_writer.h makes its text and its uniforms. Numbers become
// uniforms, so that changing one compiles nothing; what shapes the code is text.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/noise_tile.h"

namespace shoal {

// One reading of a kind of field at a vertex, or one look for contact with a kind of collider.
struct ReadingCost {
    double operations = 0;
    double fetches = 0;  // 4-vectors of the table of samples, or filtered reads of a tile of noise
};

// One 4-vector of parameters that is renewed at the start of a frame at time t:
//   angle    x: start + rate t, rad, less whole turns
//   cells    start + rate t in cells of a lattice:  x: less whole ones;  y, z: the lower and the upper 16
//            bits of those
//   frames   x: the frame of a sequence that was last passed;  y: s since then
struct FieldClock {
    enum class Kind { angle, cells, frames };
    Kind kind = Kind::angle;
    double rate = 0;              // rad/s, or cells per s
    double start = 0;             // rad, or cells
    std::vector<double> times{};  // s, of frames
    double period = 0;            // s, of frames that repeat; 0: they do not
};

class GlslCall {
  public:
    using Append = std::function<void(std::vector<glm::vec4>& table)>;
    struct Argument {
        enum class Kind { from, apart, numbers, axis, cell, text, clock, samples, tile, call };
        Kind kind;
        glm::dvec4 value{0};
        int count = 0;  // of the components that are a parameter's
        std::string text = {};
        FieldClock clock = {};
        Append append = {};
        NoiseTile tile = {};
        std::vector<GlslCall> inner = {};
    };
    using Kind = Argument::Kind;

    explicit GlslCall(std::string function) : function_(std::move(function)) {}

    // The position relative to a point (vec3, m), exact far from the origin.
    GlslCall& from(const glm::dvec3& point) { return add({Kind::from, {point, 0}}); }
    // Passes the position from a point on in two parts: the way from the point to the anchor, which is the
    // same in every substep, and the position from there.
    GlslCall& apart(const glm::dvec3& point) { return add({Kind::apart, {point, 0}}); }
    // The position relative to a point, or where that is the scene's origin as one float (vec3, m).
    GlslCall& place(const glm::dvec3& point) {
        return point == glm::dvec3(0) ? text("anchor + position") : from(point);
    }
    // The time since the frame's start (float, s).
    GlslCall& time() { return text("time"); }
    GlslCall& four(const glm::dvec4& value) { return add({Kind::numbers, value, 4}); }
    // A vec3 and a float that share a parameter.
    GlslCall& axis(const glm::dvec3& value, double w) { return add({Kind::axis, {value, w}, 4}); }
    GlslCall& vector(const glm::dvec3& value) { return add({Kind::numbers, {value, 0}, 3}); }
    GlslCall& pair(const glm::dvec2& value) { return add({Kind::numbers, {value, 0, 0}, 2}); }
    GlslCall& number(double value) { return add({Kind::numbers, {value, 0, 0, 0}, 1}); }
    // The distance between the samples of a distance field (float, m), up to which a way is short. The
    // distance changes up to root 3 times as fast as the place (shaders/step/survey.glsl).
    GlslCall& cell(double value) { return add({Kind::cell, {value, 0, 0, 0}, 1}); }
    GlslCall& text(std::string words) { return add({.kind = Kind::text, .text = std::move(words)}); }
    // One argument of an angle: what it is at the frame's start. Two of cells: the part of one (float) and
    // the whole ones (uint). Two of frames: the frame, and the time since it (float, s).
    GlslCall& clock(FieldClock clock) { return add({.kind = Kind::clock, .clock = std::move(clock)}); }
    // Where the samples begin in the table of samples (int). Values outlive the call, as does what `append`
    // captures.
    GlslCall& samples(Append append) { return add({.kind = Kind::samples, .append = std::move(append)}); }
    GlslCall& samples(const std::vector<glm::vec3>& values) {
        return samples([&values](std::vector<glm::vec4>& table) {
            table.reserve(table.size() + values.size());
            for (const glm::vec3& value : values)
                table.emplace_back(value, 0.0f);
        });
    }
    GlslCall& numbers(std::vector<double> values) {
        return samples([values = std::move(values)](std::vector<glm::vec4>& table) {
            for (const double number : values)
                table.emplace_back(float(number), 0.0f, 0.0f, 0.0f);
        });
    }
    // The texture of a tile of noise (sampler3D).
    GlslCall& tile(const NoiseTile& tile) { return add({.kind = Kind::tile, .tile = tile}); }
    GlslCall& call(GlslCall inner) { return add({.kind = Kind::call, .inner = {std::move(inner)}}); }

    // The called function works along axes that are turned so; its surface is turned back.
    GlslCall& turned(const std::optional<glm::dquat>& rotation) {
        rotation_ = rotation;
        return *this;
    }

    const std::string& function() const { return function_; }
    const std::vector<Argument>& arguments() const { return arguments_; }
    const std::optional<glm::dquat>& rotation() const { return rotation_; }
    bool readsSamples() const {
        return std::any_of(arguments_.begin(), arguments_.end(),
                           [](const Argument& argument) { return argument.kind == Kind::samples; });
    }
    // The point from which the position is taken, of one whose first argument that is.
    glm::dvec3 origin() const { return arguments_.front().value; }

  private:
    GlslCall& add(Argument argument) {
        arguments_.push_back(std::move(argument));
        return *this;
    }

    std::string function_;
    std::vector<Argument> arguments_;
    std::optional<glm::dquat> rotation_;
};

using GlslCalls = std::vector<GlslCall>;  // their results add up

}  // namespace shoal
