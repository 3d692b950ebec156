#include "exchange/animation_texture.h"

#include <algorithm>
#include <cstdio>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <half.h>
#include <png.h>
#include <unistd.h>
#include <Eigen/Dense>

#include "core/error.h"
#include "exchange/exr_stream.h"

namespace shoal::exchange {

namespace {

constexpr size_t floatsEach = 7;  // of a column in the spool

// Writes rows of float RGBA in [0, 1], from the top.
class RowWriter {
  public:
    virtual ~RowWriter() = default;
    virtual void write(const std::vector<float>& row) = 0;
    virtual void finish() = 0;
};

// libpng jumps over what it was called from: what it may jump over holds nothing that must be destroyed.
class PngRows : public RowWriter {
  public:
    PngRows(const std::filesystem::path& target, size_t width, size_t height, size_t channels)
        : target_(target), file_(target) {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) throw Error("out of memory for a picture");
        calls([&] {
            png_set_write_fn(png_, this, onWrite, [](png_structp) {});
            png_set_IHDR(png_, info_, png_uint_32(width), png_uint_32(height), 16,
                         channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                         PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
            // A vertex is near where it was, so the row above says most; more time gains little more.
            png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
            png_set_compression_level(png_, 1);
            png_write_info(png_, info_);
        });
        bytes_.resize(width * channels * 2);
    }
    ~PngRows() override { png_destroy_write_struct(&png_, &info_); }
    PngRows(const PngRows&) = delete;
    PngRows& operator=(const PngRows&) = delete;

    void write(const std::vector<float>& row) override {
        for (size_t i = 0; i < row.size(); ++i) {
            const auto value = uint32_t(std::clamp(row[i], 0.0f, 1.0f) * 65535.0f + 0.5f);
            bytes_[2 * i] = png_byte(value >> 8);
            bytes_[2 * i + 1] = png_byte(value & 255);
        }
        calls([&] { png_write_row(png_, bytes_.data()); });
    }
    void finish() override {
        calls([&] { png_write_end(png_, nullptr); });
        file_.finish();
    }

  private:
    template <typename Work>
    void calls(const Work& work) {
        if (setjmp(png_jmpbuf(png_)) == 0) {
            work();
            return;
        }
        if (failure_) std::rethrow_exception(failure_);
        throw diskFull(target_);
    }
    static void onWrite(png_structp png, png_bytep data, size_t count) {
        auto* self = static_cast<PngRows*>(png_get_io_ptr(png));
        bool written = false;
        try {
            self->file_.write(data, count);
            written = true;
        } catch (...) {
            self->failure_ = std::current_exception();
        }
        if (!written) png_error(png, "not written");
    }

    std::filesystem::path target_;
    FileWriter file_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::vector<png_byte> bytes_;
    std::exception_ptr failure_;
};

class ExrRows : public RowWriter {
  public:
    ExrRows(const std::filesystem::path& target, size_t width, size_t height, size_t channels, bool halves)
        : stream_(target), channels_(channels), half_(halves) {
        Imf::Header header{int(width), int(height)};
        header.compression() = Imf::ZIP_COMPRESSION;
        for (size_t c = 0; c < channels; ++c)
            header.channels().insert(names[c], Imf::Channel(type()));
        file_.emplace(stream_, header);
        halves_.resize(width * channels);
    }
    void write(const std::vector<float>& row) override {
        Imf::FrameBuffer buffer;
        const size_t each = half_ ? sizeof(half) : sizeof(float);
        std::copy(row.begin(), row.end(), halves_.begin());
        const char* first =
            half_ ? reinterpret_cast<const char*>(halves_.data()) : reinterpret_cast<const char*>(row.data());
        // Rows have no stride: each is written from the same place.
        for (size_t c = 0; c < channels_; ++c)
            buffer.insert(names[c], Imf::Slice(half_ ? Imf::HALF : Imf::FLOAT,
                                               const_cast<char*>(first) + c * each, channels_ * each, 0));
        file_->setFrameBuffer(buffer);
        file_->writePixels(1);
    }
    void finish() override {
        file_.reset();
        stream_.finish();
    }

  private:
    Imf::PixelType type() const { return half_ ? Imf::HALF : Imf::FLOAT; }

