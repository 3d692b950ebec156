// The number of an OpenGL object, owned by one place: moves, never copies, deletes at the end.
#pragma once

#include <utility>

#include "gpu/gl.h"

namespace shoal::gpu {

void deleteTexture(GLuint id);
void deleteFramebuffer(GLuint id);
void deleteRenderbuffer(GLuint id);
void deleteBuffer(GLuint id);
void deleteVertexArray(GLuint id);
void deleteShader(GLuint id);
void deleteProgram(GLuint id);
void deleteQuery(GLuint id);

template <void (*remove)(GLuint)>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
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

}  // namespace shoal::gpu
