// PNG through libpng, which reports failure by longjmp. A jump must not pass over C++ objects with
// destructors, so each function that calls setjmp only calls libpng, touches plain data through a
// reference, and tells success by its result; everything is allocated and freed by its callers.
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

// Shared by reading and writing: where libpng's complaint is kept.
struct Complaint {
    char text[200] = "";
};

void onError(png_structp png, png_const_charp message) {
    auto* complaint = static_cast<Complaint*>(png_get_error_ptr(png));
    std::snprintf(complaint->text, sizeof complaint->text, "%s", message);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

struct Decoder {
    const std::string& bytes;
    const Location location;
    size_t offset = 0;
    Complaint complaint;
    png_structp png = nullptr;
    png_infop info = nullptr;

    Decoder(const std::string& source, const std::string& file) : bytes(source), location{file} {
        constexpr size_t signature = 8;
        const auto* head = reinterpret_cast<png_const_bytep>(bytes.data());
        if (bytes.size() < signature || png_sig_cmp(head, 0, signature) != 0)
            throw Error(location, bytes.empty() ? "expected a PNG picture, found an empty file"
                                                : "expected a PNG picture, found something else");
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint, onError, onWarning);
        if (png) info = png_create_info_struct(png);
        if (!info) {
            png_destroy_read_struct(&png, &info, nullptr);
            throw std::bad_alloc();
        }
    }
    ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    [[noreturn]] void fail() const {
        throw Error(location, concat("is a damaged PNG picture: ", complaint.text));
    }
};

void onRead(png_structp png, png_bytep target, size_t count) {
    auto* decoder = static_cast<Decoder*>(png_get_io_ptr(png));
    if (count > decoder->bytes.size() - decoder->offset) png_error(png, "the file ends too early");
    std::memcpy(target, decoder->bytes.data() + decoder->offset, count);
    decoder->offset += count;
}

