// The scene's forces before any GPU: the reader and what it refuses, paths, the numbers of a frame, which
// group pays for what, and the shader's formulas, compiled as C++, against the double reference.
#include <algorithm>
#include <cmath>

#include "compile/path.h"
#include "core/json.h"
#include "reference/forces.h"
#include "scene/force_kinds.h"
#include "scene/json/scene_file.h"
#include "simulate/fused_kernel.h"
#include "simulate/watchdog.h"
#include "support/catch.h"
#include "support/every_kind.h"
#include "support/message_of.h"
#include "support/scratch.h"
#include "support/shader_physics.h"
#include "support/shapes.h"

using namespace shoal;
using Catch::Contains;
using glm::dvec3;
using glm::vec3;

namespace {

constexpr const char* dot = R"({"format": "shoal-molecule-1", "name": "dot",
  "vertices": [{"position": [0, 0, 0], "mass": 1}]})";

// A scene of two groups, "a" with drag and "b" without, and the forces given.
class Scenes {
  public:
    Scenes() { scratch_.write("dot.json", dot); }

    Scene read(const std::string& forces) const {
        const std::string text = R"({"format": "shoal-scene-1", "gravity": [0, -1, 0], "groups": [
          {"name": "a", "molecule": "dot.json", "place": {"on": "list", "items": [{}]}, "drag": 2},
          {"name": "b", "molecule": "dot.json", "place": {"on": "list", "items": [{}]}}],
          "forces": [)" + forces +
                                 "]}";
        return parseScene(text, scratch_.path("s.json"));
    }
    std::string refusal(const std::string& forces) const {
        return messageOf([&] { read(forces); });
    }

  private:
    test::Scratch scratch_;
};

Frame frameOf(const Plan& plan, double time) {
    Frame out;
    out.parameters = parametersOf(plan);
    out.time = time;
    out.h = out.parameters.frameTime / out.parameters.substeps;
    return out;
}

vec3 pointAt(int i) {
    return {float(std::fmod(i * 7.31, 6.0)) - 3, float(std::fmod(i * 3.77, 6.0)) - 3,
            float(std::fmod(i * 5.23, 6.0)) - 3};
}

dvec3 referenceAcceleration(const ForceShape& shape, const dvec3& x) {
    Force force;
    force.shape = shape;
    return reference::forceAcceleration({force}, x, 0);
}

template <typename Shader>
double worst(const ForceShape& shape, Shader shader) {
    double most = 0;
    for (int i = 0; i < 2000; ++i) {
        const vec3 x = pointAt(i) * (i % 7 == 0 ? 0.01f : 1.0f);
        most = std::max(most, glm::length(dvec3(shader(x)) - referenceAcceleration(shape, dvec3(x))));
    }
    return most;
}

}  // namespace

TEST_CASE("a scene's forces", "[forces][scene]") {
    const Scene scene = Scenes().read(R"(
      {"type": "attract", "name": "hive", "position": [1, 2, 3], "strength": 4, "most": 20, "groups": ["b"],
       "mouse": true, "path": {"repeats": true, "keyframes": [{"time": 1}, {"time": 2, "offset": [2, 0, 0], "factor": 3}]}},
      {"type": "attract", "falloff": "constant", "strength": -2, "radius": 5},
      {"type": "vortexLine", "axis": [0, 0, 2], "pull": 3, "turn": -4, "core": 0.25, "radius": 6},
      {"type": "thrust", "rate": 2, "limit": 3}, {"type": "thrust", "rate": -0.5},
      {"type": "wind", "velocity": [1, 0, 0]})");
    REQUIRE(scene.forces.size() == 6);
    const Force& hive = scene.forces[0];
    CHECK(hive.name == "hive");
    CHECK(hive.groups == std::vector<std::string>{"b"});
    CHECK(hive.mouse);
    REQUIRE(hive.path);
    CHECK(hive.path->repeats);
    CHECK(hive.path->keyframes[1].offset == dvec3(2, 0, 0));
    const auto& attract = std::get<AttractForce>(*hive.shape);
    CHECK(attract.position == dvec3(1, 2, 3));
    CHECK(attract.strength == 4);
    CHECK(attract.most == 20);
    CHECK(attract.radius == 0);
    CHECK(std::get<AttractForce>(*scene.forces[1].shape).falloff == AttractForce::Falloff::constant);
    const auto& line = std::get<VortexLineForce>(*scene.forces[2].shape);
    CHECK(line.axis == dvec3(0, 0, 1));
    CHECK(line.turn == -4);
    CHECK(line.core == 0.25);
    CHECK(std::get<ThrustForce>(*scene.forces[3].shape).limit == 3);
    CHECK(std::get<ThrustForce>(*scene.forces[4].shape).rate == -0.5);
    CHECK(std::get<WindForce>(*scene.forces[5].shape).velocity == dvec3(1, 0, 0));
}

