// The text that the fused path generates: a molecule's springs, constants and packing, and the kernel around
// them.
#include <bit>
#include <charconv>
#include <regex>
#include <set>
#include <sstream>

#include "compile/plan.h"
#include "scene/field_kinds.h"
#include "simulate/fused_kernel.h"
#include "support/catch.h"
#include "support/every_kind.h"
#include "support/shapes.h"

using namespace shoal;

namespace {

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
    return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

// As GLSL reads a literal: to the nearest float. Fails where the text is no float literal.
float readBack(const std::string& text) {
    INFO(text);
    CHECK(text.find_first_of(".e") != std::string::npos);
    float value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    CHECK((code == std::errc() && end == text.data() + text.size()));
    return value;
}

bool sameBits(float a, double b) {
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(float(b));
}

Molecule awkward() {
    Molecule out = test::leaf(1.0 / 3, 0);
    const double numbers[] = {0.1, 1e-7, 16777217.0, 3e20, 1.17549435e-38, 2.0 / 7};
    for (size_t i = 0; i < 6; ++i) {
        out.springs[i].stiffness = numbers[i];
        out.springs[i].damping = numbers[5 - i];
        out.springs[i].restLength = numbers[(i + 2) % 6];
    }
    out.springs[3].actuation = Actuation{0.3, 1.7, -0.2};
    for (size_t v = 0; v < 4; ++v)
        out.vertices[v].mass = 1 / numbers[v];
    return out;
}

Scene sceneOf(const Molecule& molecule) {
    Scene scene;
    scene.gravity = {0, -9.81, 0};
    Group group;
    group.name = "group";
    group.molecule = molecule;
    group.count = 3;
    scene.groups.push_back(group);
    return scene;
}

// With everything that a scene may have.
Scene fullScene() {
    Molecule molecule = test::leaf(200, 1);
    molecule.vertices[0].pinned = true;
    molecule.springs[2].actuation = Actuation{0.1, 1, 0};
    Scene scene = sceneOf(molecule);
    scene.fields = {test::field(GustField{}), test::field(test::shear())};
    scene.colliders.resize(2);
    scene.colliders[0].shape = PlaneCollider{};
    scene.colliders[1].shape = SphereCollider{};
    Group& group = scene.groups[0];
    group.drag = {4, 1};
    group.release = Release{1.0, 0.5, 0};
    group.phaseSpread = 1;
    group.place.scale = {0.8, 1.2};
    return scene;
}

std::string kernelOf(const Scene& scene, const KernelOptions& options = {}) {
    return kernelShader(SHOAL_SOURCE_DIR "/shaders", compile(scene), 0, options);
}

std::set<std::string> definesOf(const Scene& scene) {
    std::set<std::string> out;
    for (const std::string& define : kernelProgram(compile(scene), 0, {}).defines)
        if (!define.ends_with(" false")) out.insert(define.substr(0, define.find(' ')));
    return out;
}

// "x[2].yz" as the numbers of its floats among all floats of x.
std::vector<int> floatsOf(const std::string& text, const std::string& array) {
    std::smatch match;
    const std::regex pattern(array + R"(\[(\d+)\](?:\.([xyz]+))?)");
    if (!std::regex_match(text, match, pattern)) return {};
    const std::string parts = match[2].matched ? match[2].str() : "xyz";
    std::vector<int> out;
    for (const char part : parts)
        out.push_back(3 * std::stoi(match[1]) + part - 'x');
    return out;
}

}  // namespace

TEST_CASE("each spring is listed once, its numbers to the bit", "[kernel]") {
    Needs needs;
    needs.springs = needs.springDamping = needs.actuation = needs.scale = needs.phase = true;
    const Molecule molecule = awkward();
    const KernelText text = kernelText(molecule, needs, solver(SolverKind::leapfrog));
    const std::string number = "([-+.e0-9]+)", muscle = R"(bentLength\()" + number +
                                                        R"( \* scale, musclePull\(vec3\()" + number + ", " +
                                                        number + ", " + number +
                                                        R"(\), muscleAngles\[0\]\.x, time, phase\), 0\.0\))";
    const auto springs = matches(
        text.forces,
        std::regex(
            R"(f = sprung\(x\[(\d)\] - x\[(\d)\], (vec3\(0\.0\)|w\[\d\] - w\[\d\]), )" + number + ", " +
            number + ", (?:" + number + R"( \* scale|)" + muscle +
            R"(), inverseMass\[(\d)\] \+ inverseMass\[(\d)\]\);\n    force\[(\d)\] \+= f;\n    force\[(\d)\] -= f;)"));
    REQUIRE(springs.size() == 6);
    CHECK(matches(text.forces, std::regex("sprung\\(")).size() == 6);
    for (size_t i = 0; i < 6; ++i) {
        const Spring& spring = molecule.springs[i];
        const std::smatch& found = springs[i];
        CHECK(found[1] == std::to_string(spring.a));
        CHECK(found[2] == std::to_string(spring.b));
        for (const size_t k : {11u, 13u})
            CHECK((found[k] == found[1] && found[k + 1] == found[2]));
        CHECK(sameBits(readBack(found[4]), spring.stiffness));
        CHECK(sameBits(readBack(found[5]), spring.damping));
        CHECK(sameBits(readBack(found[i == 3 ? 7 : 6]), *spring.restLength));
        if (i != 3) continue;
        CHECK(sameBits(readBack(found[8]), 0.3));
        CHECK(sameBits(readBack(found[9]), 2 * std::acos(-1.0) * 1.7));
        CHECK(sameBits(readBack(found[10]), -0.2));
    }
    const auto masses =
        matches(text.molecule, std::regex(R"(inverseMass\[VERTICES\] = float\[\]\(([^)]*)\))"));
    REQUIRE(masses.size() == 1);
    std::istringstream list(masses[0][1].str());
    size_t vertex = 0;
    for (std::string one; std::getline(list >> std::ws, one, ','); ++vertex)
        CHECK(sameBits(readBack(one), 1 / molecule.vertices[vertex].mass));
    CHECK(vertex == 4);
}

