#include "gpu/debug_group.h"

namespace shoal::gpu {

DebugGroup::DebugGroup(const ContextInfo& info, const char* name) : open_(info.atLeast(4, 3)) {
    if (open_) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name);
}

DebugGroup::~DebugGroup() {
    if (open_) glPopDebugGroup();
}

void labelObject(const Context& context, GLenum type, GLuint id, const char* label) {
    if (context.info().atLeast(4, 3) && label != nullptr && *label != '\0')
        glObjectLabel(type, id, -1, label);
}

}  // namespace shoal::gpu