TEST_CASE("every kind of force is there, and as its closed form says", "[forces]") {
    std::vector<bool> there(std::variant_size_v<ForceShape::variant>);
    for (const test::KindOfForce& kind : test::kindsOfForce()) {
        there[kind.shape.index()] = true;
        INFO(kindName(kind.shape));
        CHECK(kind.known.has_value() == placeOf(kind.shape).has_value());
        if (!kind.known) continue;
        const auto& [x, value] = *kind.known;
        CHECK(glm::length(referenceAcceleration(kind.shape, x) - value) < 1e-12);

        const ForceShape scaled =
            std::visit([](const auto& one) { return ForceShape(one.times(-2)); }, kind.shape);
        CHECK(glm::length(referenceAcceleration(scaled, x) + 2.0 * value) < 1e-12);

        Force force;
        force.shape = kind.shape;
        CHECK(glm::length(referenceAcceleration(*test::readBack(force).shape, x) - value) < 1e-12);

        const double bound = fastestRate(force) * fastestRate(force);  // 1/s^2, of the gradient anywhere
        for (int axis = 0; axis < 3; ++axis) {
            dvec3 step(0);
            step[axis] = 1e-5;
            const dvec3 change =
                referenceAcceleration(kind.shape, x + step) - referenceAcceleration(kind.shape, x - step);
            CHECK(glm::length(change) / 2e-5 <= bound + 1e-5);
        }
    }
    CHECK(std::find(there.begin(), there.end(), false) == there.end());
}

TEST_CASE("bad input: forces", "[forces][badInput]") {
    const Scenes scenes;
    const auto refuses = [&](const std::string& force, const std::string& words) {
        const std::string message = scenes.refusal(force);
        INFO(force);
        CHECK_THAT(message, Contains("s.json:") && Contains(words));
        CHECK_THAT(message, Contains("$.forces[0]"));
    };
    refuses(R"({"type": "atract", "strength": 1})", "attract");
    refuses(R"({"strength": 1})", "type");
    refuses(R"({"type": "attract", "most": 1})", "strength");
    refuses(R"({"type": "attract", "strength": 1})", "most");
    refuses(R"({"type": "attract", "strength": 1, "most": 0})", "$.forces[0].most");
    refuses(R"({"type": "attract", "strength": 1, "most": 1, "radius": -1})", "$.forces[0].radius");
    refuses(R"({"type": "attract", "strength": 1e300, "most": 1})", "1e+15");
    refuses(R"({"type": "attract", "falloff": "constant", "strength": 1})", "radius");
    refuses(R"({"type": "attract", "falloff": "constant", "strength": 1, "radius": 1, "most": 2})",
            "constant falloff");
    refuses(R"({"type": "vortexLine", "axis": [0, 0, 0]})", "direction");
    refuses(R"({"type": "vortexLine", "core": 0})", "$.forces[0].core");
    refuses(R"({"type": "thrust", "rate": 1, "limit": 0})", "$.forces[0].limit");
    refuses(R"({"type": "thrust", "rate": 1})", "limit");
    refuses(R"({"type": "thrust", "rate": "fast", "limit": 1})", "a number");
    refuses(R"({"type": "wind"})", "velocity");
    refuses(R"({"type": "wind", "velocity": [1, 0, 0], "mouse": true})", "mouse");
    refuses(R"({"type": "wind", "velocity": [1, 0, 0], "groups": ["c"]})", "no group is named \"c\"");
    refuses(R"({"type": "wind", "velocity": [1, 0, 0], "groups": []})", "at least one group");
    refuses(R"({"type": "wind", "velocity": [1, 0, 0], "weight": 2})", "weight");
    const auto path = [](const std::string& keyframes) {
        return R"({"type": "wind", "velocity": [1, 0, 0], "path": {"keyframes": [)" + keyframes + "]}}";
    };
    refuses(path(R"({"time": 0})"), "at least two keyframes");
    refuses(path(R"({"time": 2}, {"time": 1})"), "after that of the keyframe before");
    refuses(path(R"({"time": 1}, {"time": 1})"), "after that of the keyframe before");
    refuses(path(R"({"time": 0}, {"factor": 1})"), "time");
    refuses(path(R"({"time": 0}, {"time": 1, "offset": [1, 0, 0]})"), "no place to move");
    CHECK_THAT(scenes.refusal(R"({"type": "wind", "name": "w", "velocity": [1, 0, 0]},
                                 {"type": "wind", "name": "w", "velocity": [1, 0, 0]})"),
               Contains("already taken") && Contains("$.forces[1].name"));
}

