#include "gpu/texture.h"

#include <cstring>
#include <vector>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gpu/buffer.h"
#include "support/catch.h"

using namespace shoal::gpu;
using Kind = Traffic::Kind;

// Bytes that every format can hold exactly: any pattern for integers, numbers without NaN for the rest.
static std::vector<unsigned char> sampleData(Format format, int texels) {
    std::vector<unsigned char> bytes(static_cast<size_t>(texels) * texelBytes(format));
    if (format == Format::rgba8 || format == Format::srgb8a8 || format == Format::rgba32ui ||
        format == Format::rg32ui) {
        for (size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = static_cast<unsigned char>(i * 37 + 5);
    } else if (format == Format::rgba16f) {
        for (size_t i = 0; i < bytes.size() / 2; ++i) {
            const uint16_t half = static_cast<uint16_t>(0x3c00 + i);  // 1 and its neighbours
            std::memcpy(&bytes[2 * i], &half, 2);
        }
    } else if (format != Format::depth24) {
        for (size_t i = 0; i < bytes.size() / 4; ++i) {
            const float value = isDepth(format) ? float(i) / 64.0f : 1.0f / (float(i) - 3.5f);
            std::memcpy(&bytes[4 * i], &value, 4);
        }
    }
    return bytes;
}

TEST_CASE("what is uploaded comes back bit for bit, and is counted", "[texture]") {
    for (const Format format : {Format::rgba32f, Format::rgba16f, Format::rgba8, Format::srgb8a8,
                                Format::rgba32ui, Format::rg32ui, Format::r32f, Format::depth32f}) {
        INFO("format " << static_cast<int>(format));
        const int width = 5, height = 3;  // odd, so that row padding would show
        Texture texture(testContext(), format, width, height, "round trip");
        const auto data = sampleData(format, width * height);
        const Traffic before = testContext().traffic();
        texture.upload(Kind::state, 0, 0, width, height, data.data(), data.size());
        std::vector<unsigned char> back(data.size(), 0xEE);
        texture.download(Kind::control, 0, 0, width, height, back.data(), back.size());
        CHECK(back == data);
        const Traffic moved = testContext().traffic() - before;
        CHECK(moved.up(Kind::state) == data.size());
        CHECK(moved.down(Kind::control) == data.size());
        CHECK(moved.total(Kind::parameters) == 0);
        CHECK(moved.down(Kind::state) == 0);
    }
    testContext().checkErrors("round trips");
}

TEST_CASE("a depth of 24 bits comes back to its precision", "[texture]") {
    Texture texture(testContext(), Format::depth24, 2, 1, "depth24");
    const uint32_t values[] = {0x12345678u, 0xFFFFFFFFu};
    texture.upload(Kind::parameters, 0, 0, 2, 1, values, sizeof values);
    uint32_t back[2] = {};
    texture.download(Kind::parameters, 0, 0, 2, 1, back, sizeof back);
    // 24 bits are kept, and the driver converts through 32-bit floats.
    CHECK(std::abs(double(back[0]) - double(values[0])) <= 512.0);
    CHECK(back[1] == values[1]);
}

TEST_CASE("a rectangle of a texture is its own", "[texture]") {
    Texture texture(testContext(), Format::r32f, 4, 4, "rectangle");
    const std::vector<float> zeros(16, 0.0f);
    texture.upload(Kind::state, 0, 0, 4, 4, zeros.data(), zeros.size() * sizeof(float));
    const float patch[] = {1, 2, 3, 4};
    texture.upload(Kind::state, 1, 2, 2, 2, patch, sizeof patch);
    float back[16] = {};
    texture.download(Kind::state, 0, 0, 4, 4, back, sizeof back);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            const bool inside = x >= 1 && x < 3 && y >= 2;
            CHECK(back[4 * y + x] == (inside ? patch[2 * (y - 2) + x - 1] : 0.0f));
        }
    }
}

TEST_CASE("a texture that is too large is refused with the limit", "[texture]") {
    const int size = testContext().info().maxTextureSize;
    try {
        Texture texture(testContext(), Format::rgba32f, size + 1, 4, "giant");
        FAIL("accepted");
    } catch (const shoal::Error& error) {
        const std::string message = error.what();
        CHECK(message.find("giant") != std::string::npos);
        CHECK(message.find(std::to_string(size)) != std::string::npos);
        CHECK(message.find("MiB") != std::string::npos);
    }
    testContext().checkErrors("a refused texture");
}

TEST_CASE("a texture moves and leaves nothing behind", "[texture]") {
    Texture first(testContext(), Format::rgba8, 2, 2, "mover");
    const GLuint id = first.id();
    Texture second = std::move(first);
    CHECK(second.id() == id);
    CHECK_FALSE(bool(first));
    CHECK(bool(second));
    second = Texture();
    CHECK_FALSE(bool(second));
    CHECK(glIsTexture(id) == GL_FALSE);
}

TEST_CASE("buffers count what they are given", "[texture]") {
    const float data[] = {1, 2, 3};
    const Traffic before = testContext().traffic();
    Buffer buffer(testContext(), Buffer::Use::vertex, data, sizeof data, "three");
    Buffer empty(testContext(), Buffer::Use::uniform, nullptr, 64, "empty");
    buffer.update(Kind::control, 4, data, 4);
    const Traffic moved = testContext().traffic() - before;
    CHECK(moved.up(Kind::parameters) == sizeof data);
    CHECK(moved.up(Kind::control) == 4);
    testContext().checkErrors("buffers");
}