bool readInfo(Decoder& decoder) {
    if (setjmp(png_jmpbuf(decoder.png))) return false;
    png_set_read_fn(decoder.png, &decoder, onRead);
    png_set_user_limits(decoder.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // checkSize says it better
    png_read_info(decoder.png, decoder.info);
    return true;
}

bool askForColor(Decoder& decoder) {
    if (setjmp(png_jmpbuf(decoder.png))) return false;
    png_set_expand(decoder.png);
    png_set_scale_16(decoder.png);
    png_set_gray_to_rgb(decoder.png);
    png_set_add_alpha(decoder.png, 0xff, PNG_FILLER_AFTER);
    png_set_interlace_handling(decoder.png);
    png_read_update_info(decoder.png, decoder.info);
    return true;
}

bool askForHeight(Decoder& decoder) {
    if (setjmp(png_jmpbuf(decoder.png))) return false;
    if (png_get_bit_depth(decoder.png, decoder.info) < 8) png_set_expand_gray_1_2_4_to_8(decoder.png);
    png_set_strip_alpha(decoder.png);
    png_set_interlace_handling(decoder.png);
    png_read_update_info(decoder.png, decoder.info);
    return true;
}

bool readRows(Decoder& decoder, png_bytepp rows) {
    if (setjmp(png_jmpbuf(decoder.png))) return false;
    png_read_image(decoder.png, rows);
    png_read_end(decoder.png, nullptr);
    return true;
}

void checkSize(const Decoder& decoder) {
    const size_t width = png_get_image_width(decoder.png, decoder.info);
    const size_t height = png_get_image_height(decoder.png, decoder.info);
    if (width > maxImageSide || height > maxImageSide)
        throw Error(decoder.location, concat("expected a picture of at most ", maxImageSide, " x ",
                                             maxImageSide, ", found ", width, " x ", height));
    if (width * height > maxImageTexels)
        throw Error(decoder.location, concat("expected a picture of at most ", maxImageTexels,
                                             " texels (8192 x 8192), found ", width, " x ", height));
    // Deflate packs at most 1032 to 1: a short file that claims more is cut off, and need not be allocated.
    if (png_get_rowbytes(decoder.png, decoder.info) * height / 1032 > decoder.bytes.size())
        throw Error(decoder.location, "is a damaged PNG picture: the file ends too early");
}

std::vector<uint8_t> readPixels(Decoder& decoder) {
    const size_t height = png_get_image_height(decoder.png, decoder.info);
    const size_t rowBytes = png_get_rowbytes(decoder.png, decoder.info);
    std::vector<uint8_t> pixels(rowBytes * height);
    std::vector<png_bytep> rows(height);
    for (size_t y = 0; y < height; ++y)
        rows[y] = pixels.data() + y * rowBytes;
    if (!readRows(decoder, rows.data())) decoder.fail();
    return pixels;
}

struct Encoder {
    const Image& image;
    std::vector<std::byte> bytes;
    std::exception_ptr exception;
    Complaint complaint;
    png_structp png = nullptr;
    png_infop info = nullptr;

    explicit Encoder(const Image& source) : image(source) {
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &complaint, onError, onWarning);
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

bool writeImage(Encoder& encoder, const uint8_t* const* rows) {
    constexpr int types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                             PNG_COLOR_TYPE_RGB_ALPHA};
    if (setjmp(png_jmpbuf(encoder.png))) return false;
    png_set_write_fn(encoder.png, &encoder, onWrite, onFlush);
    png_set_IHDR(encoder.png, encoder.info, png_uint_32(encoder.image.width),
                 png_uint_32(encoder.image.height), 8, types[encoder.image.channels - 1], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(encoder.png, 4);  // frames are many: speed before size
    png_write_info(encoder.png, encoder.info);
    png_write_image(encoder.png, const_cast<png_bytepp>(rows));
    png_write_end(encoder.png, nullptr);
    return true;
}

}  // namespace

Image decodePng(const std::string& bytes, const std::string& file) {
    Decoder decoder(bytes, file);
    if (!readInfo(decoder)) decoder.fail();
    checkSize(decoder);
    if (!askForColor(decoder)) decoder.fail();
    Image image;
    image.width = static_cast<int>(png_get_image_width(decoder.png, decoder.info));
    image.height = static_cast<int>(png_get_image_height(decoder.png, decoder.info));
    image.pixels = readPixels(decoder);
    return image;
}

HeightImage decodeHeightPng(const std::string& bytes, const std::string& file) {
    Decoder decoder(bytes, file);
    if (!readInfo(decoder)) decoder.fail();
    checkSize(decoder);
    if (png_get_color_type(decoder.png, decoder.info) & PNG_COLOR_MASK_COLOR)
        throw Error(decoder.location, "expected a grey PNG picture of 8 or 16 bits, found one in colour");
    if (!askForHeight(decoder)) decoder.fail();

    HeightImage image;
    image.width = static_cast<int>(png_get_image_width(decoder.png, decoder.info));
    image.height = static_cast<int>(png_get_image_height(decoder.png, decoder.info));
    const bool deep = png_get_bit_depth(decoder.png, decoder.info) == 16;
    const std::vector<uint8_t> pixels = readPixels(decoder);
    image.values.resize(size_t(image.width) * size_t(image.height));
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
    Encoder encoder(image);
    std::vector<const uint8_t*> rows(size_t(image.height));
    for (size_t y = 0; y < rows.size(); ++y)
        rows[y] = image.pixels.data() + y * rowBytes;
    if (!writeImage(encoder, rows.data())) {
        if (encoder.exception) std::rethrow_exception(encoder.exception);
        throw Error(concat("a picture of ", image.width, " x ", image.height,
                           " cannot be made a PNG: ", encoder.complaint.text));
    }
    return std::move(encoder.bytes);
}

void writePng(const std::filesystem::path& path, const Image& image) {
    const std::vector<std::byte> bytes = encodePng(image);
    writeFile(path, std::span<const std::byte>(bytes));
}

}  // namespace shoal