TEST_CASE("packing moves every float once, for 1 to 40 vertices", "[kernel]") {
    Needs needs;
    needs.normals = true;
    for (int vertices = 1; vertices <= 40; ++vertices) {
        Molecule molecule;
        molecule.vertices.resize(size_t(vertices));
        const KernelText text = kernelText(molecule, needs, solver(SolverKind::leapfrog));
        const BufferLayout layout{vertices};
        const int elements = layout.positionElements(), floats = 3 * vertices;
        INFO(vertices << " vertices\n"
                      << text.load << joined(text.state, "\n") << joined(text.normals, "\n"));
        CHECK(4 * elements >= floats);
        CHECK(4 * elements < floats + 4);

        // float k of x in component k % 4 of element k / 4; v behind it; normals in a buffer of their own
        const std::regex load(
            R"(e = element\(oldState, first, (\d+)\)|([xv]\[\d+\][.xyz]*) = e\.([xyzw]+);)");
        int element = -1, loaded = 0;
        bool right = true;
        for (const std::smatch& line : matches(text.load, load)) {
            if (line[1].matched) {
                right &= std::stoi(line[1]) == ++element;
                continue;
            }
            const bool isVelocity = line[2].str()[0] == 'v';
            const std::vector<int> numbers = floatsOf(line[2], isVelocity ? "v" : "x");
            const std::string from = line[3];
            right &= numbers.size() == from.size();
            for (size_t i = 0; i < std::min(numbers.size(), from.size()); ++i, ++loaded)
                right &=
                    4 * (element - (isVelocity ? elements : 0)) + int(std::string("xyzw").find(from[i])) ==
                        numbers[i] &&
                    numbers[i] == loaded % floats;
        }
        CHECK(right);
        CHECK(loaded == 2 * floats);
        CHECK(element == 2 * elements - 1);

        std::vector<std::string> all = text.state;
        all.insert(all.end(), text.normals.begin(), text.normals.end());
        REQUIRE(all.size() == size_t(3 * elements));
        std::map<std::string, int> stored;
        bool rightToo = true;
        for (int at = 0; at < 3 * elements; ++at) {
            const std::string array = at < elements ? "x" : at < 2 * elements ? "v" : "normal";
            int slot = 4 * (at % elements);
            const std::string& value = all[size_t(at)];
            REQUIRE(value.substr(0, 5) == "vec4(");
            std::istringstream parts(value.substr(5, value.size() - 6));
            for (std::string part; std::getline(parts >> std::ws, part, ',');) {
                if (part == "0.0") {
                    rightToo &= slot++ >= floats;
                    continue;
                }
                const std::vector<int> numbers = floatsOf(part, array);
                rightToo &= !numbers.empty();
                for (const int number : numbers) {
                    rightToo &= number == slot++ && number == stored[array];
                    ++stored[array];
                }
            }
            rightToo &= slot % 4 == 0;
        }
        CHECK(rightToo);
        CHECK(stored == std::map<std::string, int>{{"normal", floats}, {"v", floats}, {"x", floats}});
    }
}

TEST_CASE("no two 4-vectors of a buffer share a place, and none is left out", "[kernel]") {
    for (const int elements : {1, 2, 3, 6, 18, 50}) {
        for (const size_t molecules : {1u, 31u, 32u, 33u, 1025u}) {
            const BufferLayout layout{elements};  // of as many vertices: other workgroups
            const size_t padded = layout.padded(molecules);
            CHECK(padded >= molecules);
            CHECK(padded < molecules + size_t(layout.lanes()));
            CHECK(padded % BufferLayout::block == 0);
            std::vector<int> taken(padded * size_t(elements), 0);
            for (size_t m = 0; m < padded; ++m)
                for (int e = 0; e < elements; ++e)
                    ++taken.at(BufferLayout::index(m, e, elements));
            CHECK(std::count(taken.begin(), taken.end(), 1) == ptrdiff_t(taken.size()));
        }
    }
}

