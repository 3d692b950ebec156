// Wraps a framebuffer that passes draw into. Borrows its textures, which must outlive it; owns its
// renderbuffers.
#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "gpu/context.h"
#include "gpu/gl.h"
#include "gpu/texture.h"

namespace shoal::gpu {

// A texture to draw into: one layer of it, or each.
struct ColorTarget {
    const Texture* texture;
    int layer;  // negative: each of them, in order

    ColorTarget(const Texture* drawnInto, int oneLayer = -1) : texture(drawnInto), layer(oneLayer) {}
};

class Framebuffer {
  public:
    Framebuffer() = default;
    // Colour textures become draw buffers 0, 1, … in order; `depth` may be null; there may be no colours.
    // Error: this driver cannot draw into such a set; says into which.
    Framebuffer(Context& context, const std::vector<ColorTarget>& colors, const Texture* depth = nullptr,
                const char* label = "");
    // Renderbuffers with several samples a pixel (reduced to what the context has), to be blitted.
    static Framebuffer multisampled(Context& context, Format color, bool depth, int samples, int width,
                                    int height, const char* label);

    void bind() const { bind(0, 0, width_, height_); }  // viewport: all of it
    void bind(int x, int y, int width, int height) const;

    // Copies the first colour, resolving samples. Sizes must be equal.
    void blitTo(const Framebuffer& other) const { blit(other, GL_COLOR_BUFFER_BIT); }
    // Copies the depth, one sample of each pixel, into the lower left of one as large or larger. Formats must
    // be equal.
    void blitDepthTo(const Framebuffer& other) const { blit(other, GL_DEPTH_BUFFER_BIT); }
    // Copies the first colour into a framebuffer that is not ours. LINEAR where the sizes differ and there is
    // 1 sample.
    void blitTo(GLuint framebuffer, int width, int height) const;

    GLuint id() const { return handle_.id(); }
    int width() const { return width_; }
    int height() const { return height_; }
    int samples() const { return samples_; }  // 1: not multisampled
    explicit operator bool() const { return bool(handle_); }

  private:
    void blit(const Framebuffer& other, GLbitfield what) const;
    void checkComplete(const std::string& attachments) const;

    Handle<deleteFramebuffer> handle_;
    Handle<deleteRenderbuffer> colorStorage_, depthStorage_;
    int width_ = 0, height_ = 0, samples_ = 1;
    std::string label_;
};

// Framebuffers that draw into some textures, made once for each combination.
class Framebuffers {
  public:
    explicit Framebuffers(Context& context) : context_(&context) {}
    const Framebuffer& into(const std::vector<ColorTarget>& colors);

  private:
    struct Made {
        std::vector<std::pair<GLuint, int>> layers;
        Framebuffer framebuffer;
    };
    Context* context_;
    std::deque<Made> made_;  // references to its elements stay valid
};

// Passes write every texel of what they draw into as it is, whatever a renderer left switched on.
void drawPlainly();

// Draws vertices without attributes, which shaders make of gl_VertexID, in the context that is current. Three
// cover the target (shaders/passes/fullscreen.vert).
void drawVertices(int count, GLenum primitive = GL_TRIANGLES);

}  // namespace shoal::gpu
