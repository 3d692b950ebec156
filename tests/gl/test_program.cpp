#include "gpu/program.h"

#include <chrono>
#include <thread>
#include <vector>

#include "core/activity.h"
#include "core/error.h"
#include "gl/gl_test.h"
#include "gpu/framebuffer.h"
#include "run/progress.h"
#include "support/catch.h"

using namespace shoal::gpu;

static const char* const triangle =
    "void main() {\n"
    "    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;\n"
    "    gl_Position = vec4(corner, 0.0, 1.0);\n"
    "}\n";

static ProgramOptions withFragment(const std::string& fragment) {
    ProgramOptions options;
    options.vertex = "triangle.vert";
    options.fragment = "test.frag";
    options.label = "test";
    options.generated = {{"triangle.vert", triangle}, {"test.frag", fragment}};
    return options;
}

// Fills a 2 x 2 float texture and gives its first texel.
static std::vector<float> draw(const Program& program, const std::vector<ColorTarget>& targets) {
    const Framebuffer framebuffer(testContext(), targets, nullptr, "target");
    framebuffer.bind();
    program.use();
    drawVertices(3);
    std::vector<float> texels(16);
    targets.front().texture->download(Traffic::Kind::control, 0, 0, 2, 2, texels.data(), 64);
    texels.resize(4);
    testContext().checkErrors("drawing");
    return texels;
}

TEST_CASE("what takes long is told once: a program by its label, else what goes on", "[program]") {
    using namespace std::chrono_literals;
    const Program program(testContext(),
                          withFragment("out vec4 color;\nvoid main() { color = vec4(1.0); }\n"));
    const Program other(testContext(), withFragment("out vec4 color;\nvoid main() { color = vec4(2.0); }\n"));
    std::vector<std::string> told;
    {
        const shoal::BusyWatch watch([&](const std::string& what) { told.push_back(what); }, 40ms);
        const shoal::Activity outer("placing leaves");
        const Texture texture(testContext(), Format::rgba32f, 2, 2, "target");
        program.use();  // uniforms are set, and nothing is drawn yet
        other.use();
        CHECK(draw(program, {&texture}).size() == 4);
        CHECK(firstUse().label == "test");  // and it does not end for long
        std::this_thread::sleep_for(400ms);
        CHECK(firstUse().seconds > 0.35);
        program.use();
        std::this_thread::sleep_for(200ms);
        CHECK(firstUse().label.empty());
        const shoal::Activity inner("reading leaf.obj");
        std::this_thread::sleep_for(200ms);
    }
    CHECK(shoal::activity().what.empty());
    CHECK(told == std::vector<std::string>{"compiling \"test\"", "placing leaves", "reading leaf.obj"});
    other.use();
    CHECK(firstUse().label == "test");
    endFirstUse();
    CHECK(firstUse().label.empty());
}

TEST_CASE("what takes a known time to compile is told with it, and how far it is", "[program]") {
    using namespace std::chrono_literals;
    if (!testContext().info().software) return;
    ProgramOptions options = withFragment("out vec4 color;\nvoid main() { color = vec4(3.0); }\n");
    options.seconds = 2;
    const Program program(testContext(), options);
    program.use();
    std::this_thread::sleep_for(500ms);
    const shoal::Busy busy = shoal::busyWith();
    CHECK(busy.what == "compiling \"test\", about 2 s");
    CHECK(busy.share >= 0.25);
    CHECK(busy.share <= 0.99);
    std::this_thread::sleep_for(2s);
    CHECK(shoal::busyWith().share == 0.99);
    endFirstUse();
    const shoal::Activity activity("baking");
    shoal::Activity::reach(0.5);
    CHECK(shoal::busyWith().what == "baking");
    CHECK(shoal::busyWith().share == 0.5);
}

TEST_CASE("uniforms of every kind arrive", "[program]") {
    const Program program(testContext(),
                          withFragment("uniform int i; uniform uint u; uniform bool b; uniform float f;\n"
                                       "uniform ivec2 i2; uniform ivec4 i4;\n"
                                       "uniform vec2 v2; uniform vec3 v3; uniform vec4 v4;\n"
                                       "uniform mat3 m3; uniform mat4 m4;\n"
                                       "uniform vec4 list[3];\n"
                                       "layout(location = 0) out vec4 color;\n"
                                       "void main() {\n"
                                       "    color.x = float(i) + float(u) + (b ? 1.0 : 0.0) + f;\n"
                                       "    color.y = float(i2.y + i4.w) + v2.y + v3.z + v4.w;\n"
                                       "    color.z = m3[2][1] + m4[3][2];\n"
                                       "    color.w = list[2].w;\n"
                                       "}\n"));
    program.use();
    program.set("i", 1);
    program.set("u", 2u);
    program.set("b", true);
    program.set("f", 0.5f);
    program.set("i2", glm::ivec2(0, 10));
    program.set("i4", glm::ivec4(0, 0, 0, 20));
    program.set("v2", glm::vec2(0, 0.5f));
    program.set("v3", glm::vec3(0, 0, 0.25f));
    program.set("v4", glm::vec4(0, 0, 0, 0.125f));
    glm::mat3 m3(0.0f);
    m3[2][1] = 3;
    program.set("m3", m3);
    glm::mat4 m4(0.0f);
    m4[3][2] = 4;
    program.set("m4", m4);
    const glm::vec4 list[] = {glm::vec4(0), glm::vec4(0), glm::vec4(0, 0, 0, 5)};
    program.set("list", list);
    const Texture target(testContext(), Format::rgba32f, 2, 2, "target");
    CHECK(draw(program, {&target}) == std::vector<float>{4.5f, 30.875f, 7, 5});
}

