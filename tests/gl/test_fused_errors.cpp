// The fused path says clearly what it cannot do, and `auto` goes on where there is a way.
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "gpu/gl.h"
#include "simulate/fused.h"
#include "simulate/texture_state.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

namespace shoal {

namespace {

namespace fs = std::filesystem;

Scene leafScene() {
    Scene scene = test::swarm(test::leaf(150, 1), 33, SolverKind::euler);
    scene.groups[0].drag = {3, 1};
    test::setStableSubsteps(scene);
    return scene;
}

// Appends `mistake` to the first line of a shader that holds `text`; returns the line's number.
int spoil(const fs::path& file, const std::string& text, const std::string& mistake) {
    std::istringstream lines(readFile(file));
    std::string out, line;
    int number = 0, spoilt = 0;
    while (std::getline(lines, line)) {
        ++number;
        if (spoilt == 0 && line.find(text) != std::string::npos) {
            spoilt = number;
            line += mistake;
        }
        out += line + "\n";
    }
    REQUIRE(spoilt > 0);
    writeFile(file, out);
    return spoilt;
}

// A device with little memory for storage: what goes beyond it is refused as OpenGL would.
class LittleMemory {
  public:
    explicit LittleMemory(size_t most)
        : allocate_(__glewBufferData), remove_(__glewDeleteBuffers), left_(most) {
        only = this;
        __glewBufferData = [](GLenum target, GLsizeiptr bytes, const void* data, GLenum usage) {
            only->allocate(target, bytes, data, usage);
        };
        __glewDeleteBuffers = [](GLsizei count, const GLuint* ids) { only->remove(count, ids); };
    }
    ~LittleMemory() {
        __glewBufferData = allocate_;
        __glewDeleteBuffers = remove_;
    }
    LittleMemory(const LittleMemory&) = delete;
    LittleMemory& operator=(const LittleMemory&) = delete;

  private:
    void allocate(GLenum target, GLsizeiptr bytes, const void* data, GLenum usage) {
        const bool storage = usage == GL_DYNAMIC_COPY, fits = !storage || size_t(bytes) <= left_;
        GLint bound = 0;
        glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &bound);
        if (storage && fits) left_ -= held_[GLuint(bound)] = size_t(bytes);
        allocate_(target, fits ? bytes : -1, data, usage);
    }
    void remove(GLsizei count, const GLuint* ids) {
        for (GLsizei i = 0; i < count; ++i)
            left_ += std::exchange(held_[ids[i]], 0);
        remove_(count, ids);
    }

    static inline LittleMemory* only = nullptr;
    PFNGLBUFFERDATAPROC allocate_;
    PFNGLDELETEBUFFERSPROC remove_;
    size_t left_;
    std::map<GLuint, size_t> held_;  // bytes by buffer
};

// So many bytes are left to this process for as long as this lives; never under a sanitizer, which takes all.
class LittleAddressSpace {
  public:
    explicit LittleAddressSpace(size_t bytes) {
        std::ifstream in("/proc/self/statm");
        size_t pages = 0;
        in >> pages;
        getrlimit(RLIMIT_AS, &before_);
        const rlimit limit{pages * size_t(sysconf(_SC_PAGESIZE)) + bytes, before_.rlim_max};
        setrlimit(RLIMIT_AS, &limit);
    }
    ~LittleAddressSpace() { setrlimit(RLIMIT_AS, &before_); }
    LittleAddressSpace(const LittleAddressSpace&) = delete;
    LittleAddressSpace& operator=(const LittleAddressSpace&) = delete;

  private:
    rlimit before_{};
};

}  // namespace

TEST_CASE("a mistake in a fused shader is located in our file and line", "[fused][errors]") {
    if (!test::canFuse()) return;
    const test::Scratch scratch;
    const fs::path root = scratch / "shaders";
    const std::string shaders = testContext().shaders();
    struct Case {
        const char *file, *text;
        Lanes lanes;
    };
    const Case cases[] = {
        {"fused/step.glsl", "vec3 ended = dragged(", Lanes::molecule},  // in a loop that is written out
        {"fused/step.glsl", "vec3 ended = dragged(", Lanes::vertex},    // and spread over lanes
        {"solver/euler.glsl", "sampleHere(time);", Lanes::molecule},
        {"physics/spring.glsl", "float inverse = inversesqrt(", Lanes::molecule},
        {"step/drag.glsl", "return dragAndGravity(", Lanes::molecule},
    };
    for (const auto& [file, text, lanes] : cases) {
        fs::remove_all(root);
        fs::copy(shaders, root, fs::copy_options::recursive);
        testContext().setShaders(root.string());
        Scene scene = leafScene();
        scene.groups[0].drag = {1, 1};
        const int line = spoil(root / file, text, " mistaken = nonsense;");
        const auto make = [&, way = lanes] {
            Simulation(testContext(), compile(scene), {.path = Path::fused, .lanes = way});
        };
        const std::string message = messageOf(make);
        testContext().setShaders(shaders);
        INFO(message);
        CHECK(message.find(concat((root / file).string(), ":", line, ":")) == 0);
        CHECK_THAT(message, Catch::Contains("does not compile"));
    }
}

TEST_CASE("without OpenGL 4.3 the fused path runs in fragments and says why", "[errors]") {
    if (testContext().info().computeShaders) return;
    Scene scene = leafScene();
    const auto make = [&](Path path) {
        return Simulation(testContext(), compile(scene), {.path = path}).path();
    };
    CHECK(make(Path::fused).path == Path::fragments);
    CHECK_THAT(make(Path::fused).why, Catch::Contains("OpenGL 3.3 has no compute shaders"));
    CHECK(make(Path::automatic).path == Path::fragments);
    CHECK_THAT(make(Path::automatic).why, Catch::Contains("need OpenGL 4.3; this context has 3.3"));
    scene.groups[0].molecule = test::sheet(66, 1, true);
    scene.solver.fieldSampling = FieldSampling::vertexFrame;
    CHECK_THAT(messageOf([&] { make(Path::automatic); }), Catch::Contains("no path can run this scene") &&
                                                              Catch::Contains("a lane holds at most 64") &&
                                                              Catch::Contains("vertexFrame"));
}

