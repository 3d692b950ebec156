// The table of solvers, how a group comes to one, and the pure parts of the implicit ones.
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "compile/corotated.h"
#include "compile/path.h"
#include "compile/plan.h"
#include "compile/strain.h"
#include "molecule/molecule_file.h"
#include "reference/discrete.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/shader_physics.h"
#include "support/shapes.h"

namespace shoal {

namespace {

Scene sceneOf(Molecule molecule, std::optional<SolverKind> kind = {}) {
    Scene scene;
    scene.solver.kind = kind;
    Group group;
    group.molecule = std::move(molecule);
    group.count = 2;
    scene.groups.push_back(std::move(group));
    return scene;
}

Molecule fish() {
    return readMolecule(SHOAL_SOURCE_DIR "/molecules/fish.json");
}

glm::dmat3 block(const std::vector<glm::vec4>& factors, int number) {
    glm::dmat3 out;
    for (int k = 0; k < 9; ++k)
        out[k / 3][k % 3] = double(factors[size_t((9 * number + k) / 4)][(9 * number + k) % 4]);
    return out;
}

using Vectors = std::vector<glm::dvec3>;

// Solves with the blocks as generated/sweeps.glsl does.
Vectors solve(const BlockPattern& pattern, const std::vector<glm::vec4>& factors, Vectors x) {
    const auto at = [&](size_t place) -> glm::dvec3& { return x[size_t(pattern.order[place])]; };
    for (size_t p = 0; p < pattern.order.size(); ++p)
        for (size_t n = 0; n < pattern.below[p].size(); ++n)
            at(size_t(pattern.below[p][n])) -= block(factors, pattern.block[p][n]) * at(p);
    for (size_t p = pattern.order.size(); p-- > 0;) {
        at(p) = block(factors, pattern.diagonal[p]) * at(p);
        for (size_t n = 0; n < pattern.below[p].size(); ++n)
            at(p) -= glm::transpose(block(factors, pattern.block[p][n])) * at(size_t(pattern.below[p][n]));
    }
    return x;
}

// A x, spring by spring.
Vectors times(const Molecule& molecule, const CorotatedStage& stage, const Vectors& x) {
    Vectors out;
    const double beta = 1 / (stage.eta * stage.eta) + stage.drag / stage.eta;
    for (size_t v = 0; v < x.size(); ++v)
        out.push_back(beta * molecule.vertices[v].mass * x[v]);
    for (const Spring& spring : molecule.springs) {
        const size_t a = size_t(spring.a), b = size_t(spring.b);
        const glm::dvec3 n = glm::normalize(molecule.vertices[a].position - molecule.vertices[b].position);
        const glm::dvec3 pull =
            (stage.stiffness * spring.stiffness + stage.damping * spring.damping / stage.eta) *
            glm::dot(n, x[a] - x[b]) * n;
        out[a] += pull;
        out[b] -= pull;
    }
    return out;
}

// What a substep makes of x = 1 with h dx/dt = z x, as the shader goes from stage to stage.
std::complex<double> advanced(const Tableau& tableau, std::complex<double> z) {
    std::complex<double> x = 1, sum = 0;
    for (int s = 0; s < tableau.stages; ++s) {
        sum += tableau.b[s] * z * x;
        const auto [rate, added] = tableau.way(s);
        x = 1.0 + rate * z * x + added * sum;
    }
    return x;
}

}  // namespace

TEST_CASE("the table of solvers is in the order of its kinds and its names lead back", "[solvers]") {
    std::set<std::string> names;
    for (size_t i = 0; i < solvers().size(); ++i) {
        const Solver& one = solvers()[i];
        CHECK(size_t(one.kind) == i);
        CHECK(solverOf(one.name) == one.kind);
        CHECK(names.insert(one.name).second);
        CHECK((one.order >= 1 && one.order <= 4));
    }
    CHECK(solverOf("auto") == std::nullopt);
    CHECK_THAT(messageOf([] { solverOf("bdf2-xpdb"); }), Catch::Contains("did you mean \"bdf2-xpbd\""));
}

TEST_CASE("the stages of every Runge-Kutta method have its order, in motion and in time", "[solvers]") {
    for (const Solver& one : solvers()) {
        if (!one.rungeKutta()) continue;
        INFO(one.name);
        // dx/dt = x to the power series of e^h, and dx/dt = n t^(n - 1) to t^n
        const double h = 0.5;
        double series = 1, term = 1;
        for (int n = 1; n <= one.order; ++n) {
            term *= h / n;
            series += term;
            double sum = 0;
            for (int s = 0; s < one.tableau.stages; ++s)
                sum += one.tableau.b[s] * n * std::pow(one.tableau.time(s), n - 1);
            CHECK(sum == Approx(1).epsilon(1e-12));
        }
        if (one.order == one.tableau.stages)
            CHECK(advanced(one.tableau, h).real() == Approx(series).epsilon(1e-12));
        const double coarse = std::abs(advanced(one.tableau, 0.1) - std::exp(0.1)),
                     fine = std::abs(advanced(one.tableau, 0.05) - std::exp(0.05));
        CHECK(std::log2(coarse / fine) == Approx(one.order + 1).margin(0.1));
    }
}

TEST_CASE("every Runge-Kutta method is stable up to its limits, and not far beyond", "[solvers]") {
    const auto grows = [](const Tableau& tableau, std::complex<double> z) {
        return std::abs(advanced(tableau, z)) > 1;
    };
    const std::complex<double> i(0, 1);
    for (const Solver& one : solvers()) {
        if (!one.rungeKutta()) continue;
        INFO(one.name);
        const Tableau& tableau = one.tableau;
        bool beyond = false;
        for (double angle = 0.5; angle <= 1.5; angle += 0.005) {
            const std::complex<double> to = std::exp(i * std::numbers::pi * angle);
            for (double share = 0.02; share <= 1; share += 0.02)
                CHECK_FALSE(grows(tableau, share * tableau.disc * to));
            beyond = beyond || grows(tableau, 1.1 * tableau.disc * to);
        }
        CHECK(beyond);
        CHECK_FALSE(grows(tableau, -tableau.decaying));
        CHECK(grows(tableau, -1.1 * tableau.decaying));
        CHECK_FALSE(grows(tableau, i * tableau.oscillating));
        CHECK(grows(tableau, 1.1 * i * tableau.oscillating));
    }
}

TEST_CASE("a group takes leapfrog while the substep resolves its springs, bdf2-xpbd beyond", "[solvers]") {
    const Plan soft = compile(sceneOf(test::leaf(1e3, 0.5)));
    CHECK(soft.groups[0].solver == SolverKind::leapfrog);
    const Plan stiff = compile(sceneOf(test::leaf(1e7, 0.5)));
    CHECK(stiff.groups[0].solver == SolverKind::bdf2Xpbd);
    CHECK_THAT(stiff.groups[0].solverWhy, Catch::Contains("stiff"));
    CHECK(compile(sceneOf(test::point(1))).groups[0].solver == SolverKind::leapfrog);
    // whatever deforms the molecule: from one solver to the other there is no stiffness that is refused
    for (double stiffness = 1; stiffness < 1e9; stiffness *= 1.7)
        CHECK_NOTHROW(compile(sceneOf(test::leaf(stiffness, 0.05 * std::sqrt(stiffness)))));
    // groups choose for themselves
    Scene both = sceneOf(test::leaf(1e7, 0.5));
    both.groups.push_back(sceneOf(test::leaf(1e3, 0.5)).groups[0]);
    const Plan mixed = compile(both);
    CHECK(mixed.groups[0].solver == SolverKind::bdf2Xpbd);
    CHECK(mixed.groups[1].solver == SolverKind::leapfrog);
}

TEST_CASE("every explicit solver refuses a step beyond its limit and names what would do", "[solvers]") {
    for (const Solver& one : solvers()) {
        Scene scene = sceneOf(test::leaf(1e6, 20), one.kind);
        const std::string message = messageOf([&] { compile(scene); });
        INFO(one.name);
        if (one.implicit) {
            CHECK(message.empty());
            continue;
        }
        REQUIRE_THAT(message, Catch::Contains(std::string(one.name) + " is stable"));
        scene.solver.substeps = std::stoi(message.substr(message.find("use at least ") + 13));
        CHECK_NOTHROW(compile(scene));
        --scene.solver.substeps;
        CHECK_THROWS_AS(compile(scene), Error);
    }
    Scene dragged = sceneOf(test::leaf(100, 0), SolverKind::rk4);
    dragged.groups[0].drag = {2000, 2000};
    const std::string message = messageOf([&] { compile(dragged); });
    REQUIRE_THAT(message, Catch::Contains("rk4 takes drag up to"));
    dragged.solver.substeps = std::stoi(message.substr(message.find("use at least ") + 13));
    CHECK_NOTHROW(compile(dragged));
    // and so does a slider
    const Plan plan = compile(dragged);
    const int more = substepsNeeded(plan, 1 / plan.frameRate, 1, 1, 10, plan.substeps);
    CHECK(more >= 9 * plan.substeps);
    CHECK(10 * 2000 / plan.frameRate / more <= solver(SolverKind::rk4).mostDragged);
}

TEST_CASE("implicit solvers are refused where a molecule does not fit a lane, and off the fused path",
          "[solvers]") {
    const Plan plan = compile(sceneOf(test::leaf(1e7, 1), SolverKind::bdf2Xpbd));
    CHECK(choosePath(plan, Path::automatic, {}).path == Path::fused);
    CHECK_THAT(messageOf([&] { choosePath(plan, Path::pingPong, {}); }),
               Catch::Contains("bdf2-xpbd") && Catch::Contains("needs the fused path"));
    CHECK_THAT(messageOf([&] { chooseLanes(plan, plan.groups[0], Lanes::vertex, {}); }),
               Catch::Contains("in one lane: leave out --lanes vertex"));
    // lanes that are demanded are taken or refused, on whatever path
    CHECK_THAT(messageOf([&] { choosePath(plan, Path::automatic, {}, Lanes::vertex); }),
               Catch::Contains("in one lane: leave out --lanes vertex"));
    const Plan soft = compile(sceneOf(test::leaf(10, 1), SolverKind::euler));
    CHECK(choosePath(soft, Path::automatic, {}, Lanes::vertex).lanes == Lanes::vertex);
    CHECK_THAT(messageOf([&] { choosePath(soft, Path::pingPong, {}, Lanes::vertex); }),
               Catch::Contains("lanes are of the fused path"));
    CHECK_THAT(messageOf([&] { choosePath(soft, Path::fragments, {}, Lanes::vertex); }),
               Catch::Contains("a lane a vertex needs compute shaders"));
    PathLimits old;
    old.compute = false;
    old.version = "3.3";
    CHECK_THAT(messageOf([&] { choosePath(soft, Path::automatic, old, Lanes::vertex); }),
               Catch::Contains("OpenGL 4.3; this context has 3.3"));
    CHECK(choosePath(soft, Path::automatic, old, Lanes::molecule).path == Path::fragments);
    Molecule chain;
    for (int i = 0; i < 65; ++i)
        chain.vertices.push_back({{0.1 * i, 0, 0}, {}, 1, false});
    for (int i = 1; i < 65; ++i)
        chain.springs.push_back({i - 1, i, 1e7, 1, {}, {}});
    const Plan large = compile(sceneOf(chain, SolverKind::xpbd));
    CHECK_THAT(messageOf([&] { choosePath(large, Path::fused, {}); }),
               Catch::Contains("at most 64 vertices"));
}

TEST_CASE("the relaxation of one spring solves its implicit equation", "[solvers][physics]") {
    const float k = 300, d = 40, weight = 0.02f, stretch = 0.03f, parted = -0.01f;
    const float lambda = shader::relaxation(stretch, parted, 0, weight, k, d);
    // the ends part by weight * lambda: the force at the new length and speed is lambda itself
    CHECK(lambda == Approx(-(k * (stretch + weight * lambda) + d * (parted + weight * lambda))));
    CHECK(shader::relaxation(stretch + weight * lambda, parted + weight * lambda, lambda, weight, k, d) ==
          Approx(0).margin(1e-6));
    CHECK(shader::relaxation(0.1f, 0, 0, 0.5f, 0, 0) == 0);  // no stiffness, no force
    // rigid: the whole way at once
    CHECK(weight * shader::relaxation(stretch, 0, 0, weight, 1e12f, 0) == Approx(-stretch).epsilon(1e-5));
}

TEST_CASE("the factors of the corotated matrix solve it, pinned or free", "[solvers]") {
    Molecule molecule = fish();
    molecule.vertices[5].mass *= 7;
    const CorotatedStage stage{0.003, 4, 1.5, 0.5};
    for (const bool held : {false, true}) {
        molecule.vertices[3].pinned = molecule.vertices[11].pinned = true;
        const BlockPattern pattern = blockPattern(molecule, held);
        const std::vector<glm::vec4> factors = corotatedFactors(molecule, pattern, stage);
        CHECK(int(factors.size()) == corotatedElements(pattern));
        CHECK(pattern.order.size() == (held ? 22 : 24));
        CHECK(pattern.blocks < 24 * 25 / 2);  // sparser than a full matrix
        Vectors right;
        for (int v = 0; v < 24; ++v)
            right.emplace_back(std::sin(3.0 * v), std::cos(1.7 * v), std::sin(0.4 * v + 1));
        if (held) right[3] = right[11] = glm::dvec3(0);
        const Vectors back = times(molecule, stage, solve(pattern, factors, right));
        for (size_t v = 0; v < 24; ++v)
            if (!held || (v != 3 && v != 11)) CHECK(glm::length(back[v] - right[v]) < 2e-4);
    }
}

// A leaf of w h = 25 hangs on its stem in winds from everywhere. The sweeps that its first steps fall back on
// let it bend far, and would hold it so for ever.
TEST_CASE("bdf2-corotated brings a molecule that sweeps have bent back to rest", "[solvers]") {
    const Molecule leaf = readMolecule(SHOAL_SOURCE_DIR "/molecules/leaf.json");
    reference::Problem problem{.molecule = &leaf};
    problem.stiffness = 200;
    problem.damping = 14;
    problem.held = true;
    problem.gravity = {0, -9.81, 0};
    problem.drag = {9, 0.9};
    problem.fields.resize(1);
    constexpr int winds = 40;
    for (int i = 0; i < winds; ++i) {
        CAPTURE(i);
        const double up = (2 * i + 1.0) / winds - 1, around = 2.4 * i, across = std::sqrt(1 - up * up);
        problem.fields[0].shape =
            UniformField{10.0 * glm::dvec3(across * std::cos(around), up, across * std::sin(around))};
        reference::State state = reference::restState(problem);
        reference::History history;
        for (int step = 0; step < 90; ++step)
            reference::bdf2Step(problem, state, history, 1.0 / 120, SolverKind::bdf2Corotated);
        double strain = 0;
        for (const Spring& spring : leaf.springs) {
            const double length = leaf.restLength(spring);
            strain = std::max(strain, std::abs(glm::length(state.position[size_t(spring.a)] -
                                                           state.position[size_t(spring.b)]) /
                                                   length -
                                               1));
        }
        CHECK(strain < 0.03);
    }
}

TEST_CASE("vertices that are eliminated in one round are not joined, and there are few rounds", "[solvers]") {
    for (const Molecule& molecule : {fish(), test::hangingChain(200, 1, 0)}) {
        const BlockPattern one = blockPattern(molecule, true),
                           pattern = blockPattern(molecule, true, Elimination::fewestRounds);
        CHECK(one.rounds.size() == one.order.size());
        CHECK(pattern.order.size() == one.order.size());
        CHECK(pattern.rounds.size() <= 16);
        CHECK(pattern.blocks < 3 * one.blocks / 2);
        for (size_t r = 0; r < pattern.rounds.size(); ++r) {
            const int end = r + 1 < pattern.rounds.size() ? pattern.rounds[r + 1] : int(pattern.order.size());
            for (int p = pattern.rounds[r]; p < end; ++p)
                for (const int later : pattern.below[size_t(p)])
                    CHECK(later >= end);
        }
    }
}

namespace {

// What the plan warns of strained springs; else empty.
std::string strainWarning(const Plan& plan) {
    for (const Warning& warning : plan.warnings)
        if (warning.message.find(" strains the springs of ") != std::string::npos) return warning.message;
    return {};
}

Scene chainScene(std::optional<SolverKind> kind) {
    Scene scene = sceneOf(test::hangingChain(20, 1e5, 20), kind);
    scene.gravity = {0, -100, 0};
    return scene;
}

Scene spinScene(std::optional<SolverKind> kind, double damping) {
    Scene scene = sceneOf(test::regularTetrahedron(100, damping), kind);
    scene.groups[0].spin = {5, 3, 20};
    return scene;
}

}  // namespace

TEST_CASE("auto takes bdf2-corotated where sweeps strain the springs and it does not", "[solvers][strain]") {
    Scene finer = spinScene({}, 1e4);
    finer.solver.substeps = 16;
    for (const Scene& scene : {chainScene({}), spinScene({}, 10), spinScene({}, 1e3), finer}) {
        const Plan plan = compile(scene);
        CHECK(plan.groups[0].solver == SolverKind::bdf2Corotated);
        CHECK_THAT(plan.groups[0].solverWhy, Catch::StartsWith("sweeps would strain the springs by "));
        CHECK(strainWarning(plan).empty());
    }
    // a chain that swings, or more damping, strains its springs as well
    Scene aslant = chainScene({});
    aslant.groups[0].place.turn = Placement::Turn::any;
    for (const Scene& scene : {aslant, spinScene({}, 1e4)}) {
        const Plan plan = compile(scene);
        CHECK(plan.groups[0].solver == SolverKind::bdf2Xpbd);
        CHECK_THAT(strainWarning(plan), Catch::Contains("substeps, or bdf2-newton, whose steps take long"));
    }
    CHECK(compile(sceneOf(test::leaf(1e7, 5))).groups[0].solver == SolverKind::bdf2Xpbd);
}

TEST_CASE("an implicit solver that strains springs is warned of, with what would do", "[solvers][strain]") {
    for (const SolverKind kind : {SolverKind::xpbd, SolverKind::bdf2Xpbd})
        for (const Scene& scene : {chainScene(kind), spinScene(kind, 10), spinScene(kind, 1e3)})
            CHECK_THAT(strainWarning(compile(scene)),
                       Catch::StartsWith(name(kind)) && Catch::Contains(": use bdf2-corotated"));
    CHECK_THAT(strainWarning(compile(spinScene(SolverKind::bdf2Corotated, 2e3))),
               Catch::Contains("use at least 8 substeps, or bdf2-newton"));
    for (const double damping : {10.0, 2e3, 1e4})
        CHECK(strainWarning(compile(spinScene(SolverKind::bdf2Newton, damping))).empty());
    CHECK(strainWarning(compile(chainScene(SolverKind::bdf2Corotated))).empty());
    CHECK(strainWarning(compile(sceneOf(test::leaf(1e7, 5), SolverKind::xpbd))).empty());
    Scene finer = chainScene(SolverKind::bdf2Xpbd);
    finer.solver.substeps = 32;
    CHECK(strainWarning(compile(finer)).empty());
    // springs that are so soft that they strain by 0.1 and more with any steps
    Scene soft = sceneOf(test::hangingChain(4, 5, 0.1), SolverKind::bdf2Xpbd);
    soft.gravity = {0, -9.81, 0};
    CHECK(largestStrain(soft.groups[0].molecule, {.substep = 1 / 240.0, .gravity = soft.gravity}) > 0.1);
    CHECK(strainWarning(compile(soft)).empty());
}

TEST_CASE("the strain that is foreseen is that of the same steps in double precision", "[solvers][strain]") {
    const auto check = [](const Molecule& molecule, const StrainRun& run) {
        reference::Problem problem{.molecule = &molecule};
        problem.gravity = run.gravity;
        problem.held = run.held;
        reference::State state = reference::restState(problem, {}, {}, run.spin);
        reference::History history;
        double worst = 0;
        for (int i = 0; i < 120; ++i) {
            if (run.solver == SolverKind::xpbd)
                reference::xpbdStep(problem, state, run.substep);
            else
                reference::bdf2Step(problem, state, history, run.substep, run.solver);
            worst = std::max(worst, test::worstStrain(molecule, state));
        }
        INFO(name(run.solver) << " " << molecule.name);
        CHECK(largestStrain(molecule, run) == Approx(worst).epsilon(0.02));
    };
    for (const Solver& one : solvers()) {
        if (!one.implicit) continue;
        const StrainRun run{.solver = one.kind, .substep = 1 / 240.0};
        StrainRun chain = run, spin = run;
        chain.gravity = {0, -100, 0};
        spin.spin = {5, 3, 20};
        check(test::hangingChain(20, 1e5, 20), chain);
        check(test::regularTetrahedron(100, 10), spin);
    }
}

}  // namespace shoal
