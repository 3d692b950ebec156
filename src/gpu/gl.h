// The one place that includes an OpenGL header: GLEW 2.2, core profile, 3.3 is the floor. It adds owners of
// OpenGL's objects, and names of objects and calls for debuggers.
#pragma once

#include <utility>

#include <GL/glew.h>

namespace shoal::gpu {

class Context;
struct ContextInfo;

inline constexpr auto deleteTexture = [](GLuint id) { glDeleteTextures(1, &id); };
inline constexpr auto deleteFramebuffer = [](GLuint id) { glDeleteFramebuffers(1, &id); };
inline constexpr auto deleteRenderbuffer = [](GLuint id) { glDeleteRenderbuffers(1, &id); };
inline constexpr auto deleteBuffer = [](GLuint id) { glDeleteBuffers(1, &id); };
inline constexpr auto deleteVertexArray = [](GLuint id) { glDeleteVertexArrays(1, &id); };
inline constexpr auto deleteShader = [](GLuint id) { glDeleteShader(id); };
inline constexpr auto deleteProgram = [](GLuint id) { glDeleteProgram(id); };
inline constexpr auto deleteQuery = [](GLuint id) { glDeleteQueries(1, &id); };

// Owns an object: moves, never copies, deletes at the end.
template <void (*remove)(GLuint)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    explicit Handle(PFNGLGENBUFFERSPROC generate) { generate(1, &id_); }  // such as glGenTextures
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0u)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0u);
        }
        return *this;
    }
    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    void reset() {
        if (id_ != 0) remove(id_);
        id_ = 0;
    }

  private:
    GLuint id_ = 0;
};

// The texture unit at which textures are made and filled, the last of the 48 that OpenGL 3.3 promises: what
// programs read stays at theirs.
inline constexpr int editUnit = 47;
void bindToEdit(GLenum target, GLuint texture);

// A named bracket around OpenGL calls, which debuggers and profilers show. Does nothing below OpenGL 4.3.
class DebugGroup {
  public:
    DebugGroup(const ContextInfo& info, const char* name);
    ~DebugGroup();
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;

  private:
    bool open_ = false;
};

// Sets the name of an object in debuggers, cut where it is long; `type` such as GL_TEXTURE. Does nothing
// below OpenGL 4.3 or for an empty name.
void labelObject(const Context& context, GLenum type, GLuint id, const char* label);

}  // namespace shoal::gpu