TEST_CASE("a sampler reads the texture on its unit", "[program]") {
    const Program program(
        testContext(),
        withFragment("uniform sampler2D one, two;\n"
                     "layout(location = 0) out vec4 color;\n"
                     "void main() {\n"
                     "    color = texelFetch(one, ivec2(0), 0) + texelFetch(two, ivec2(0), 0);\n"
                     "}\n"));
    Texture one(testContext(), Format::rgba32f, 1, 1, "one"),
        two(testContext(), Format::rgba32f, 1, 1, "two");
    const float first[] = {1, 2, 3, 4}, second[] = {10, 20, 30, 40};
    one.upload(Traffic::Kind::parameters, 0, 0, 1, 1, first, sizeof first);
    two.upload(Traffic::Kind::parameters, 0, 0, 1, 1, second, sizeof second);
    const Texture target(testContext(), Format::rgba32f, 2, 2, "target");
    program.use();
    program.texture("one", one);
    program.texture("two", two);
    CHECK(draw(program, {&target}) == std::vector<float>{11, 22, 33, 44});
}

TEST_CASE("a uniform block reads its buffer", "[program]") {
    const Program program(testContext(), withFragment("layout(std140) uniform Types { vec4 types[2]; };\n"
                                                      "layout(location = 0) out vec4 color;\n"
                                                      "void main() { color = types[1]; }\n"));
    const float data[] = {0, 0, 0, 0, 1, 2, 3, 4};
    const Buffer buffer(testContext(), Buffer::Use::uniform, data, sizeof data, "types");
    program.uniformBlock("Types", buffer);
    const Texture target(testContext(), Format::rgba32f, 2, 2, "target");
    CHECK(draw(program, {&target}) == std::vector<float>{1, 2, 3, 4});
}

TEST_CASE("defines reach the shader", "[program]") {
    ProgramOptions options = withFragment(
        "layout(location = 0) out vec4 color;\n"
        "void main() { color = vec4(VALUE); }\n");
    options.defines = {"VALUE 7.5"};
    const Program program(testContext(), options);
    const Texture target(testContext(), Format::rgba32f, 2, 2, "target");
    CHECK(draw(program, {&target}).front() == 7.5f);
}

TEST_CASE("a declared uniform that the compiler drops is no mistake", "[program]") {
    const Program program(testContext(), withFragment("uniform float unused;\n"
                                                      "layout(location = 0) out vec4 color;\n"
                                                      "void main() { color = vec4(1.0); }\n"));
    program.use();
    CHECK_FALSE(program.uses("unused"));
    program.set("unused", 1.0f);
    CHECK_NOTHROW(testContext().checkErrors("an unused uniform"));
}

TEST_CASE("a compile error is located in our file", "[program]") {
    ProgramOptions options = withFragment(
        "layout(location = 0) out vec4 color;\n"
        "#include \"lib/broken.glsl\"\n"
        "void main() { color = broken(); }\n");
    options.defines = {"A", "B 2"};
    options.generated["lib/broken.glsl"] =
        "// one\n"
        "// two\n"
        "vec4 broken() { return notDeclared; }\n";
    try {
        const Program program(testContext(), options);
        FAIL("compiled");
    } catch (const shoal::Error& error) {
        CHECK(error.location().file == "generated:lib/broken.glsl");
        CHECK(error.location().line == 3);
        const std::string message = error.what();
        CHECK(message.find("the fragment shader of program \"test\" does not compile") != std::string::npos);
        CHECK(message.find("notDeclared") != std::string::npos);
    }
    testContext().checkErrors("a shader that does not compile");
}

TEST_CASE("a link error names the program", "[program]") {
    const ProgramOptions options = withFragment(
        "vec4 neverDefined();\n"
        "layout(location = 0) out vec4 color;\n"
        "void main() { color = neverDefined(); }\n");
    CHECK_THROWS_WITH(Program(testContext(), options),
                      Catch::Contains("program \"test\"") && Catch::Contains("neverDefined"));
}

TEST_CASE("a missing shader file is an error", "[program]") {
    ProgramOptions options = withFragment("");
    options.fragment = "missing.frag";
    CHECK_THROWS_WITH(Program(testContext(), options), Catch::Contains("no shader file \"missing.frag\""));
    const std::string shaders = testContext().shaders();
    testContext().setShaders("");
    CHECK_THROWS_WITH(Program(testContext(), options), Catch::Contains("ContextOptions::shaders"));
    testContext().setShaders(shaders);
}
