// A named bracket around OpenGL calls, which debuggers and profilers show. Nothing below OpenGL 4.3.
#pragma once

#include "gpu/context.h"
#include "gpu/gl.h"

namespace shoal::gpu {

class DebugGroup {
  public:
    DebugGroup(const ContextInfo& info, const char* name);
    DebugGroup(const Context& context, const char* name) : DebugGroup(context.info(), name) {}
    ~DebugGroup();
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;

  private:
    bool open_ = false;
};

// The name of an object in debuggers, cut where it is long; `type` such as GL_TEXTURE. Nothing below 4.3 or
// for an empty name.
void labelObject(const Context& context, GLenum type, GLuint id, const char* label);

}  // namespace shoal::gpu
