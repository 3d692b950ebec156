#include "compile/call_writer.h"

#include <algorithm>

#include "compile/pack.h"
#include "core/contract.h"
#include "core/error.h"

namespace shoal {

NumberLayout::Slice NumberLayout::put(const glm::dvec4& value, int count) {
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
    Point out{put({split.rest, 0}, 3), {}};
    if (far.value_or(split.isFar())) out.lattice = put({split.lattice, 0}, 3);
    return out;
}

std::vector<glm::vec4> parametersOf(const GlslCall& call, bool far) {
    NumberLayout layout;
    for (const GlslCall::Argument& argument : call.arguments()) {
        if (argument.kind == GlslCall::Kind::from)
            layout.put(glm::dvec3(argument.value), std::optional(far));
        else if (argument.count > 0)
            layout.put(argument.value, argument.count);
        else
            EXPECTS(argument.kind == GlslCall::Kind::text);
    }
    return std::move(layout.parameters);
}

std::string CallWriter::parameter(size_t slot) const {
    return std::string(name_).replace(name_.find('#'), 1, concat(first_ + slot));
}

std::string CallWriter::textOf(const Slice& slice) const {
    const std::string whole = parameter(slice.slot);
    return slice.count == 4
               ? whole
               : concat(whole, ".", std::string("xyzw").substr(size_t(slice.from), size_t(slice.count)));
}

std::string CallWriter::slot(const glm::dvec3& v, double w) {
    parameters.push_back(glm::vec4(glm::vec3(v), float(w)));
    return parameter(parameters.size() - 1);
}

std::string CallWriter::fromPoint(const glm::dvec3& point, std::optional<bool> far) {
    const auto known =
        std::find_if(points_.begin(), points_.end(), [&](const auto& entry) { return entry.first == point; });
    if (known != points_.end()) return known->second;
    const Point split = put(point - frame_.origin, far);
    const std::string from =
        split.lattice ? concat("(", frame_.anchor, " - ", textOf(*split.lattice), ")") : frame_.anchor;
    points_.emplace_back(point, concat(from, " - ", textOf(split.rest)));
    return points_.back().second;
}

std::string CallWriter::argument(const GlslCall::Argument& given, std::optional<bool> far) {
    using Kind = GlslCall::Kind;
    switch (given.kind) {
    case Kind::from:
        return concat("(", fromPoint(glm::dvec3(given.value), far), ") + ", frame_.position);
    case Kind::apart:
        return concat(fromPoint(glm::dvec3(given.value), far), ", ", frame_.position);
    case Kind::numbers:
        return textOf(put(given.value, given.count));
    case Kind::axis: {
        const size_t slot = put(given.value, given.count).slot;
        return concat(textOf({slot, 0, 3}), ", ", textOf({slot, 3, 1}));
    }
    case Kind::cell:
        return cell = textOf(put(given.value, given.count));
    case Kind::text:
        return given.text;
    case Kind::clock: {
        clocks.push_back({given.clock, first_ + parameters.size()});
        const std::string c = slot({});
        if (given.clock.kind == FieldClock::Kind::angle) return c + ".x";
        if (given.clock.kind == FieldClock::Kind::frames) return concat(c, ".x, ", c, ".y + time");
        return concat(c, ".x, uint(", c, ".y) + 65536u * uint(", c, ".z)");
    }
    case Kind::samples: {
        EXPECTS(samples_);
        const size_t base = samples_->size();
        given.append(*samples_);
        return concat(base);
    }
    case Kind::tile:
        if (std::find(tiles.begin(), tiles.end(), given.tile) == tiles.end()) tiles.push_back(given.tile);
        return given.tile.sampler();
    case Kind::call:
        return text(given.inner.front(), far);
    }
    return {};
}

std::string CallWriter::text(const GlslCall& call, std::optional<bool> far) {
    std::vector<std::string> arguments;
    for (const GlslCall::Argument& given : call.arguments())
        arguments.push_back(argument(given, far));
    std::string turn;
    if (const std::optional<glm::dquat>& q = call.rotation()) {
        turn = slot({q->x, q->y, q->z}, q->w);
        arguments.front() = concat("turnedBack(", turn, ", ", arguments.front(), ")");
    }
    std::string out = call.function() + "(";
    for (size_t i = 0; i < arguments.size(); ++i)
        out += (i == 0 ? "" : ", ") + arguments[i];
    out += ")";
    return turn.empty() ? out : concat("turnedSurface(", turn, ", ", out, ")");
}

std::string CallWriter::text(const GlslCalls& calls) {
    std::string sum;
    for (const GlslCall& call : calls)
        sum += (sum.empty() ? "" : " + ") + text(call);
    return calls.size() == 1 ? sum : "(" + sum + ")";
}

}  // namespace shoal
