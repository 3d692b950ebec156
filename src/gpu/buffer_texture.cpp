#include "gpu/buffer.h"

#include "core/contract.h"
#include "core/error.h"

namespace shoal::gpu {

struct TexelFormat {
    GLenum internal;
    size_t bytes;
};

static TexelFormat formatOf(Texel texel) {
    static constexpr TexelFormat formats[] = {
        {GL_RGBA32F, 16}, {GL_RGBA32UI, 16}, {GL_RG32UI, 8}, {GL_R32UI, 4}};
    return formats[size_t(texel)];
}

BufferTexture::BufferTexture(Context& context, const Buffer& buffer, const char* label, size_t offset,
                             size_t bytes, Texel texel) {
    const auto [internal, texelBytes] = formatOf(texel);
    EXPECTS(buffer && offset < buffer.bytes() && bytes <= buffer.bytes() - offset);
    if (bytes == 0) bytes = buffer.bytes() - offset;
    const bool whole = bytes == buffer.bytes();
    EXPECTS(offset % texelBytes == 0 && bytes % texelBytes == 0);
    EXPECTS((whole || context.info().atLeast(4, 3)) && "a part of a buffer needs OpenGL 4.3");
    EXPECTS((whole || offset % size_t(context.info().textureBufferAlignment) == 0) && "see ContextInfo");
    texels_ = bytes / texelBytes;
    checkTexels(context.info(), texels_, label);
    GLuint id = 0;
    glGenTextures(1, &id);
    handle_ = Handle<deleteTexture>(id);
    glBindTexture(GL_TEXTURE_BUFFER, id);
    if (whole) {
        glTexBuffer(GL_TEXTURE_BUFFER, internal, buffer.id());
    } else {
        glTexBufferRange(GL_TEXTURE_BUFFER, internal, buffer.id(), static_cast<GLintptr>(offset),
                         static_cast<GLsizeiptr>(bytes));
    }
    labelObject(context, GL_TEXTURE, id, label);
}

void BufferTexture::checkTexels(const ContextInfo& info, size_t texels, const char* label) {
    const auto most = static_cast<size_t>(info.maxBufferTexels);
    if (texels <= most) return;
    throw Error(concat("buffer texture \"", label, "\" of ", texels,
                       " texels is too large: this context allows ", most));
}

void BufferTexture::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_BUFFER, id());
}

}  // namespace shoal::gpu