TEST_CASE("no slider changes a kernel's text", "[kernel]") {
    const Scene plain = fullScene();
    for (const Lanes lanes : {Lanes::molecule, Lanes::vertex}) {
        const KernelOptions options{.lanes = lanes, .normals = true};
        const std::string text = kernelOf(plain, options);
        Scene moved = plain;
        moved.gravity = {0.1, -1.62, 0.2};
        moved.frameRate = 50;
        moved.solver.substeps = 17;
        Group& group = moved.groups[0];
        group.stiffness = 1.7;
        group.damping = 0.3;
        group.drag = {2, 3};
        group.release = Release{7.0, 0.125, 2};
        std::get<GustField>(*moved.fields[0].shape).speed = 11;
        moved.fields[1].weight = 0.25;
        moved.colliders[0].friction = 0.9;
        std::get<SphereCollider>(*moved.colliders[1].shape).radius = 0.3;
        moved.seed = 12;
        group.count = 2000;
        CHECK(kernelOf(moved, options) == text);
        // while another shape, or one more spring, is another kernel of a lane a molecule, whose text holds
        // them
        moved.groups[0].molecule.springs.pop_back();
        CHECK((kernelOf(moved, options) == text) == (lanes == Lanes::vertex));
    }
}

TEST_CASE("a height field is looked up once a vertex and substep, a plane where it is needed", "[kernel]") {
    Scene scene = sceneOf(test::point(1));
    scene.colliders.resize(1);
    scene.colliders[0].shape = PlaneCollider{};
    const auto keeps = [&] {
        return kernelOf(scene).find("const bool keepsSurface = true") != std::string::npos;
    };
    CHECK(!keeps());
    HeightFieldCollider field;
    field.columns = field.rows = 2;
    field.high = {1, 1};
    field.heights = {0, 0, 0, 0};
    scene.colliders[0].shape = field;
    CHECK(keeps());
}

TEST_CASE("a kernel holds the branches that the group needs, and no other", "[kernel]") {
    using Set = std::set<std::string>;
    const Set always{"LANES",          "BLOCK", "VERTICES",        "POSITION_ELEMENTS",
                     "STATE_ELEMENTS", "FUSED", "SAMPLE_SUBSTEPS", "LEAPFROG"};
    const auto with = [&](Set more) {
        more.insert(always.begin(), always.end());
        return more;
    };
    CHECK(definesOf(sceneOf(test::point(1))) == with({"RECORDS", "ANCHORS_MOVE"}));
    CHECK(definesOf(sceneOf(test::leaf(100, 1))) == with({"RECORDS", "ANCHORS_MOVE", "SPRINGS"}));
    const Set all = with({"RECORDS", "ANCHORS_MOVE", "RELEASE", "PINS", "SPRINGS", "MUSCLES", "CONSTANTS",
                          "FIELDS", "DIRECTIONAL_DRAG", "COLLIDE"});
    CHECK(definesOf(fullScene()) == all);

    struct Case {
        const char* gone;
        std::vector<const char*> words;  // that no longer occur outside conditions
        void (*change)(Scene&);
    };
    const Case cases[] = {
        {"COLLIDE",
         {"respond(", "acceptAnswers(", "colliderParameters"},
         [](Scene& s) { s.colliders.clear(); }},
        {"FIELDS", {"gustFromTile(", "fieldParameters"}, [](Scene& s) { s.fields.clear(); }},
        {"PINS", {"max(pull, ", "bool[](true"}, [](Scene& s) { s.groups[0].held = false; }},
        {"RELEASE", {"max(pull, "}, [](Scene& s) { s.groups[0].release.reset(); }},
        {"SPRINGS", {"= sprung("}, [](Scene& s) { s.groups[0].molecule.springs.clear(); }},
        {"DIRECTIONAL_DRAG",
         {},
         [](Scene& s) {
             s.groups[0].drag = {1, 1};
         }},
        {"LEAPFROG", {}, [](Scene& s) { s.solver.kind = SolverKind::euler, s.solver.substeps = 32; }},
        {"CONSTANTS",
         {"* scale, ", "time, phase)"},
         [](Scene& s) {
             s.groups[0].phaseSpread = 0, s.groups[0].place.scale = {1, 1};
         }},
    };
    const std::string whole = kernelOf(fullScene());
    for (const Case& one : cases) {
        INFO("without " << one.gone);
        Scene scene = fullScene();
        one.change(scene);
        CHECK(definesOf(scene).count(one.gone) == 0);
        const std::string text = kernelOf(scene);
        for (const char* word : one.words) {
            INFO(word);
            CHECK(whole.find(word) != std::string::npos);
            CHECK(text.find(word) == std::string::npos);
        }
    }
}
