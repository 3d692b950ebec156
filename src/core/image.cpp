// PNG through libpng, which reports failure by longjmp. A jump must not pass over C++ objects with
// destructors, so what Png::calls runs only calls libpng and touches plain data through references;
// everything is allocated and freed by its callers.
#include "core/image.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <exception>

#include <png.h>

#include "core/contract.h"
#include "core/error.h"
#include "core/file.h"

namespace shoal {

namespace {

// Reading and writing share this state.
struct Png {
    char complaint[200] = "";  // libpng's
    png_structp png = nullptr;
    png_infop info = nullptr;

    // False: libpng complained.
    template <typename Work>
    bool calls(const Work& work) {
        if (setjmp(png_jmpbuf(png))) return false;
        work();
        return true;
    }
};

void onError(png_structp png, png_const_charp message) {
    auto* to = static_cast<Png*>(png_get_error_ptr(png));
    std::snprintf(to->complaint, sizeof to->complaint, "%s", message);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep target, size_t count);

struct Decoder : Png {
    const std::string& bytes;
    const Location location;
    size_t offset = 0;

    Decoder(const std::string& source, const std::string& file) : bytes(source), location{file} {
        constexpr size_t signature = 8;
        const auto* head = reinterpret_cast<png_const_bytep>(bytes.data());
        if (bytes.size() < signature || png_sig_cmp(head, 0, signature) != 0)
            throw Error(location, bytes.empty() ? "expected a PNG picture, found an empty file"
                                                : "expected a PNG picture, found something else");
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, static_cast<Png*>(this), onError, onWarning);
        if (png) info = png_create_info_struct(png);
        if (!info) {
            png_destroy_read_struct(&png, &info, nullptr);
            throw std::bad_alloc();
        }
    }
    ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    size_t width() const { return png_get_image_width(png, info); }
    size_t height() const { return png_get_image_height(png, info); }

    template <typename Work>
    void need(const Work& work) {
        if (!calls(work)) throw Error(location, "is a damaged PNG picture: ", complaint);
    }

    void readInfo() {
        need([&] {
            png_set_read_fn(png, this, onRead);
            png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // what follows says it better
            png_read_info(png, info);
        });
        if (width() > maxImageSide || height() > maxImageSide)
            throw Error(location, "expected a picture of at most ", maxImageSide, " x ", maxImageSide,
                        ", found ", width(), " x ", height());
        if (width() * height() > maxImageTexels)
            throw Error(location, "expected a picture of at most ", maxImageTexels,
                        " texels (8192 x 8192), found ", width(), " x ", height());
        // Deflate packs at most 1032 to 1: a short file that claims more is cut off, and need not be
        // allocated.
        if (png_get_rowbytes(png, info) * height() / 1032 > bytes.size())
            throw Error(location, "is a damaged PNG picture: the file ends too early");
    }

    std::vector<uint8_t> readPixels() {
        const size_t rowBytes = png_get_rowbytes(png, info);
        std::vector<uint8_t> pixels(rowBytes * height());
        std::vector<png_bytep> rows(height());
        for (size_t y = 0; y < rows.size(); ++y)
            rows[y] = pixels.data() + y * rowBytes;
        need([&] {
            png_read_image(png, rows.data());
            png_read_end(png, nullptr);
        });
        return pixels;
    }
};

void onRead(png_structp png, png_bytep target, size_t count) {
    auto* decoder = static_cast<Decoder*>(png_get_io_ptr(png));
    if (count > decoder->bytes.size() - decoder->offset) png_error(png, "the file ends too early");
    std::memcpy(target, decoder->bytes.data() + decoder->offset, count);
    decoder->offset += count;
}

struct Encoder : Png {
    std::vector<std::byte> bytes;
    std::exception_ptr exception;

    Encoder() {
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, static_cast<Png*>(this), onError, onWarning);
        if (png) info = png_create_info_struct(png);
        if (!info) {
            png_destroy_write_struct(&png, &info);
            throw std::bad_alloc();
        }
    }
    ~Encoder() { png_destroy_write_struct(&png, &info); }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // False when out of memory: an exception must not travel through libpng.
    bool append(const std::byte* data, size_t count) noexcept {
        try {
            bytes.insert(bytes.end(), data, data + count);
            return true;
        } catch (...) {
            exception = std::current_exception();
            return false;
        }
    }
};

