#include "gpu/texture.h"

#include <algorithm>

#include "core/contract.h"
#include "core/error.h"
#include "gpu/buffer.h"

namespace shoal::gpu {
namespace {

struct FormatRow {
    Format format;
    const char* name;
    GLenum internal, layout, type;
    size_t bytes;
};

constexpr FormatRow formatTable[] = {
    {Format::rgba32f, "rgba32f", GL_RGBA32F, GL_RGBA, GL_FLOAT, 16},
    {Format::rgba16f, "rgba16f", GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8},
    {Format::rg16f, "rg16f", GL_RG16F, GL_RG, GL_HALF_FLOAT, 4},
    {Format::rgba8, "rgba8", GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
    {Format::srgb8a8, "srgb8a8", GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4},
    {Format::rgba32ui, "rgba32ui", GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16},
    {Format::rg32ui, "rg32ui", GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8},
    {Format::r32ui, "r32ui", GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4},
    {Format::r32f, "r32f", GL_R32F, GL_RED, GL_FLOAT, 4},
    {Format::rgb10a2, "rgb10a2", GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4},
    {Format::depth24, "depth24", GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 4},
    {Format::depth32f, "depth32f", GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4},
};

const FormatRow& row(Format format) {
    const FormatRow& found = formatTable[static_cast<size_t>(format)];
    EXPECTS(found.format == format);
    return found;
}

// A framebuffer for one download; the one that was bound comes back.
struct ReadingFramebuffer {
    Handle<deleteFramebuffer> handle{glGenFramebuffers};
    GLint before = 0;

    ReadingFramebuffer() {
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, handle.id());
    }
    ~ReadingFramebuffer() { glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before)); }
};

}  // namespace

size_t texelBytes(Format format) {
    return row(format).bytes;
}
bool isDepth(Format format) {
    return row(format).layout == GL_DEPTH_COMPONENT;
}
GLenum internalFormat(Format format) {
    return row(format).internal;
}
const char* name(Format format) {
    return row(format).name;
}

Texture::Texture(Context& context, Format format, int width, int height, const char* label, int layers)
    : traffic_(&context.traffic()),
      format_(format),
      width_(width),
      height_(height),
      layers_(layers),
      label_(label) {
    EXPECTS(width > 0 && height > 0 && layers >= 0);
    const double mebibytes = double(bytes()) / (1 << 20);
    const std::string what =
        concat("texture \"", label, "\" of ", width, " x ", height, " texels (", mebibytes, " MiB)");
    const int largest = context.info().maxTextureSize;
    if (width > largest || height > largest)
        throw Error(concat(what, " is too large: this context allows ", largest, " x ", largest));
    context.checkErrors("before a texture is made");
    handle_ = Handle<deleteTexture>(glGenTextures);
    bindToEdit(target(), id());
    const FormatRow& storage = row(format);
    const auto internal = static_cast<GLint>(storage.internal);
    if (layers > 0)
        glTexImage3D(target(), 0, internal, width, height, layers, 0, storage.layout, storage.type, nullptr);
    else
        glTexImage2D(target(), 0, internal, width, height, 0, storage.layout, storage.type, nullptr);
    if (glGetError() != GL_NO_ERROR) throw OutOfMemory(what + " does not fit into memory");
    glTexParameteri(target(), GL_TEXTURE_MAX_LEVEL, 0);
    glTexParameteri(target(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(target(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(target(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(target(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    labelObject(context, GL_TEXTURE, id(), label);
}

void Texture::upload(Traffic::Kind kind, int x, int y, int w, int h, const void* data, size_t bytes,
                     int layer) {
    EXPECTS(x >= 0 && y >= 0 && w > 0 && h > 0 && x + w <= width_ && y + h <= height_);
    EXPECTS(bytes == size_t(w) * size_t(h) * texelBytes(format_) && layer < std::max(layers_, 1));
    const FormatRow& storage = row(format_);
    bindToEdit(target(), id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (layers_ > 0)
        glTexSubImage3D(target(), 0, x, y, layer, w, h, 1, storage.layout, storage.type, data);
    else
        glTexSubImage2D(target(), 0, x, y, w, h, storage.layout, storage.type, data);
    traffic_->countUpload(kind, bytes);
}

void Texture::download(Traffic::Kind kind, int x, int y, int w, int h, void* data, size_t bytes,
                       int layer) const {
    EXPECTS(x >= 0 && y >= 0 && w > 0 && h > 0 && x + w <= width_ && y + h <= height_);
    EXPECTS(bytes == size_t(w) * size_t(h) * texelBytes(format_));
    const FormatRow& storage = row(format_);
    const ReadingFramebuffer framebuffer;
    const GLenum attachment = isDepth(format_) ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0;
    if (layers_ > 0)
        glFramebufferTextureLayer(GL_READ_FRAMEBUFFER, attachment, id(), 0, layer);
    else
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, attachment, GL_TEXTURE_2D, id(), 0);
    glReadBuffer(isDepth(format_) ? GL_NONE : GL_COLOR_ATTACHMENT0);
    if (glCheckFramebufferStatus(GL_READ_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error("texture \"" + label_ +
                    "\" cannot be read back: this driver does not draw into its format");
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(x, y, w, h, storage.layout, storage.type, data);
    traffic_->countReadBack(kind, bytes);
}

void Texture::setLinear(bool mipmaps, bool repeat) {
    bindToEdit(target(), id());
    const GLint wrap = repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    glTexParameteri(target(), GL_TEXTURE_WRAP_S, wrap);
    glTexParameteri(target(), GL_TEXTURE_WRAP_T, wrap);
    glTexParameteri(target(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(target(), GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTexParameteri(target(), GL_TEXTURE_MAX_LEVEL, mipmaps ? 1000 : 0);
    if (mipmaps) glGenerateMipmap(target());
}

void Texture::setShadowCompare() {
    EXPECTS(isDepth(format_));
    bindToEdit(GL_TEXTURE_2D, id());
    const GLfloat lit[] = {1, 1, 1, 1};
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, lit);
}

void Texture::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(target(), id());
}

VolumeTexture::VolumeTexture(Context& context, Format format, const glm::ivec3& size,
                             std::span<const std::byte> data, const char* label) {
    const FormatRow& storage = row(format);
    const size_t texels = size_t(size.x) * size_t(size.y) * size_t(size.z);
    EXPECTS(texels > 0 && data.size() == texels * storage.bytes);
    const std::string what = concat("texture \"", label, "\" of ", size.x, " x ", size.y, " x ", size.z,
                                    " texels (", double(data.size()) / (1 << 20), " MiB)");
    const int largest = context.info().max3DTextureSize;
    if (std::max({size.x, size.y, size.z}) > largest)
        throw Error(concat(what, " is too large: this context allows ", largest, " a side"));
    context.checkErrors("before a texture is made");
    handle_ = Handle<deleteTexture>(glGenTextures);
    bindToEdit(GL_TEXTURE_3D, id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(storage.internal), size.x, size.y, size.z, 0,
                 storage.layout, storage.type, data.data());
    if (glGetError() != GL_NO_ERROR) throw OutOfMemory(what + " does not fit into memory");
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_3D, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(GL_TEXTURE_3D, wrap, GL_REPEAT);
    labelObject(context, GL_TEXTURE, id(), label);
    context.traffic().countUpload(Traffic::Kind::parameters, data.size());
}

void VolumeTexture::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_3D, id());
}

}  // namespace shoal::gpu
