// Pictures in memory, as PNG files, and as others' files (decode_image.cpp). Rows run from top to bottom,
// channels are interleaved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shoal {

constexpr int maxImageSide = 16384;  // texels; what current OpenGL implementations take as a texture
// 256 MiB as RGBA: deflate packs a thousand to one, so that a short file may hold any number of them.
constexpr size_t maxImageTexels = size_t{8192} * 8192;

// width * height * channels bytes: 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA.
struct Image {
    int width = 0, height = 0, channels = 4;
    std::vector<uint8_t> pixels;
};

// width * height values in [0, 1].
struct HeightImage {
    int width = 0, height = 0;
    std::vector<float> values;
};

// Any PNG as RGBA, eight bits a channel, as stored (no gamma conversion).
// Error: no such file, not a PNG, damaged or cut off, above maxImageSide a side or maxImageTexels in all.
Image readPng(const std::filesystem::path& path);
Image decodePng(const std::string& bytes, const std::string& file);
// Any PNG, JPEG, TGA, BMP, GIF or PSD as RGBA, eight bits a channel, as stored (stb_image). Error: none of
// these, damaged, or too large, as above.
Image decodeImage(const std::string& bytes, const std::string& file);
// How many texels such a picture has, by its head; 0: it is none.
size_t texelsOf(const std::string& bytes);
// A grey PNG of up to 16 bits at its full depth, as stored. Error: as above, or a picture in colour.
HeightImage readHeightPng(const std::filesystem::path& path);
HeightImage decodeHeightPng(const std::string& bytes, const std::string& file);

std::vector<std::byte> encodePng(const Image& image);
// Through writeFile: whole or not at all.
void writePng(const std::filesystem::path& path, const Image& image);

}  // namespace shoal
