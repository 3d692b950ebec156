#include "scene/force_kinds.h"

#include <algorithm>
#include <cmath>

#include "core/describe.h"
#include "scene/keyframes.h"

namespace shoal {

template class Boxed<ForceShape>;

// ---- The kinds

// Returns the radius (m) for a shader: without end it is one whose square a float holds.
static double reach(double radius) {
    return radius > 0 ? radius : 1e18;
}

const Description& describe(const AttractForce*) {
    using Falloff = AttractForce::Falloff;
    static const auto rule = [](const AttractForce& force, const Where& where) {
        const bool square = force.falloff == Falloff::inverseSquare;
        const char* key = square ? "most" : "radius";
        where.require(key);
        if (!square && where.given("most"))
            throw Error(where.locate("most"),
                        "\"most\" bounds an inverse square: a constant falloff has none");
        needWithin(where.locate(key), square ? force.most : force.radius, aboveZero());
    };
    static const Description description =
        Describe<AttractForce>(
            "attract",
            "Pulls towards a point, or away from it where the strength is negative; at most by `most`.")
            .key("position", &AttractForce::position, {"m", "The point."})
            .word("falloff", &AttractForce::falloff, {"inverseSquare", "constant"},
                  {"", "How the pull depends on the distance d: strength / d², or the same everywhere."})
            .key("strength", &AttractForce::strength, {"m³/s² or m/s²", "The pull; a negative one pushes."})
            .needed()
            .key("most", &AttractForce::most,
                 {"m/s²", "The bound of an inverse square near the point; required of it.", aboveZero()})
            .unlessZero()
            .key("radius", &AttractForce::radius,
                 {"m", "There is no force beyond this distance; without it there is no end.", aboveZero()})
            .unlessZero()
            .rule(rule, R"({"if": {"properties": {"falloff": {"const": "constant"}}, "required": ["falloff"]},
                            "then": {"required": ["radius"], "not": {"required": ["most"]}},
                            "else": {"required": ["most"]}})");
    return description;
}

AttractForce AttractForce::times(double factor) const {
    AttractForce out = *this;
    out.strength *= factor;  // and not its bound
    return out;
}

double AttractForce::fastestRate() const {
    // the steepest place: the radius, or where the bound is reached
    const bool constant = falloff == Falloff::constant;
    const double size = std::abs(strength), pull = constant ? size : most;
    const double near = constant ? radius : std::sqrt(size / most);
    return near > 0 ? std::sqrt(2 * pull / near) : 0;
}

GlslCall AttractForce::call() const {
    if (falloff == Falloff::constant)
        return GlslCall("constantPull").from(position).number(strength).number(reach(radius));
    return GlslCall("inverseSquarePull").from(position).number(strength).number(reach(radius)).number(most);
}

const Description& describe(const VortexLineForce*) {
    static const Description description =
        Describe<VortexLineForce>(
            "vortexLine",
            "Pulls towards a line and around it [Latta 2004]. Both grow as d / core up to the core, "
            "and fall as core / d beyond it.")
            .key("position", &VortexLineForce::position, {"m", "A point of the line."})
            .direction("axis", &VortexLineForce::axis, {"", "The direction of the line."})
            .key("pull", &VortexLineForce::pull, {"m/s²", "The acceleration towards the line at the core."})
            .key("turn", &VortexLineForce::turn,
                 {"m/s²", "The acceleration around it at the core, by the right-hand rule."})
            .key("core", &VortexLineForce::core,
                 {"m", "The force grows with the distance up to here, and falls off beyond.", aboveZero()})
            .key("radius", &VortexLineForce::radius,
                 {"m", "There is no force beyond this distance; without it there is no end.", aboveZero()})
            .unlessZero();
    return description;
}

VortexLineForce VortexLineForce::times(double factor) const {
    VortexLineForce out = *this;
    out.pull *= factor;
    out.turn *= factor;
    return out;
}

double VortexLineForce::fastestRate() const {
    return std::sqrt(std::max(std::abs(pull), std::abs(turn)) / core);
}

GlslCall VortexLineForce::call() const {
    return GlslCall("vortexLinePull")
        .from(position)
        .vector(glm::normalize(axis))
        .number(pull)
        .number(turn)
        .number(core)
        .number(reach(radius));
}

const Description& describe(const ThrustForce*) {
    static const auto rule = [](const ThrustForce& force, const Where& where) {
        if (force.rate > 0) where.require("limit");
    };
    static const Description description =
        Describe<ThrustForce>(
            "thrust",
            "Speeds up what moves, as if it propelled itself [Latta 2004]. It is rate · v while the speed is "
            "below the limit, which "
            "it does not pass. A rate below 0 damps at any speed. What is at rest stays so.")
            .key("rate", &ThrustForce::rate,
                 {"1/s", "The rate of growth of the speed; a negative one damps."})
            .needed()
            .key("limit", &ThrustForce::limit,
                 {"m/s", "The speed that a growing one does not pass; required where the rate is above 0.",
                  aboveZero()})
            .rule(
                rule,
                R"({"if": {"properties": {"rate": {"exclusiveMinimum": 0}}}, "then": {"required": ["limit"]}})");
    return description;
}

