// The baseline does what the euler passes do: the double-precision recurrence in the air, the shaders' own
// text on the ground, and the same in every instruction set.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/baseline.h"
#include "molecule/molecule_file.h"
#include "reference/discrete.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/shader_physics.h"
#include "support/shapes.h"

namespace shoal::bench {

using glm::dvec3;
using glm::vec3;

namespace {

constexpr double gamma = 0.7;  // 1/s

BaselineStep stepOf(float h) {
    BaselineStep out;
    out.h = h;
    out.gravity = {0, -9.81f, 0};
    out.wind = {2, 0, 0.5f};
    out.decay = float(-std::expm1(-gamma * double(h)));
    out.phi = float(-std::expm1(-gamma * double(h)) / gamma);
    out.stiffness = 0.8f;
    out.damping = 1.3f;
    return out;
}

Molecule shipped(const char* name) {
    return readMolecule(std::string(SHOAL_SOURCE_DIR "/molecules/") + name + ".json");
}

// Without pins, and with masses and springs that differ from each other.
Molecule uneven() {
    Molecule out = test::leaf(30, 0.2);
    for (size_t i = 0; i < out.vertices.size(); ++i)
        out.vertices[i].mass = 0.3 + 0.1 * double(i);
    for (size_t i = 0; i < out.springs.size(); ++i)
        out.springs[i].stiffness += 3 * double(i);
    out.springs[2].restLength = 0.9;
    return out;
}

struct States {
    std::vector<vec3> positions, velocities;
};

// `count` molecules turned differently, around `origin`, their lowest point between 0 and `spread` above it,
// with a spin that makes the springs work.
States start(const Molecule& molecule, int count, const vec3& origin, double spread) {
    States out;
    for (int m = 0; m < count; ++m) {
        const double t = m + 1;
        const glm::dquat turn =
            glm::angleAxis(std::fmod(1.7 * t, 2 * std::numbers::pi), glm::normalize(dvec3(1, t / 8, -2)));
        double low = 0;
        for (const Vertex& vertex : molecule.vertices)
            low = std::min(low, (turn * vertex.position).y);
        const dvec3 place(std::fmod(0.37 * t, 1.0) - 0.5, std::fmod(0.61 * t, 1.0) * spread - low + 0.01,
                          0.1);
        for (const Vertex& vertex : molecule.vertices) {
            const dvec3 arm = turn * vertex.position;
            out.positions.push_back(origin + vec3(place + arm));
            out.velocities.push_back(vec3(dvec3(0.3, 0, -0.2) + glm::cross(dvec3(1, -0.7, 0.4), arm)));
        }
    }
    return out;
}

States run(const Molecule& molecule, Simd simd, const States& from, const BaselineStep& step, int frames,
           int threads = 2) {
    Baseline baseline(molecule, int(from.positions.size() / molecule.vertices.size()), simd, threads);
    baseline.set(from.positions, from.velocities);
    for (int i = 0; i < frames; ++i)
        baseline.frame(step);
    States out;
    baseline.get(out.positions, out.velocities);
    return out;
}

// Per molecule the largest distance between vertices, in its sizes; sorted.
std::vector<double> distances(const States& a, const States& b, const Molecule& molecule) {
    REQUIRE(a.positions.size() == b.positions.size());
    const size_t vertices = molecule.vertices.size();
    std::vector<double> out(a.positions.size() / vertices);
    for (size_t i = 0; i < a.positions.size(); ++i) {
        double& most = out[i / vertices];
        most = std::max(most, glm::length(dvec3(a.positions[i]) - dvec3(b.positions[i])) / molecule.size());
    }
    std::sort(out.begin(), out.end());
    return out;
}

// Landing amplifies roundings in some molecules: changing the last bit of the start parts one cross of a
// hundred from itself by 1e-4 to 1e-3 of its size within a second. The others must agree to float's rounding.
void checkLandedAlike(const States& a, const States& b, const Molecule& molecule) {
    const std::vector<double> sorted = distances(a, b, molecule);
    CHECK(sorted[sorted.size() * 95 / 100] < 1e-5);
    CHECK(sorted.back() < 1e-2);
}

// The passes' order with the shaders' own functions, one molecule.
void shaderStep(const Molecule& molecule, vec3* x, vec3* v, const BaselineStep& step) {
    std::vector<vec3> force(molecule.vertices.size(), vec3(0));
    for (const Spring& spring : molecule.springs) {
        const int a = spring.a, b = spring.b;
        const vec3 f =
            shader::springForce(x[a] - x[b], v[a] - v[b], float(spring.stiffness) * step.stiffness,
                                float(spring.damping) * step.damping, float(molecule.restLength(spring)));
        force[size_t(a)] += f;
        force[size_t(b)] -= f;
    }
    for (size_t i = 0; i < force.size(); ++i) {
        const vec3 acceleration = step.gravity + force[i] * float(1 / molecule.vertices[i].mass);
        v[i] += force[i] * float(1 / molecule.vertices[i].mass) * step.h;
        v[i] = shader::dragAndGravity(v[i], step.wind, step.gravity, step.decay, step.phi);
        x[i] += v[i] * step.h;
        const float above = glm::dot(x[i] - step.planePoint, step.planeNormal) - step.thickness;
        const shader::Contact contact =
            shader::respond(false, x[i], v[i], above, step.planeNormal, step.restitution, step.friction,
                            {step.h, step.h, step.h / 2, acceleration});
        x[i] = contact.position;
        v[i] = contact.velocity;
    }
}

std::vector<Simd> availableForms() {
    std::vector<Simd> out;
    for (const Simd simd : {Simd::scalar, Simd::avx2, Simd::avx512}) {
        if (available(simd)) out.push_back(simd);
    }
    return out;
}

std::vector<Molecule> molecules() {
    return {shipped("quad"), shipped("cross"), shipped("fish"), uneven()};
}

}  // namespace

TEST_CASE("the baseline has the shipped molecules unrolled", "[baseline]") {
    REQUIRE(available(Simd::scalar));
    for (const Simd simd : {Simd::avx2, Simd::avx512}) {
        if (!available(simd)) continue;
        for (const char* one : {"quad", "cross", "fish"})
            CHECK(Baseline(shipped(one), 3, simd, 1).unrolled());
        CHECK_FALSE(Baseline(test::pair(1, 2, 3, 0), 3, simd, 1).unrolled());
    }
    CHECK(fitsBaseline(shipped("fish")));
    CHECK_FALSE(fitsBaseline(shipped("leaf")));  // it has pins
}

TEST_CASE("the baseline gives back the state that it was given", "[baseline]") {
    const Molecule molecule = shipped("cross");
    const States given = start(molecule, 37, vec3(0), 1);
    for (const Simd simd : availableForms()) {
        const States back = run(molecule, simd, given, {}, 0);
        CHECK(distances(given, back, molecule).back() < 1e-6);
        CHECK(given.velocities == back.velocities);
    }
}

TEST_CASE("the baseline follows the reference recurrence in the air", "[baseline]") {
    const BaselineStep step = stepOf(1.0f / 240);
    for (const Molecule& molecule : molecules()) {
        const int count = 19, frames = 30;
        const States from = start(molecule, count, vec3(0, 9, 0), 1);
        reference::Problem problem{.molecule = &molecule,
                                   .stiffness = double(step.stiffness),
                                   .damping = double(step.damping),
                                   .gravity = dvec3(step.gravity),
                                   .drag = {gamma, gamma}};
        problem.fields.push_back(test::field(UniformField{dvec3(step.wind)}));
        States exact;
        const auto size = ptrdiff_t(molecule.vertices.size());
        for (int m = 0; m < count; ++m) {
            reference::State state;
            state.position.assign(from.positions.begin() + m * size, from.positions.begin() + (m + 1) * size);
            state.velocity.assign(from.velocities.begin() + m * size,
                                  from.velocities.begin() + (m + 1) * size);
            for (int i = 0; i < frames * step.substeps; ++i)
                reference::eulerStep(problem, state, double(step.h));
            exact.positions.insert(exact.positions.end(), state.position.begin(), state.position.end());
        }
        for (const Simd simd : availableForms()) {
            CAPTURE(molecule.name, name(simd));
            CHECK(distances(run(molecule, simd, from, step, frames), exact, molecule).back() < 1e-5);
        }
    }
}

TEST_CASE("the baseline lands as the shaders' functions do", "[baseline]") {
    BaselineStep step = stepOf(1.0f / 240);
    step.planePoint = {0, -0.1f, 0};
    step.planeNormal = glm::normalize(vec3(0.1f, 1, -0.05f));
    for (const Molecule& molecule : molecules()) {
        const int count = 101, frames = 60;
        const States from = start(molecule, count, vec3(0), 0.3);
        States expected = from;
        for (int m = 0; m < count; ++m) {
            const size_t first = size_t(m) * molecule.vertices.size();
            for (int i = 0; i < frames * step.substeps; ++i)
                shaderStep(molecule, &expected.positions[first], &expected.velocities[first], step);
        }
        for (const Simd simd : availableForms()) {
            CAPTURE(molecule.name, name(simd));
            checkLandedAlike(run(molecule, simd, from, step, frames), expected, molecule);
        }
    }
}

TEST_CASE("the baseline's instruction sets and threads agree, contact included", "[baseline]") {
    const BaselineStep step = stepOf(1.0f / 240);
    for (const Molecule& molecule : molecules()) {
        const States from = start(molecule, 101, vec3(0), 1);
        const States scalar = run(molecule, Simd::scalar, from, step, 60);
        for (const Simd simd : availableForms()) {
            CAPTURE(molecule.name, name(simd));
            const States two = run(molecule, simd, from, step, 60);
            checkLandedAlike(two, scalar, molecule);
            CHECK(run(molecule, simd, from, step, 60, 1).positions == two.positions);
            CHECK(run(molecule, simd, from, step, 60, 5).positions == two.positions);
        }
    }
}

TEST_CASE("the baseline is as accurate far away", "[baseline]") {
    BaselineStep step = stepOf(1.0f / 240);
    const Molecule molecule = shipped("quad");
    const vec3 far(4096, 0, -2048);  // the start is rounded alike
    States near = start(molecule, 37, vec3(0), 0.3);
    for (vec3& p : near.positions)
        p = (p + vec3(far.x, 0, far.z)) - vec3(far.x, 0, far.z);
    States away = near;
    for (vec3& p : away.positions)
        p += far;
    for (const Simd simd : availableForms()) {
        CAPTURE(name(simd));
        States moved = run(molecule, simd, away, step, 60);
        for (vec3& p : moved.positions)
            p -= far;
        // what is left is the rounding of get()
        CHECK(distances(moved, run(molecule, simd, near, step, 60), molecule).back() <
              5e-4 / molecule.size());
    }
}

}  // namespace shoal::bench
