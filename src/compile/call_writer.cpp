#include "compile/call_writer.h"

#include <algorithm>

#include "compile/pack.h"
#include "core/contract.h"
#include "core/error.h"

namespace shoal {

std::string CallWriter::component(size_t slot, int from, int count) const {
    return concat(array_, "[", first_ + slot, "].", std::string("xyzw").substr(size_t(from), size_t(count)));
}

std::string CallWriter::slot(const glm::dvec3& v, double w) {
    parameters.push_back(glm::vec4(glm::vec3(v), float(w)));
    return concat(array_, "[", first_ + parameters.size() - 1, "]");
}

// Takes the first room that is left for so many components, else a slot of their own.
std::string CallWriter::numbers(const glm::dvec3& value, int count) {
    auto space =
        std::find_if(free_.begin(), free_.end(), [&](const Space& s) { return s.next + count <= 4; });
    if (space == free_.end()) {
        parameters.push_back(glm::vec4(0));
        space = free_.insert(free_.end(), {parameters.size() - 1, 0});
    }
    for (int i = 0; i < count; ++i)
        parameters[space->slot][space->next + i] = float(value[i]);
    const std::string out = component(space->slot, space->next, count);
    space->next += count;
    return out;
}

std::string CallWriter::fromPoint(const glm::dvec3& point, std::optional<bool> far) {
    const auto known =
        std::find_if(points_.begin(), points_.end(), [&](const auto& one) { return one.first == point; });
    if (known != points_.end()) return known->second;
    SplitPoint split = far == false ? SplitPoint{glm::dvec3(0), point} : splitPoint(point);
    const std::string rest = numbers(split.rest, 3);
    const bool two = far.value_or(split.isFar());
    const std::string from = two ? concat("(anchor - ", numbers(split.lattice, 3), ")") : "anchor";
    points_.emplace_back(point, concat("(", from, " - ", rest, ")"));
    return points_.back().second;
}

std::string CallWriter::argument(const GlslCall::Argument& one, std::optional<bool> far) {
    using Kind = GlslCall::Argument::Kind;
    switch (one.kind) {
    case Kind::from:
        return fromPoint(one.value, far) + " + position";
    case Kind::vector:
        return numbers(one.value, 3);
    case Kind::pair:
        return numbers(one.value, 2);
    case Kind::number:
        return numbers(one.value, 1);
    case Kind::text:
        return one.text;
    case Kind::clock: {
        clocks.push_back({one.clock, first_ + parameters.size()});
        const std::string c = slot({});
        if (one.clock.kind == FieldClock::Kind::angle) return c + ".x";
        if (one.clock.kind == FieldClock::Kind::frames) return concat(c, ".x, ", c, ".y + time");
        return concat(c, ".x, uint(", c, ".y) + 65536u * uint(", c, ".z)");
    }
    case Kind::samples: {
        EXPECTS(samples_);
        const size_t base = samples_->size();
        samples_->reserve(base + one.samples->size());
        for (const glm::vec3& value : *one.samples)
            samples_->emplace_back(value, 0.0f);
        return concat(base);
    }
    case Kind::numbers: {
        EXPECTS(samples_);
        const size_t base = samples_->size();
        for (const double number : one.numbers)
            samples_->emplace_back(float(number), 0.0f, 0.0f, 0.0f);
        return concat(base);
    }
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