    static constexpr const char* names[] = {"R", "G", "B", "A"};
    ExrStream stream_;
    size_t channels_;
    bool half_;
    std::optional<Imf::OutputFile> file_;
    std::vector<half> halves_;
};

std::unique_ptr<RowWriter> rowWriter(const std::filesystem::path& target, size_t width, size_t height,
                                     size_t channels, TexelFormat format) {
    if (format == TexelFormat::png16) return std::make_unique<PngRows>(target, width, height, channels);
    return std::make_unique<ExrRows>(target, width, height, channels, format == TexelFormat::halfFloat);
}

}  // namespace

AnimationTexture::AnimationTexture(const std::filesystem::path& target, size_t columns)
    : target_(target), columns_(columns), low_(INFINITY), high_(-INFINITY) {
    checkWritable(target);
    spool_ = unnamedFile(target);
}

void AnimationTexture::add(const AnimationFrame& frame) {
    row_.resize(columns_ * floatsEach);
    float* texel = row_.data();
    for (size_t i = 0; i < columns_; ++i, texel += floatsEach) {
        const glm::vec3 x = frame.offsets[i];
        const glm::vec4 t = frame.turns[i];
        low_ = glm::min(low_, x);
        high_ = glm::max(high_, x);
        texel[0] = x.x, texel[1] = x.y, texel[2] = x.z;
        texel[3] = t.x, texel[4] = t.y, texel[5] = t.z, texel[6] = t.w;
    }
    ::fseeko(spool_.get(), off_t(frames_ * row_.size() * sizeof(float)), SEEK_SET);
    if (std::fwrite(row_.data(), sizeof(float), row_.size(), spool_.get()) != row_.size() ||
        std::fflush(spool_.get()) != 0)
        throw diskFull(target_);
    ++frames_;
}

void AnimationTexture::read(size_t i) const {
    row_.resize(columns_ * floatsEach);
    ::fseeko(spool_.get(), off_t(i * row_.size() * sizeof(float)), SEEK_SET);
    if (std::fread(row_.data(), sizeof(float), row_.size(), spool_.get()) != row_.size())
        throw diskFull(target_);
}

AnimationFrame AnimationTexture::frame(size_t i) const {
    read(i);
    AnimationFrame out;
    for (size_t c = 0; c < columns_; ++c) {
        const float* texel = row_.data() + c * floatsEach;
        out.offsets.emplace_back(texel[0], texel[1], texel[2]);
        out.turns.emplace_back(texel[3], texel[4], texel[5], texel[6]);
    }
    return out;
}

void AnimationTexture::write(TexelFormat format, bool rigid) {
    // A coordinate that never changes stays what it is: an empty span would say nothing.
    const glm::vec3 span = glm::max(high_ - low_, glm::vec3(1e-9f));
    high_ = low_ + span;
    const size_t channels = rigid ? 4 : 3;
    const std::unique_ptr<RowWriter> rows = rowWriter(target_, columns_, 2 * frames_, channels, format);
    std::vector<float> row(channels * columns_, 1.0f);
    for (size_t f = 0; f < frames_; ++f) {
        read(f);
        for (size_t c = 0; c < columns_; ++c)
            for (int k = 0; k < 3; ++k)
                row[channels * c + size_t(k)] = (row_[floatsEach * c + size_t(k)] - low_[k]) / span[k];
        rows->write(row);
    }
    for (size_t f = 0; f < frames_; ++f) {
        read(f);
        for (size_t c = 0; c < columns_; ++c)
            for (size_t k = 0; k < channels; ++k)
                row[channels * c + k] = 0.5f + 0.5f * row_[floatsEach * c + 3 + k];
        rows->write(row);
    }
    rows->finish();
}

RigidMotion rigidMotion(std::span<const glm::dvec3> rest, std::span<const glm::dvec3> places) {
    RigidMotion out;
    const double count = double(rest.size());
    for (size_t i = 0; i < rest.size(); ++i) {
        out.restMiddle += rest[i] / count;
        out.middle += places[i] / count;
    }
    // Horn's symmetric matrix, whose largest eigenvector is the quaternion (w, x, y, z).
    glm::dmat3 s(0);  // s[b][a]: sum of rest_a place_b
    for (size_t i = 0; i < rest.size(); ++i)
        s += glm::outerProduct(rest[i] - out.restMiddle, places[i] - out.middle);
    const auto m = [&](int a, int b) { return s[b][a]; };
    Eigen::Matrix4d n;
    n << m(0, 0) + m(1, 1) + m(2, 2), m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0),  //
        m(1, 2) - m(2, 1), m(0, 0) - m(1, 1) - m(2, 2), m(0, 1) + m(1, 0), m(2, 0) + m(0, 2),   //
        m(2, 0) - m(0, 2), m(0, 1) + m(1, 0), m(1, 1) - m(0, 0) - m(2, 2), m(1, 2) + m(2, 1),   //
        m(0, 1) - m(1, 0), m(2, 0) + m(0, 2), m(1, 2) + m(2, 1), m(2, 2) - m(0, 0) - m(1, 1);
    const Eigen::Vector4d q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(n).eigenvectors().col(3);
    out.turn = glm::dquat(q(0), q(1), q(2), q(3));
    for (size_t i = 0; i < rest.size(); ++i) {
        const double off = glm::distance(places[i], out.middle + out.turn * (rest[i] - out.restMiddle));
        out.worst = std::max(out.worst, off);
        out.squares += off * off;
    }
    return out;
}

}  // namespace shoal::exchange
