#include "support/catch.h"

#include "core/file.h"
#include "core/image.h"
#include "core/random.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;

static Image noise(int width, int height, int channels) {
    Image image{width, height, channels, {}};
    Random random(5);
    for (int i = 0; i < width * height * channels; ++i)
        image.pixels.push_back(static_cast<uint8_t>(random.next()));
    return image;
}

static std::string encoded(const Image& image) {
    const std::vector<std::byte> bytes = encodePng(image);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

TEST_CASE("an RGBA picture reads back bit for bit", "[image]") {
    const test::Scratch folder;
    const Image image = noise(13, 7, 4);
    writePng(folder / "x.png", image);
    const Image again = readPng(folder / "x.png");
    CHECK(again.width == 13);
    CHECK(again.height == 7);
    CHECK(again.channels == 4);
    CHECK(again.pixels == image.pixels);
}

TEST_CASE("fewer channels become RGBA", "[image]") {
    for (const int channels : {1, 2, 3}) {
        const Image image = noise(5, 3, channels);
        const Image rgba = decodePng(encoded(image), "f");
        REQUIRE(rgba.pixels.size() == 5 * 3 * 4);
        for (size_t i = 0; i < 15; ++i) {
            const uint8_t* from = &image.pixels[i * size_t(channels)];
            const bool grey = channels < 3;
            CHECK(rgba.pixels[4 * i] == from[0]);
            CHECK(rgba.pixels[4 * i + 1] == from[grey ? 0 : 1]);
            CHECK(rgba.pixels[4 * i + 2] == from[grey ? 0 : 2]);
            CHECK(rgba.pixels[4 * i + 3] == (channels == 2 ? from[1] : 255));
        }
    }
}

TEST_CASE("a grey picture of eight bits is a height image", "[image]") {
    const HeightImage heights = decodeHeightPng(encoded({3, 1, 1, {0, 128, 255}}), "f");
    CHECK(heights.width == 3);
    CHECK(heights.values[0] == 0);
    CHECK(heights.values[1] == Approx(128.0 / 255));
    CHECK(heights.values[2] == 1);
    CHECK(messageOf([] { decodeHeightPng(encoded(noise(2, 2, 3)), "f"); }) ==
          "f: expected a grey PNG picture of 8 or 16 bits, found one in colour");
}

// 2 x 2 grey of 16 bits with a gamma chunk of 1.0: values 0, 1, 256, 65535.
static std::string deepPicture() {
    static const unsigned char bytes[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
        0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x10, 0x00, 0x00, 0x00, 0x00, 0x07,
        0x4d, 0x8e, 0xbb, 0x00, 0x00, 0x00, 0x04, 0x67, 0x41, 0x4d, 0x41, 0x00, 0x01, 0x86, 0xa0,
        0x31, 0xe8, 0x96, 0x5f, 0x00, 0x00, 0x00, 0x10, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63,
        0x60, 0x60, 0x60, 0x60, 0x04, 0xc2, 0xff, 0xff, 0x01, 0x03, 0x11, 0x02, 0x01, 0xda, 0xe7,
        0xa3, 0x7f, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    return std::string(reinterpret_cast<const char*>(bytes), sizeof bytes);
}

TEST_CASE("sixteen bits are kept whole and no gamma is applied", "[image]") {
    const HeightImage heights = decodeHeightPng(deepPicture(), "f");
    REQUIRE(heights.values.size() == 4);
    CHECK(heights.values[0] == 0);
    CHECK(heights.values[1] == 1 / 65535.0f);
    CHECK(heights.values[2] == 256 / 65535.0f);
    CHECK(heights.values[3] == 1);
}

TEST_CASE("what is not a whole PNG is refused with its name", "[image]") {
    const test::Scratch folder;
    CHECK(messageOf([&] { readPng(folder / "none.png"); }).find("no such file") != std::string::npos);
    CHECK(messageOf([] { decodePng("", "f"); }) == "f: expected a PNG picture, found an empty file");
    CHECK(messageOf([] { decodePng("GIF89a and more", "f"); }) ==
          "f: expected a PNG picture, found something else");
    const std::string whole = encoded(noise(40, 40, 4));
    for (size_t length = 8; length < whole.size(); length += 7) {
        const std::string message = messageOf([&] { decodePng(whole.substr(0, length), "f"); });
        CHECK(message.starts_with("f: is a damaged PNG picture: "));
    }
}

TEST_CASE("damaged bytes give a picture or an error, never a crash", "[image]") {
    const std::string whole = encoded(noise(9, 9, 4)), deep = deepPicture();
    Random random(11);
    int refused = 0;
    for (int i = 0; i < 500; ++i) {
        std::string bytes = i % 2 ? whole : deep;
        for (int k = 0; k < 3; ++k)
            bytes[random.next() % bytes.size()] = static_cast<char>(random.next());
        refused += messageOf([&] { decodePng(bytes, "f"); }).empty() ? 0 : 1;
        messageOf([&] { decodeHeightPng(bytes, "f"); });
    }
    CHECK(refused > 400);
}

TEST_CASE("a picture that claims to be huge is refused before it is allocated", "[image]") {
    const auto claim = [](uint32_t side, uint32_t crc) {
        std::string bytes = "\x89PNG\r\n\x1a\n";
        const auto put = [&bytes](uint32_t v) {
            for (int shift = 24; shift >= 0; shift -= 8)
                bytes += static_cast<char>(v >> shift);
        };
        put(13);
        bytes += "IHDR";
        put(side);
        put(side);
        bytes += std::string("\x08\x06\0\0\0", 5);
        put(crc);
        put(0);
        bytes += "IDAT";
        put(0x35af061e);
        return bytes;
    };
    CHECK(messageOf([&] { decodePng(claim(20000, 0xe3704639), "f"); }) ==
          "f: expected a picture of at most 16384 x 16384, found 20000 x 20000");
    CHECK(messageOf([&] { decodePng(claim(16384, 0xa9c81084), "f"); }) ==
          "f: expected a picture of at most 67108864 texels (8192 x 8192), found 16384 x 16384");
    CHECK(messageOf([&] { decodePng(claim(8192, 0x72aaca59), "f"); }) ==
          "f: is a damaged PNG picture: the file ends too early");
}