TEST_CASE("the ping-pong path refuses fields that are not read every substep", "[errors]") {
    Scene scene = leafScene();
    for (const FieldSampling sampling : {FieldSampling::vertexFrame, FieldSampling::moleculeFrame}) {
        scene.solver.fieldSampling = sampling;
        CHECK_THAT(messageOf([&] { Simulation(testContext(), compile(scene), {.path = Path::pingPong}); }),
                   Catch::Contains("ping-pong") && Catch::Contains(name(sampling)) &&
                       Catch::Contains("needs the fused path"));
    }
}

TEST_CASE("the largest molecule that a workgroup holds runs, and one more is refused", "[fused][errors]") {
    if (!test::canFuse()) return;
    const PathLimits limits = limitsOf(testContext().info());
    const int most = FusedLimits::vertices(limits.maxSharedBytes);
    REQUIRE(most > 64);
    Molecule molecule = test::sheet(most, 1, true);  // a chain, with a triangle so that all arrays are used
    REQUIRE(int(molecule.vertices.size()) == most);
    molecule.vertices[1].position.z = 0.1;
    molecule.triangles = {{0, 1, 2}};
    Scene scene = test::swarm(molecule, 3, SolverKind::leapfrog, {0, 0.5, 0});
    scene.gravity = {0, -9.81, 0};
    scene.groups[0].drag = {3, 1};
    scene.groups[0].release = Release{{}, 1.0, 0};
    scene.fields = {test::everyField()[3]};
    scene.colliders = {test::everyCollider()[0]};
    test::setStableSubsteps(scene);
    test::Agreement agreement(scene, {.path = Path::fused}, {.path = Path::pingPong});
    CHECK(agreement.first().lanes(0) == Lanes::vertex);
    const test::Comparison c = agreement.at(3);
    INFO(text(c));
    CHECK(c.wrong == 0);

    molecule.springs.clear();
    molecule.vertices.emplace_back();
    scene.groups[0].molecule = molecule;
    CHECK_THAT(messageOf([&] { Simulation(testContext(), compile(scene), {.path = Path::fused}); }),
               Catch::Contains(concat("has ", most + 1, " vertices; a workgroup holds at most ", most)));
    CHECK(Simulation(testContext(), compile(scene)).path().path == Path::pingPong);

    scene.groups[0].molecule.vertices.resize(FusedLimits::laneVertices + 1);
    CHECK_THAT(messageOf([&] {
                   Simulation(testContext(), compile(scene), {.path = Path::fused, .lanes = Lanes::molecule});
               }),
               Catch::Contains(concat("a lane holds at most ", FusedLimits::laneVertices)));
}

TEST_CASE("where two sides do not fit, auto goes on with one and says so", "[fused][errors]") {
    if (!test::canFuse()) return;
    const Scene scene = leafScene();
    const Plan plan = compile(scene);
    const size_t one = stateBytes(plan, Path::fused, true, true), two = stateBytes(plan, Path::fused, true);
    const auto make = [&](size_t bytes, const SimulationOptions& options) {
        // and the tables, and the watchdog's word
        const size_t tables = (plan.samples.size() + plan.topology.size()) * sizeof(glm::vec4);
        const LittleMemory memory(bytes + tables + sizeof(uint32_t));
        return Simulation(testContext(), plan, options);
    };
    Simulation roomy = make(two, {});
    CHECK(roomy.warnings().empty());
    CHECK(roomy.stateBytes() == two);
    Simulation narrow = make(two - 1, {});
    REQUIRE(narrow.warnings().size() == 1);
    CHECK_THAT(narrow.warnings()[0].message,
               Catch::Contains("of leaf\" does not fit into memory") && Catch::Contains("one side"));
    CHECK(narrow.stateBytes() == one);
    test::run(roomy, 3);
    test::run(narrow, 3);
    CHECK(narrow.hash() == roomy.hash());

    CHECK_THAT(messageOf([&] { make(two - 1, {.path = Path::fused}); }), Catch::Contains("does not fit"));
    CHECK(make(one, {.path = Path::fused, .inPlace = true}).warnings().empty());
    CHECK_THAT(messageOf([&] { make(one - 1, {}); }), Catch::Contains("does not fit"));
}

#if !defined(__SANITIZE_ADDRESS__)
TEST_CASE("textures that do not fit into memory are refused at the largest group", "[errors]") {
    if (!testContext().info().software) return;  // its memory is the process's
    Scene scene = leafScene();
    scene.groups.push_back(scene.groups[0]);
    scene.groups[0].location = Location{"two.scene.json", 3, 5, {}};
    scene.groups[1].location = Location{"two.scene.json", 4, 5, {}};
    scene.groups[1].count = 1600000;  // more than earlier tests have left free in this process
    const Plan plan = compile(scene);
    glFinish();
    malloc_trim(0);  // what was freed before is no room for it
    const LittleAddressSpace limit(1 << 20);
    CHECK_THAT(messageOf([&] { TextureState(testContext(), plan); }),
               Catch::Contains("two.scene.json:4:5") && Catch::Contains("texture \"") &&
                   Catch::Contains("does not fit into memory, for 1600000 molecules here and those"));
}
#endif

}  // namespace shoal
