#include "gpu/framebuffer.h"

#include <algorithm>

#include "core/contract.h"
#include "core/error.h"
#include "gpu/frame_record.h"

namespace shoal::gpu {

Framebuffer::Framebuffer(Context& context, const std::vector<ColorTarget>& colors, const Texture* depth,
                         const char* label)
    : label_(label) {
    EXPECTS(!colors.empty() || depth != nullptr);
    int drawn = 0;
    for (const ColorTarget& color : colors)
        drawn += color.layer < 0 ? std::max(color.texture->layers(), 1) : 1;
    if (drawn > context.info().maxColorAttachments)
        throw Error(concat("framebuffer \"", label, "\" draws into ", drawn,
                           " textures at once: this context allows ", context.info().maxColorAttachments));
    const Texture& first = colors.empty() ? *depth : *colors.front().texture;
    width_ = first.width();
    height_ = first.height();
    handle_ = Handle<deleteFramebuffer>(glGenFramebuffers);
    glBindFramebuffer(GL_FRAMEBUFFER, id());
    std::string attachments;
    std::vector<GLenum> drawBuffers;
    for (const ColorTarget& color : colors) {
        const Texture& texture = *color.texture;
        EXPECTS(texture.width() == width_ && texture.height() == height_ && !isDepth(texture.format()));
        EXPECTS(color.layer < std::max(texture.layers(), 1));
        const int from = std::max(color.layer, 0);
        const int end = color.layer < 0 ? std::max(texture.layers(), 1) : color.layer + 1;
        for (int layer = from; layer < end; ++layer) {
            const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawBuffers.size());
            if (texture.layers() > 0)
                glFramebufferTextureLayer(GL_FRAMEBUFFER, attachment, texture.id(), 0, layer);
            else
                glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.id(), 0);
            drawBuffers.push_back(attachment);
        }
        attachments += concat(attachments.empty() ? "" : " + ", name(texture.format()));
    }
    if (depth != nullptr) {
        EXPECTS(depth->width() == width_ && depth->height() == height_ && isDepth(depth->format()));
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->id(), 0);
        attachments += concat(attachments.empty() ? "" : " + ", name(depth->format()));
    }
    if (drawBuffers.empty()) {
        glDrawBuffer(GL_NONE);
        glReadBuffer(GL_NONE);
    } else {
        glDrawBuffers(static_cast<GLsizei>(drawBuffers.size()), drawBuffers.data());
    }
    checkComplete(attachments);
    labelObject(context, GL_FRAMEBUFFER, id(), label);
}

static Handle<deleteRenderbuffer> makeStorage(GLenum attachment, Format format, int samples, int width,
                                              int height) {
    Handle<deleteRenderbuffer> out(glGenRenderbuffers);
    glBindRenderbuffer(GL_RENDERBUFFER, out.id());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, internalFormat(format), width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, out.id());
    return out;
}

Framebuffer Framebuffer::multisampled(Context& context, Format color, bool depth, int samples, int width,
                                      int height, const char* label) {
    EXPECTS(width > 0 && height > 0 && samples > 0 && !isDepth(color));
    const int largest = context.info().maxTextureSize;
    if (width > largest || height > largest)
        throw Error(concat("a picture of ", width, " x ", height, " is too large: this context allows ",
                           largest, " x ", largest));
    context.checkErrors("before a framebuffer is made");
    Framebuffer out;
    out.label_ = label;
    out.width_ = width;
    out.height_ = height;
    out.samples_ = std::clamp(samples, 1, std::max(1, context.info().maxSamples));
    out.handle_ = Handle<deleteFramebuffer>(glGenFramebuffers);
    glBindFramebuffer(GL_FRAMEBUFFER, out.id());
    const int stored = out.samples_ > 1 ? out.samples_ : 0;  // 0 is OpenGL's word for not multisampled
    out.colorStorage_ = makeStorage(GL_COLOR_ATTACHMENT0, color, stored, width, height);
    if (depth) out.depthStorage_ = makeStorage(GL_DEPTH_ATTACHMENT, Format::depth24, stored, width, height);
    if (glGetError() == GL_OUT_OF_MEMORY) {
        const double bytes =
            double(width) * height * out.samples_ * double(texelBytes(color) + (depth ? 4 : 0));
        throw Error(concat("a picture of ", width, " x ", height, " with ", out.samples_,
                           " samples does not fit into memory: it takes ", bytes / (1 << 20), " MiB"));
    }
    out.checkComplete(concat(name(color), depth ? " + depth24" : "", " with ", out.samples_, " samples"));
    labelObject(context, GL_FRAMEBUFFER, out.id(), label);
    return out;
}

void Framebuffer::checkComplete(const std::string& attachments) const {
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    throw Error(concat(
        "framebuffer \"", label_, "\" (", attachments, ", ", width_, " x ", height_, ") cannot be had: ",
        status == GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT           ? "an attachment that cannot be drawn into"
        : status == GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT ? "nothing to draw into"
        : status == GL_FRAMEBUFFER_UNSUPPORTED ? "a combination of formats that this driver does not support"
        : status == GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE ? "different numbers of samples"
                                                          : "an incomplete framebuffer"));
}

void Framebuffer::bind(int x, int y, int width, int height) const {
    EXPECTS(x >= 0 && y >= 0 && x + width <= width_ && y + height <= height_);
    glBindFramebuffer(GL_FRAMEBUFFER, id());
    glViewport(x, y, width, height);
}

void Framebuffer::blit(const Framebuffer& other, GLbitfield what) const {
    const bool fits = width_ <= other.width_ && height_ <= other.height_;
    const bool same = width_ == other.width_ && height_ == other.height_;
    EXPECTS(same || (fits && what == GL_DEPTH_BUFFER_BIT));
    FrameRecord::add(what == GL_DEPTH_BUFFER_BIT ? "copy of depth" : "copy of light", {}, {}, {}, {});
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, other.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, what, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, other.id());
}

void Framebuffer::blitTo(GLuint framebuffer, int width, int height) const {
    const bool same = width == width_ && height == height_;
    EXPECTS(same || samples_ == 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                      same ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

const Framebuffer& Framebuffers::into(const std::vector<ColorTarget>& colors) {
    std::vector<std::pair<GLuint, int>> layers;
    for (const ColorTarget& color : colors)
        layers.emplace_back(color.texture->id(), color.layer);
    for (const Made& made : made_)
        if (made.layers == layers) return made.framebuffer;
    const char* label = colors.front().texture->label().c_str();
    made_.push_back({std::move(layers), Framebuffer(*context_, colors, nullptr, label)});
    return made_.back().framebuffer;
}

void drawPlainly() {
    for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_FRAMEBUFFER_SRGB})
        glDisable(state);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace shoal::gpu
