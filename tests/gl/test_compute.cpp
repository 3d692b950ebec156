// Compute programs on storage buffers, and buffers read as textures. Below OpenGL 4.3 there is only the
// refusal, and buffer textures over whole buffers.
#include <vector>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "support/catch.h"
#include "support/end_of.h"
#include "support/message_of.h"

using namespace shoal::gpu;
using Kind = Traffic::Kind;

namespace {

bool hasCompute() {
    if (!testContext().info().computeShaders) WARN("skipped: this context has no compute shaders");
    return testContext().info().computeShaders;
}

ProgramOptions computing(const std::string& text) {
    ProgramOptions options;
    options.compute = "test.comp";
    options.label = "test";
    options.generated = {{"test.comp", text}};
    return options;
}

const char* const squares =
    "layout(local_size_x = 64) in;\n"
    "layout(std430) readonly buffer Numbers { float number[]; };\n"
    "layout(std430) buffer Squares { float square[]; };\n"
    "uniform uint count;\n"
    "void main() {\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    if (i < count) square[i] = number[i] * number[i];\n"
    "}\n";

size_t roundUp(size_t value, int step) {
    const auto unit = static_cast<size_t>(step);
    return (value + unit - 1) / unit * unit;
}

std::vector<float> floats(const Buffer& buffer, size_t offset, size_t count) {
    std::vector<float> out(count);
    buffer.download(Kind::control, offset, out.data(), count * sizeof(float));
    return out;
}

Buffer storageOf(const std::vector<float>& values, const char* label) {
    return {testContext(), Buffer::Use::storage, std::span<const float>(values), label};
}

}  // namespace

TEST_CASE("a compute program writes a part of a buffer, and nothing beside it", "[compute]") {
    if (!hasCompute()) return;
    const int count = 1000;  // no multiple of the group's 64
    const size_t bytes = count * sizeof(float);
    const size_t before = roundUp(sizeof(float), testContext().info().storageBufferAlignment);
    std::vector<float> numbers(count), untouched((before + bytes) / sizeof(float) + 100, -1.0f);
    for (int i = 0; i < count; ++i)
        numbers[size_t(i)] = float(i) - 500.0f;
    const Buffer input = storageOf(numbers, "numbers"), output = storageOf(untouched, "squares");

    const Program program(testContext(), computing(squares));
    program.use();
    program.set("count", uint32_t(count));
    program.storage("Numbers", input, 0, bytes);
    program.storage("Squares", output, before, bytes);
    program.dispatch((count + 63) / 64);

    const std::vector<float> all = floats(output, 0, untouched.size());
    std::vector<float> expected = untouched;
    for (int i = 0; i < count; ++i)
        expected[before / sizeof(float) + size_t(i)] = numbers[size_t(i)] * numbers[size_t(i)];
    CHECK(all == expected);
    testContext().checkErrors("a compute program");
}

TEST_CASE("a compute program reads a part of a buffer as a texture", "[compute]") {
    if (!hasCompute()) return;
    // Texel i of the part is 4 i, 4 i + 1, … of what was written by an earlier dispatch.
    const int texels = 70;
    const size_t offset = roundUp(16, testContext().info().textureBufferAlignment);
    const size_t bytes = offset + texels * 16 + 160;
    const Buffer values(testContext(), Buffer::Use::storage, nullptr, bytes, "values");
    const Program fill(testContext(), computing("layout(local_size_x = 64) in;\n"
                                                "layout(std430) writeonly buffer Values { float value[]; };\n"
                                                "uniform int first;\n"
                                                "void main() {\n"
                                                "    int i = int(gl_GlobalInvocationID.x);\n"
                                                "    if (i < value.length()) value[i] = float(i - first);\n"
                                                "}\n"));
    fill.use();
    fill.set("first", int(offset / sizeof(float)));
    fill.storage("Values", values, 0, bytes);
    fill.dispatch(int(bytes / sizeof(float) + 63) / 64);
    barrier({Barrier::textureFetch});

    const BufferTexture part(testContext(), values, "part", offset, texels * 16);
    CHECK(part.texels() == texels);
    const Program sum(testContext(),
                      computing("layout(local_size_x = 64) in;\n"
                                "layout(std430) writeonly buffer Sums { float sums[]; };\n"
                                "uniform samplerBuffer part;\n"
                                "void main() {\n"
                                "    int i = int(gl_GlobalInvocationID.x);\n"
                                "    if (i < sums.length())\n"
                                "        sums[i] = i < textureSize(part)\n"
                                "            ? dot(texelFetch(part, i), vec4(1, 10, 100, 1000)) : -1.0;\n"
                                "}\n"));
    const Buffer sums(testContext(), Buffer::Use::storage, nullptr, (texels + 1) * sizeof(float), "sums");
    sum.use();
    sum.texture("part", part);
    sum.storage("Sums", sums, 0, sums.bytes());
    sum.dispatch(2);
    const std::vector<float> found = floats(sums, 0, texels + 1);
    for (int i = 0; i < texels; ++i)
        CHECK(found[size_t(i)] == float(1111 * 4 * i + 3210));
    CHECK(found[texels] == -1.0f);  // the texture ends there
    testContext().checkErrors("a buffer texture");
}