const Description& describe(const WindForce*) {
    static const Description description =
        Describe<WindForce>(
            "wind",
            "Adds to the fluid's velocity: it moves what has drag, like a uniform field, but some groups "
            "only, and on a path.")
            .key("velocity", &WindForce::velocity, {"m/s", "The velocity that it adds."})
            .needed();
    return description;
}

// ---- How forces move, and whom they act on

const Description& describe(const ForcePath::Keyframe*) {
    using Keyframe = ForcePath::Keyframe;
    static const Description description =
        Describe<Keyframe>("keyframe", "A moment of a force's path.")
            .key("time", &Keyframe::time, {"s", "The time, after that of the keyframe before."})
            .needed()
            .key("offset", &Keyframe::offset, {"m", "What is added to the position."})
            .key("factor", &Keyframe::factor,
                 {"",
                  "What multiplies the strength: the acceleration, the rate or the velocity, but no bound."});
    return description;
}

const Description& describe(const ForcePath*) {
    static const auto rule = [](const ForcePath& path, const Where& where) {
        checkKeyframes(path.keyframes, where);
    };
    static const Description description =
        Describe<ForcePath>("path",
                            "How a force moves and changes: in a straight line from keyframe to keyframe.")
            .key("repeats", &ForcePath::repeats, {"", "Whether it starts over after the last keyframe."})
            .key("keyframes", &ForcePath::keyframes, {"", "At least two moments, in order."})
            .needed()
            .rule(rule, R"({"properties": {"keyframes": {"minItems": 2}}})");
    return description;
}

const Description& describe(const Force*) {
    static const auto rule = [](const Force& force, const Where& where) {
        if (placeOf(*force.shape)) return;
        if (force.mouse)
            throw Error(where.locate("mouse"),
                        "thrust and wind act alike everywhere: they cannot follow the mouse");
        for (size_t i = 0; force.path && i < force.path->keyframes.size(); ++i) {
            const Where path = where.in("path"), frame = path.in("keyframes", i);
            if (frame.given("offset") || force.path->keyframes[i].offset != glm::dvec3(0))
                throw Error(frame.locate("offset"),
                            "thrust and wind act alike everywhere: they have no place to move");
        }
    };
    static const Description description =
        Describe<Force>("force",
                        "Accelerates molecules, beside the fields, gravity and springs. Forces add up.")
            .location(&Force::location)
            .key("name", &Force::name, {"", "Its name in messages and in the panel; no two have the same."})
            .alternatives("type", &Force::shape, {"", "What it does."})
            .key("groups", &Force::groups, {"", "The names of the groups that it acts on; all without it."})
            .key("path", &Force::path, {"", "How it moves and changes."})
            .key("mouse", &Force::mouse,
                 {"",
                  "Whether it acts in the window only, while Shift and the left button are held, where the "
                  "pointer's ray meets the plane through the camera's target that faces the camera."})
            .rule(rule, R"({"if": {"properties": {"type": {"enum": ["thrust", "wind"]}}},
                            "then": {"not": {"required": ["mouse"]},
                                     "properties": {"path": {"properties": {"keyframes": {
                                       "items": {"not": {"required": ["offset"]}}}}}}}})");
    return description;
}

std::optional<glm::dvec3> placeOf(const ForceShape& shape) {
    return std::visit(
        [](const auto& kind) -> std::optional<glm::dvec3> {
            if constexpr (requires { kind.position; }) return kind.position;
            return {};
        },
        shape);
}

ForceMoment momentOf(const std::optional<ForcePath>& path, double time) {
    if (!path) return {};
    const auto [a, b, share] = between(path->keyframes, path->repeats, time);
    return {glm::mix(a.offset, b.offset, share), glm::mix(a.factor, b.factor, share)};
}

double fastestRate(const Force& force) {
    double factor = 1;
    if (force.path)
        for (const ForcePath::Keyframe& frame : force.path->keyframes)
            factor = std::max(factor, std::abs(frame.factor));
    return std::visit([&](const auto& kind) { return kind.times(factor).fastestRate(); }, *force.shape);
}

bool actsOn(const Force& force, const std::string& group) {
    return force.groups.empty() ||
           std::find(force.groups.begin(), force.groups.end(), group) != force.groups.end();
}

const char* kindName(const ForceShape& shape) {
    return std::visit([](const auto& kind) { return describe(&kind).name().c_str(); }, shape);
}

}  // namespace shoal
