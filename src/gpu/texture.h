// A two-dimensional texture, or several layers of one. Rows are bottom first, as OpenGL has them; data is
// packed without padding.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "gpu/context.h"
#include "gpu/gl.h"

namespace shoal::gpu {

// Name, and what one texel is in memory when it is uploaded or read back:
//   rgba32f   4 floats          rgba16f   4 half floats     rgba8, srgb8a8   4 bytes
//   r32f      1 float           rg16f     2 half floats
//   rgb10a2   3 numbers from 0 to 1 in units of 1/1023, 10 bits each
//   rgba32ui  4 uint32          rg32ui    2 uint32          r32ui            1 uint32
//   (these three are read through usampler2D)
//   depth24   1 uint32 (0..2^32-1 is 0..1)                  depth32f         1 float
enum class Format {
    rgba32f,
    rgba16f,
    rg16f,
    rgba8,
    srgb8a8,
    rgba32ui,
    rg32ui,
    r32ui,
    r32f,
    rgb10a2,
    depth24,
    depth32f
};

size_t texelBytes(Format format);  // of the data, as above
bool isDepth(Format format);
GLenum internalFormat(Format format);
const char* name(Format format);

class Texture {
  public:
    Texture() = default;
    // NEAREST and CLAMP_TO_EDGE, one level, contents undefined. `label` is for errors and debuggers.
    // Error: larger than the context allows, or out of memory; says how much it would take.
    // `layers`: 0, or as many that one sampler2DArray reads and that are drawn into at once.
    Texture(Context& context, Format format, int width, int height, const char* label, int layers = 0);

    // Binds itself to the unit that is active. A rectangle of texels; `bytes` must be w * h *
    // texelBytes(format). Counted in the context's traffic.
    void upload(Traffic::Kind kind, int x, int y, int w, int h, const void* data, size_t bytes,
                int layer = 0);
    void download(Traffic::Kind kind, int x, int y, int w, int h, void* data, size_t bytes,
                  int layer = 0) const;

    // LINEAR filter; with mipmaps (made from what is there now, trilinear); with REPEAT instead of CLAMP.
    void setLinear(bool mipmaps = false, bool repeat = false);
    // For sampler2DShadow: comparison LEQUAL, LINEAR, and everything outside is lit.
    void setShadowCompare();

    void bind(int unit) const;
    GLuint id() const { return handle_.id(); }
    int width() const { return width_; }
    int height() const { return height_; }
    int layers() const { return layers_; }  // 0: not layered
    Format format() const { return format_; }
    const std::string& label() const { return label_; }
    size_t bytes() const {
        return size_t(width_) * size_t(height_) * size_t(layers_ > 0 ? layers_ : 1) * texelBytes(format_);
    }
    explicit operator bool() const { return bool(handle_); }

  private:
    GLenum target() const { return layers_ > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D; }

    Handle<deleteTexture> handle_;
    Traffic* traffic_ = nullptr;  // the context's, which outlives the texture and does not move
    Format format_ = Format::rgba8;
    int width_ = 0, height_ = 0, layers_ = 0;
    std::string label_;
};

// A three-dimensional texture that is written once, REPEAT and LINEAR.
class VolumeTexture {
  public:
    VolumeTexture() = default;
    // `data`: texelBytes(format) for each texel, x fastest. Counted as parameters. Error: larger than the
    // context allows. OutOfMemory: says how much it would take.
    VolumeTexture(Context& context, Format format, const glm::ivec3& size, std::span<const std::byte> data,
                  const char* label);

    void bind(int unit) const;
    GLuint id() const { return handle_.id(); }
    explicit operator bool() const { return bool(handle_); }

  private:
    Handle<deleteTexture> handle_;
};

}  // namespace shoal::gpu