TEST_CASE("a program that lacks what it reads ends with its name", "[compute]") {
    if (!hasCompute()) return;
    using shoal::test::endOf;
    const Buffer numbers = storageOf({1, 2, 3, 4}, "numbers"), results = storageOf({0, 0, 0, 0}, "squares");
    const Program program(testContext(), computing(squares)), other(testContext(), computing(squares));
    program.use();
    program.storage("Numbers", numbers);
    const auto lacking = endOf([] { beginPass(); });
    CHECK(lacking.signal == SIGABRT);
    CHECK_THAT(lacking.said, Catch::Contains("the program in use was not given \"Squares\""));
    program.storage("Squares", results);
    CHECK(endOf([] { beginPass(); }).signal == 0);
    // what another program has been given since lies in its place
    other.use();
    other.storage("Numbers", results);
    other.storage("Squares", numbers);
    program.use();
    CHECK_THAT(endOf([] { beginPass(); }).said, Catch::Contains("was not given \"Numbers\""));
}

TEST_CASE("a fragment shader reads a whole buffer as a texture", "[compute]") {
    const std::vector<float> values = {0, 0, 0, 0, 1, 2, 3, 4};
    const Buffer buffer = storageOf(values, "values");
    const BufferTexture texture(testContext(), buffer, "values");
    CHECK(texture.texels() == 2);
    ProgramOptions options;
    options.vertex = "triangle.vert";
    options.fragment = "test.frag";
    options.generated = {
        {"triangle.vert",
         "void main() {\n"
         "    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);\n"
         "}\n"},
        {"test.frag",
         "uniform samplerBuffer values;\n"
         "layout(location = 0) out vec4 color;\n"
         "void main() { color = texelFetch(values, textureSize(values) - 1); }\n"}};
    const Program program(testContext(), options);
    Texture target(testContext(), Format::rgba32f, 1, 1, "target");
    const Framebuffer framebuffer(testContext(), {&target}, nullptr, "target");
    framebuffer.bind();
    program.use();
    program.texture("values", texture);
    drawVertices(3);
    std::vector<float> color(4);
    target.download(Kind::control, 0, 0, 1, 1, color.data(), 16);
    CHECK(color == std::vector<float>{1, 2, 3, 4});
    testContext().checkErrors("a buffer texture");
}

TEST_CASE("a buffer texture beyond the context's limit is refused", "[compute]") {
    const ContextInfo& info = testContext().info();
    const auto most = static_cast<size_t>(info.maxBufferTexels);
    CHECK_NOTHROW(BufferTexture::checkTexels(info, most, "large"));
    CHECK(messageOf([&] { BufferTexture::checkTexels(info, most + 1, "giant"); }) ==
          shoal::concat("buffer texture \"giant\" of ", most + 1,
                        " texels is too large: this context allows ", most));
}

// Hidden, because it takes 2 GiB on Mesa and NVIDIA.
TEST_CASE("a buffer with more texels than the limit makes no texture", "[.large]") {
    const auto most = static_cast<size_t>(testContext().info().maxBufferTexels);
    const Buffer buffer(testContext(), Buffer::Use::storage, nullptr, (most + 1) * 16, "giant");
    CHECK_THAT(messageOf([&] { BufferTexture(testContext(), buffer, "giant"); }),
               Catch::Contains("buffer texture \"giant\""));
    testContext().checkErrors("a refused buffer texture");
}

TEST_CASE("a mistake in a compute shader is located in our file", "[compute]") {
    if (!hasCompute()) return;
    ProgramOptions options = computing(
        "layout(local_size_x = 64) in;\n"
        "#include \"lib/broken.glsl\"\n"
        "void main() { broken(); }\n");
    options.defines = {"A"};
    options.generated["lib/broken.glsl"] = "// one\nvoid broken() { notDeclared = 1; }\n";
    try {
        const Program program(testContext(), options);
        FAIL("compiled");
    } catch (const shoal::Error& error) {
        CHECK(error.location().file == "generated:lib/broken.glsl");
        CHECK(error.location().line == 2);
        CHECK_THAT(error.what(), Catch::Contains("the compute shader of program \"test\" does not compile") &&
                                     Catch::Contains("notDeclared"));
        CHECK_THAT(error.message(), Catch::Contains("generated:lib/broken.glsl:2:"));
    }
    CHECK_THAT(messageOf([] {
                   Program(
                       testContext(),
                       computing("layout(local_size_x = 1) in;\nvoid never();\nvoid main() { never(); }\n"));
               }),
               Catch::Contains("program \"test\" (test.comp) does not link"));
    testContext().checkErrors("a shader that does not compile");
}

TEST_CASE("compute programs are refused by the version of the context", "[compute]") {
    const ContextInfo& info = testContext().info();
    CHECK((info.maxWorkGroupsX >= 65535) == info.computeShaders);  // the least that OpenGL promises
    CHECK((info.maxSharedBytes >= 32768) == info.computeShaders);
    CHECK((info.storageBufferAlignment > 0) == info.computeShaders);
    CHECK((info.textureBufferAlignment > 0) == info.computeShaders);
    if (info.computeShaders) return;
    CHECK_FALSE(info.subgroups);
    CHECK(messageOf([] { Program(testContext(), computing(squares)); }) ==
          shoal::concat("compute shaders need OpenGL 4.3; this context has ", info.major, ".", info.minor));
}
