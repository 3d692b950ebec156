#include "gpu/framebuffer.h"

#include <cstdlib>
#include <vector>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gpu/program.h"
#include "support/catch.h"

using namespace shoal::gpu;
using Kind = Traffic::Kind;

static ProgramOptions shaders(const std::string& fragment) {
    ProgramOptions options;
    options.vertex = "half.vert";
    options.fragment = "test.frag";
    options.label = "test";
    // A triangle that covers what lies below the diagonal from (-1,-1) to (1,1), at depth 1/2.
    options.generated = {
        {"half.vert",
         "void main() {\n"
         "    vec2 corner = gl_VertexID == 0 ? vec2(-1) : gl_VertexID == 1 ? vec2(1, -1) : vec2(1);\n"
         "    gl_Position = vec4(corner, 0.0, 1.0);\n"
         "}\n"},
        {"test.frag", fragment}};
    return options;
}

static void drawTriangle(const Program& program) {
    program.use();
    drawVertices(3);
}

TEST_CASE("draw buffers are the colours in their order", "[framebuffer]") {
    const Texture a(testContext(), Format::rgba32f, 4, 4, "a"), b(testContext(), Format::rgba32f, 4, 4, "b");
    const Texture depth(testContext(), Format::depth32f, 4, 4, "depth");
    const Framebuffer framebuffer(testContext(), {&a, &b}, &depth, "two");
    CHECK(framebuffer.width() == 4);
    framebuffer.bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    const Program program(testContext(), shaders("layout(location = 0) out vec4 first;\n"
                                                 "layout(location = 1) out vec4 second;\n"
                                                 "void main() { first = vec4(1.0); second = vec4(2.0); }\n"));
    glEnable(GL_DEPTH_TEST);
    drawTriangle(program);
    glDisable(GL_DEPTH_TEST);
    float texel[4] = {};
    a.download(Kind::control, 3, 0, 1, 1, texel, sizeof texel);
    CHECK(texel[0] == 1.0f);
    b.download(Kind::control, 3, 0, 1, 1, texel, sizeof texel);
    CHECK(texel[0] == 2.0f);
    float value = 0;
    depth.download(Kind::control, 3, 0, 1, 1, &value, sizeof value);
    CHECK(value == 0.5f);
    testContext().checkErrors("two draw buffers");
}

TEST_CASE("a part of a framebuffer can be drawn alone", "[framebuffer]") {
    Texture texture(testContext(), Format::r32f, 4, 4, "part");
    const std::vector<float> zeros(16, 0.0f);
    texture.upload(Kind::parameters, 0, 0, 4, 4, zeros.data(), 64);
    const Framebuffer framebuffer(testContext(), {&texture});
    framebuffer.bind(0, 2, 4, 2);
    const Program program(testContext(), shaders("layout(location = 0) out vec4 color;\n"
                                                 "void main() { color = vec4(gl_FragCoord.y); }\n"));
    drawTriangle(program);
    float back[16] = {};
    texture.download(Kind::control, 0, 0, 4, 4, back, sizeof back);
    CHECK(back[3] == 0.0f);   // below the part
    CHECK(back[11] == 2.5f);  // its first row, at its right end
}

TEST_CASE("samples resolve to what was covered", "[framebuffer]") {
    const Framebuffer many =
        Framebuffer::multisampled(testContext(), Format::rgba8, true, 4, 8, 8, "multisampled");
    const Texture texture(testContext(), Format::rgba8, 8, 8, "resolved");
    const Framebuffer resolved(testContext(), {&texture}, nullptr, "resolved");
    many.bind();
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    const Program program(testContext(), shaders("layout(location = 0) out vec4 color;\n"
                                                 "void main() { color = vec4(1.0); }\n"));
    drawTriangle(program);
    many.blitTo(resolved);
    std::vector<unsigned char> pixels(8 * 8 * 4);
    texture.download(Kind::parameters, 0, 0, 8, 8, pixels.data(), pixels.size());
    CHECK(pixels[4 * 7] == 255);    // right of the bottom row: covered
    CHECK(pixels[4 * 8 * 7] == 0);  // left of the top row: not
    if (many.samples() > 1) {
        const int edge = pixels[4 * (8 * 3 + 3)];  // on the diagonal: partly
        CHECK(edge > 0);
        CHECK(edge < 255);
    }
    testContext().checkErrors("resolving samples");
}

TEST_CASE("more samples than the context has are reduced", "[framebuffer]") {
    const Framebuffer many =
        Framebuffer::multisampled(testContext(), Format::rgba8, false, 1 << 20, 4, 4, "too many");
    CHECK(many.samples() == std::max(1, testContext().info().maxSamples));
}

TEST_CASE("more draw buffers than the context has are refused", "[framebuffer]") {
    const Texture texture(testContext(), Format::rgba8, 2, 2, "one of many");
    const std::vector<ColorTarget> many(static_cast<size_t>(testContext().info().maxColorAttachments) + 1,
                                        &texture);
    CHECK_THROWS_WITH(Framebuffer(testContext(), many, nullptr, "many"),
                      Catch::Contains("\"many\"") && Catch::Contains("this context allows"));
    CHECK_THROWS_AS(Framebuffer::multisampled(testContext(), Format::rgba8, false, 1,
                                              testContext().info().maxTextureSize + 1, 4, "wide"),
                    shoal::Error);
}