TEST_CASE("a force's path: straight between keyframes, held or started over", "[forces]") {
    ForcePath path{.keyframes = {{1, {0, 0, 0}, 2}, {2, {4, 0, 0}, 0}, {4, {0, 0, 2}, 1}}, .repeats = false};
    CHECK(momentOf(path, -5).factor == 2);
    CHECK(momentOf(path, 1.25).offset == dvec3(1, 0, 0));
    CHECK(momentOf(path, 1.25).factor == 1.5);
    CHECK(momentOf(path, 2).offset == dvec3(4, 0, 0));
    CHECK(momentOf(path, 3).offset == dvec3(2, 0, 1));
    CHECK(momentOf(path, 100).offset == dvec3(0, 0, 2));
    path.repeats = true;
    CHECK(momentOf(path, 0.5).factor == 2);  // before the first it still holds
    CHECK(momentOf(path, 4.25).offset == dvec3(1, 0, 0));
    CHECK(momentOf(path, 1.25 + 3 * 40).factor == Approx(1.5));
    CHECK(momentOf({}, 7).factor == 1);
}

TEST_CASE("the shader's forces agree with the reference", "[forces][physics]") {
    // at most 20 m/s^2, and a few roundings
    const AttractForce star{.position = {}, .strength = 3, .radius = 2.5, .most = 20};
    CHECK(worst(star, [](vec3 x) { return shader::inverseSquarePull(x, 3, 2.5f, 20); }) < 1e-5);
    const AttractForce away{.position = {}, .strength = -3, .radius = 0, .most = 20};
    CHECK(worst(away, [](vec3 x) { return shader::inverseSquarePull(x, -3, 1e18f, 20); }) < 1e-5);
    AttractForce even{.position = {}, .strength = 7, .radius = 2.5};
    even.falloff = AttractForce::Falloff::constant;
    CHECK(worst(even, [](vec3 x) { return shader::constantPull(x, 7, 2.5f); }) < 4e-6);
    VortexLineForce line{.position = {}, .axis = glm::normalize(dvec3(1, 2, -1)), .pull = 2, .turn = 5};
    line.core = 0.75, line.radius = 3;
    CHECK(worst(line, [&](vec3 x) { return shader::vortexLinePull(x, vec3(line.axis), 2, 5, 0.75f, 3); }) <
          1e-5);
}

TEST_CASE("no force is singular where it sits", "[forces][physics]") {
    for (const float tiny : {0.0f, 1e-25f, 1e-16f}) {
        const vec3 x(tiny, 0, 0);
        const vec3 sum = shader::inverseSquarePull(x, 1e15f, 1e18f, 1e15f) + shader::constantPull(x, 5, 1) +
                         shader::vortexLinePull(x, {0, 1, 0}, 1, 1, 0.5f, 1e18f);
        INFO(tiny);
        CHECK(std::isfinite(sum.x + sum.y + sum.z));
        CHECK(shader::thrustFactor(x, 2e17f, 2) * tiny <= 2.001f);
        CHECK(std::isfinite(shader::thrustFactor(x, 2e17f, 2)));
    }
    CHECK(shader::constantPull(vec3(0), 5, 1) == vec3(0));
}

