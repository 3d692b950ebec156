// A buffer read as texels: texelFetch(samplerBuffer, i) is bytes 16 i to 16 i + 15 as four floats; with the
// other formats a usamplerBuffer reads whole numbers. Where a shader cannot have a storage buffer, or reads
// better through the texture cache.
#pragma once

#include <cstddef>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/handle.h"

namespace shoal::gpu {

// Names the format of a texel: samplerBuffer reads the first, usamplerBuffer the others.
enum class Texel { float4, uint4, uint2, uint1 };

class BufferTexture {
  public:
    BufferTexture() = default;
    // Borrows the buffer, which must outlive it. `offset` and `bytes` are multiples of a texel's; bytes 0: up
    // to the end. A part of the buffer needs OpenGL 4.3, and an offset that is a multiple of the context's
    // textureBufferAlignment (a contract). Error: more texels than the context allows; says how many.
    BufferTexture(Context& context, const Buffer& buffer, const char* label, size_t offset = 0,
                  size_t bytes = 0, Texel texel = Texel::float4);
    BufferTexture(Context& context, const Buffer& buffer, Texel texel, const char* label)
        : BufferTexture(context, buffer, label, 0, 0, texel) {}
    // Throws the Error of too many texels before there is a buffer.
    static void checkTexels(const ContextInfo& info, size_t texels, const char* label);

    void bind(int unit) const;

    GLuint id() const { return handle_.id(); }
    size_t texels() const { return texels_; }
    explicit operator bool() const { return bool(handle_); }

  private:
    Handle<deleteTexture> handle_;
    size_t texels_ = 0;
};

}  // namespace shoal::gpu