void onWrite(png_structp png, png_bytep data, size_t count) {
    auto* encoder = static_cast<Encoder*>(png_get_io_ptr(png));
    if (!encoder->append(reinterpret_cast<const std::byte*>(data), count)) png_error(png, "out of memory");
}

void onFlush(png_structp) {}

}  // namespace

Image decodePng(const std::string& bytes, const std::string& file) {
    Decoder decoder(bytes, file);
    decoder.readInfo();
    decoder.need([&] {
        png_set_expand(decoder.png);
        png_set_scale_16(decoder.png);
        png_set_gray_to_rgb(decoder.png);
        png_set_add_alpha(decoder.png, 0xff, PNG_FILLER_AFTER);
        png_set_interlace_handling(decoder.png);
        png_read_update_info(decoder.png, decoder.info);
    });
    return {static_cast<int>(decoder.width()), static_cast<int>(decoder.height()), 4, decoder.readPixels()};
}

HeightImage decodeHeightPng(const std::string& bytes, const std::string& file) {
    Decoder decoder(bytes, file);
    decoder.readInfo();
    if (png_get_color_type(decoder.png, decoder.info) & PNG_COLOR_MASK_COLOR)
        throw Error(decoder.location, "expected a grey PNG picture of 8 or 16 bits, found one in colour");
    decoder.need([&] {
        if (png_get_bit_depth(decoder.png, decoder.info) < 8) png_set_expand_gray_1_2_4_to_8(decoder.png);
        png_set_strip_alpha(decoder.png);
        png_set_interlace_handling(decoder.png);
        png_read_update_info(decoder.png, decoder.info);
    });
    HeightImage image{static_cast<int>(decoder.width()), static_cast<int>(decoder.height()), {}};
    const bool deep = png_get_bit_depth(decoder.png, decoder.info) == 16;
    const std::vector<uint8_t> pixels = decoder.readPixels();
    image.values.resize(decoder.width() * decoder.height());
    for (size_t i = 0; i < image.values.size(); ++i)  // PNG is big-endian
        image.values[i] = deep ? static_cast<float>(pixels[2 * i] * 256 + pixels[2 * i + 1]) / 65535.0f
                               : static_cast<float>(pixels[i]) / 255.0f;
    return image;
}

Image readPng(const std::filesystem::path& path) {
    return decodePng(readFile(path), path.string());
}

HeightImage readHeightPng(const std::filesystem::path& path) {
    return decodeHeightPng(readFile(path), path.string());
}

std::vector<std::byte> encodePng(const Image& image) {
    EXPECTS(image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4);
    const size_t rowBytes = size_t(image.width) * size_t(image.channels);
    EXPECTS(image.pixels.size() == rowBytes * size_t(image.height));
    constexpr int types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                             PNG_COLOR_TYPE_RGB_ALPHA};
    const int type = types[image.channels - 1];
    Encoder encoder;
    std::vector<const uint8_t*> rows(size_t(image.height));
    for (size_t y = 0; y < rows.size(); ++y)
        rows[y] = image.pixels.data() + y * rowBytes;
    const bool written = encoder.calls([&] {
        png_set_write_fn(encoder.png, &encoder, onWrite, onFlush);
        png_set_IHDR(encoder.png, encoder.info, png_uint_32(image.width), png_uint_32(image.height), 8, type,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        // Frames are many: speed before size.
        png_set_compression_level(encoder.png, 2);
        png_set_filter(encoder.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
        png_write_info(encoder.png, encoder.info);
        png_write_image(encoder.png, const_cast<png_bytepp>(rows.data()));
        png_write_end(encoder.png, nullptr);
    });
    if (!written) {
        if (encoder.exception) std::rethrow_exception(encoder.exception);
        throw Error("a picture of ", image.width, " x ", image.height,
                    " cannot be made a PNG: ", encoder.complaint);
    }
    return std::move(encoder.bytes);
}

void writePng(const std::filesystem::path& path, const Image& image) {
    writeFile(path, std::span<const std::byte>(encodePng(image)));
}

}  // namespace shoal