TEST_CASE("thrust grows up to its limit and leaves what is beyond", "[forces][physics]") {
    CHECK(shader::thrustFactor({0, 1, 0}, 1.5f, 2) == 1.5f);
    CHECK(shader::thrustFactor({0, 1, 0}, 3, 2) == 2);
    CHECK(shader::thrustFactor({0, 2, 0}, 3, 2) == 1);
    CHECK(shader::thrustFactor({0, 5, 0}, 3, 2) == 1);
    CHECK(shader::thrustFactor({0, 5, 0}, 0.25f, 2) == 0.25f);
    std::vector<Force> forces(1);
    forces[0].shape = ThrustForce{2, 3};
    CHECK(reference::thrusted(forces, {1, 0, 0}, 0, 0.25).x == Approx(std::exp(0.5)));
    CHECK(reference::thrusted(forces, {1, 0, 0}, 0, 10).x == 3);
    CHECK(reference::thrustAcceleration(forces, {1, 0, 0}, 0).x == 2);
    CHECK(reference::thrustAcceleration(forces, {3, 0, 0}, 0).x == 0);
}

TEST_CASE("a group pays for the forces that act on it", "[forces][kernel]") {
    const Scene scene = Scenes().read(R"(
      {"type": "attract", "strength": 4, "most": 20, "groups": ["b"]},
      {"type": "thrust", "rate": 2, "limit": 3, "groups": ["b"]},
      {"type": "wind", "velocity": [1, 0, 0]})");
    const Plan plan = compile(scene);
    const Needs &a = plan.groups[0].needs, &b = plan.groups[1].needs;
    CHECK_FALSE(a.forces);
    CHECK_FALSE(a.thrust);
    CHECK(a.wind);
    CHECK(b.forces);
    CHECK(b.thrust);
    CHECK_FALSE(b.wind);  // it has no drag
    CHECK(plan.groups[0].forces.parameterCount == 1);
    CHECK_THAT(plan.groups[1].forces.source, Contains("withWind(vec3 velocity)\n{\n    return velocity;\n}"));

    // what none acts on has the text of a scene without, but for its comment
    const std::string root = SHOAL_SOURCE_DIR "/shaders";
    Scene none = scene, far = scene;
    none.forces.clear();
    for (Force& force : far.forces)
        force.groups = {"b"};
    CHECK(kernelShader(root, compile(none), 0, {}) == kernelShader(root, compile(far), 0, {}));
    CHECK_THAT(kernelShader(root, compile(none), 0, {}), !Contains("force.glsl") && !Contains("pull["));

    // numbers are not in the text
    Scene moved = scene;
    std::get<AttractForce>(*moved.forces[0].shape) = {
        .position = {7, 8, 9}, .strength = -3, .radius = 1, .most = 5};
    std::get<ThrustForce>(*moved.forces[1].shape) = {-5, 11};
    CHECK(compile(moved).groups[1].forces.source == plan.groups[1].forces.source);
}

