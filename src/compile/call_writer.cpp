#include "compile/call_writer.h"

#include <algorithm>

#include "compile/pack.h"
#include "core/contract.h"
#include "core/error.h"

namespace shoal {

NumberLayout::Slice NumberLayout::put(const glm::dvec3& value, int count) {
    auto space = std::find_if(free_.begin(), free_.end(), [&](const Slice& s) { return s.count >= count; });
    if (space == free_.end()) {
        parameters.push_back(glm::vec4(0));
        space = free_.insert(free_.end(), {parameters.size() - 1, 0, 4});
    }
    const Slice out{space->slot, space->from, count};
    for (int i = 0; i < count; ++i)
        parameters[out.slot][out.from + i] = float(value[i]);
    space->from += count;
    space->count -= count;
    return out;
}

NumberLayout::Point NumberLayout::put(const glm::dvec3& point, std::optional<bool> far) {
    const SplitPoint split = far == false ? SplitPoint{glm::dvec3(0), point} : splitPoint(point);
    Point out{put(split.rest, 3), {}};
    if (far.value_or(split.isFar())) out.lattice = put(split.lattice, 3);
    return out;
}

// Components of an argument that is numbers; 0: it is something else.
static int widthOf(GlslCall::Kind kind) {
    using Kind = GlslCall::Kind;
    return kind == Kind::vector ? 3 : kind == Kind::pair ? 2 : kind == Kind::number ? 1 : 0;
}

std::vector<glm::vec4> parametersOf(const GlslCall& call, bool far) {
    NumberLayout layout;
    for (const GlslCall::Argument& one : call.arguments()) {
        if (one.kind == GlslCall::Kind::from)
            layout.put(one.value, std::optional(far));
        else if (const int width = widthOf(one.kind))
            layout.put(one.value, width);
        else
            EXPECTS(one.kind == GlslCall::Kind::text);
    }
    return std::move(layout.parameters);
}

std::string CallWriter::textOf(const Slice& slice) const {
    return concat(array_, "[", first_ + slice.slot, "].",
                  std::string("xyzw").substr(size_t(slice.from), size_t(slice.count)));
}

std::string CallWriter::slot(const glm::dvec3& v, double w) {
    parameters.push_back(glm::vec4(glm::vec3(v), float(w)));
    return concat(array_, "[", first_ + parameters.size() - 1, "]");
}

std::string CallWriter::fromPoint(const glm::dvec3& point, std::optional<bool> far) {
    const auto known =
        std::find_if(points_.begin(), points_.end(), [&](const auto& one) { return one.first == point; });
    if (known != points_.end()) return known->second;
    const Point at = put(point, far);
    const std::string from = at.lattice ? concat("(anchor - ", textOf(*at.lattice), ")") : "anchor";
    points_.emplace_back(point, concat("(", from, " - ", textOf(at.rest), ")"));
    return points_.back().second;
}

// Returns where they begin.
size_t CallWriter::addSamples(const GlslCall::Argument& argument) {
    EXPECTS(samples_);
    const size_t base = samples_->size();
    if (argument.samples) samples_->reserve(base + argument.samples->size());
    if (argument.samples)
        for (const glm::vec3& value : *argument.samples)
            samples_->emplace_back(value, 0.0f);
    for (const double number : argument.numbers)
        samples_->emplace_back(float(number), 0.0f, 0.0f, 0.0f);
    return base;
}

std::string CallWriter::argument(const GlslCall::Argument& one, std::optional<bool> far) {
    using Kind = GlslCall::Kind;
    switch (one.kind) {
    case Kind::from:
        return fromPoint(one.value, far) + " + position";
    case Kind::vector:
    case Kind::pair:
    case Kind::number:
        return textOf(put(one.value, widthOf(one.kind)));
    case Kind::text:
        return one.text;
    case Kind::clock: {
        clocks.push_back({one.clock, first_ + parameters.size()});
        const std::string c = slot({});
        if (one.clock.kind == FieldClock::Kind::angle) return c + ".x";
        if (one.clock.kind == FieldClock::Kind::frames) return concat(c, ".x, ", c, ".y + time");
        return concat(c, ".x, uint(", c, ".y) + 65536u * uint(", c, ".z)");
    }
    case Kind::samples:
    case Kind::numbers:
        return concat(addSamples(one));
    case Kind::call:
        return text(one.inner.front(), far);
    }
    return {};
}

std::string CallWriter::text(const GlslCall& call, std::optional<bool> far) {
    std::string out = call.function() + "(";
    bool first = true;
    for (const GlslCall::Argument& one : call.arguments()) {
        out += (first ? "" : ", ") + argument(one, far);
        first = false;
    }
    return out + ")";
}

std::string CallWriter::text(const GlslCalls& calls) {
    std::string sum;
    for (const GlslCall& call : calls)
        sum += (sum.empty() ? "" : " + ") + text(call);
    return calls.size() == 1 ? sum : "(" + sum + ")";
}

}  // namespace shoal