TEST_CASE("explain names the forces on each group", "[forces][plan]") {
    const Plan plan = compile(Scenes().read(R"(
      {"type": "attract", "name": "hive", "strength": 4, "most": 20, "groups": ["b"]},
      {"type": "thrust", "rate": 2, "limit": 3}, {"type": "wind", "velocity": [1, 0, 0]})"));
    const PathChoice fused{Path::fused, "of the test"}, pingPong{Path::pingPong, "of the test"};
    CHECK_THAT(explain(plan, fused, false),
               Contains("attract \"hive\", thrust\n") && Contains("thrust, wind\n"));
    CHECK_THAT(explain(plan, pingPong, false), Contains("the other half of the thrust"));
    CHECK(explainJson(plan, fused, false).find("groups")->items[1].find("forces")->items.size() == 2);
}

TEST_CASE("a force that turns too fast for the substep is told, and counts in the choice of the solver",
          "[forces][plan]") {
    const Scenes scenes;
    // 1000 rad/s at 60 frames of 4 substeps a second: frequency times substep 4.17
    const Scene fast = scenes.read(
        R"({"type": "vortexLine", "name": "drain", "pull": 1e5, "turn": 0, "core": 0.1, "groups": ["a"]})");
    CHECK(fastestRate(fast.forces[0]) == Approx(1000));
    const Plan plan = compile(fast);
    REQUIRE(plan.warnings.size() == 1);
    CHECK(plan.warnings[0].location.path == "$.forces[0]");
    CHECK_THAT(plan.warnings[0].message,
               Contains("the force \"drain\" (vortexLine) turns \"a\" by up to 1000 rad/s") &&
                   Contains("leapfrog is stable up to a frequency times substep of 2, here it is 4.16667") &&
                   Contains("use at least 9 substeps"));
    CHECK_THAT(Runaway(plan, Alarm{.group = 0, .speed = 2e4}).what(), Contains("the force \"drain\""));
    CHECK_THAT(Runaway(plan, Alarm{.group = 1, .speed = 2e4}).what(),
               !Contains("drain") && Contains("force"));

    Scene resolved = fast;
    resolved.solver.substeps = 9;
    CHECK(compile(resolved).warnings.empty());

    // Springs that leapfrog just resolves alone, and no longer beside a force: the springs go to an implicit
    // solver.
    Scene both = scenes.read(R"({"type": "vortexLine", "pull": 2e4, "turn": 0, "core": 1})");
    Molecule& pair = both.groups[0].molecule;
    pair.vertices.push_back(pair.vertices[0]);
    pair.vertices[1].position = {0.1, 0, 0};
    Spring& spring = pair.springs.emplace_back();
    spring.b = 1;
    spring.stiffness = 0.5 * 460 * 460;
    CHECK(compile(both).groups[0].solver == SolverKind::bdf2Xpbd);
    both.forces.clear();
    CHECK(compile(both).groups[0].solver == SolverKind::leapfrog);
}

TEST_CASE("more forces than uniforms is one located error", "[forces][badInput]") {
    std::string many;
    for (int i = 0; i < 17; ++i)
        many += std::string(i > 0 ? "," : "") + R"({"type": "attract", "strength": 1, "most": 1})";
    const Scene scene = Scenes().read(many);
    CHECK_THAT(messageOf([&] { compile(scene); }), Contains("s.json:") && Contains("34 4-vectors"));
}

TEST_CASE("the numbers of a frame: the path's middle, what is moved by hand, what is off", "[forces]") {
    const Scene scene = Scenes().read(R"(
      {"type": "attract", "position": [1, 0, 0], "strength": 4, "most": 20,
       "path": {"keyframes": [{"time": 0}, {"time": 2, "offset": [4, 0, 0], "factor": 3}]}},
      {"type": "attract", "strength": 5, "most": 20, "mouse": true},
      {"type": "thrust", "rate": 2, "limit": 3},
      {"type": "wind", "velocity": [1, 0, 0]}, {"type": "wind", "velocity": [0, 2, 0]})");
    const Plan plan = compile(scene);
    Frame frame = frameOf(plan, 1 - 0.5 / plan.frameRate);  // whose middle is at 1 s
    std::vector<glm::vec4> now = forceParameters(plan, plan.groups[0], frame);
    REQUIRE(now.size() == 7);  // the mouse may hold it anywhere: its place is in two parts
    CHECK(glm::length(now[0] - glm::vec4(3, 0, 0, 8)) < 1e-5);
    CHECK(now[1].y == 20);
    CHECK(now[2].w == 0);  // the mouse's, untouched
    CHECK(now[5].x == Approx(std::exp(2 * frame.h)));
    CHECK(now[5].y == Approx(std::exp(frame.h)));
    CHECK(now[5].z == 3);
    CHECK(now[5].w == Approx(2));
    CHECK(now[6] == glm::vec4(1, 2, 0, 0));

    frame.parameters.forces[0].factor = 0.5;
    frame.parameters.forces[1] = {.on = true, .factor = 1, .position = dvec3(7, 8, 9)};
    frame.parameters.forces[2].on = false;
    frame.parameters.forces[3].factor = 3;
    now = forceParameters(plan, plan.groups[0], frame);
    CHECK(now[0].w == Approx(4));
    CHECK(now[2] == glm::vec4(7, 8, 9, 5));
    CHECK(now[5].x == 1);
    CHECK(now[6] == glm::vec4(3, 2, 0, 0));
}
