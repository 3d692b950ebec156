#include "gpu/gl.h"

#include <string_view>

#include "gpu/context.h"

namespace shoal::gpu {

// Any context takes labels of 255 bytes, and debug messages in practice: names come from files, and a longer
// one would be an error of OpenGL.
static GLsizei lengthOf(std::string_view text) {
    constexpr size_t most = 255;
    size_t length = text.size();
    if (length > most) {
        length = most;
        const auto continues = [&](size_t place) {
            return (static_cast<unsigned char>(text[place]) & 0xC0) == 0x80;
        };
        while (length > 0 && continues(length))  // not within a character of UTF-8
            --length;
    }
    return static_cast<GLsizei>(length);
}

void bindToEdit(GLenum target, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(editUnit));
    glBindTexture(target, texture);
}

DebugGroup::DebugGroup(const ContextInfo& info, const char* name) : open_(info.atLeast(4, 3)) {
    if (open_) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, lengthOf(name), name);
}

DebugGroup::~DebugGroup() {
    if (open_) glPopDebugGroup();
}

void labelObject(const Context& context, GLenum type, GLuint id, const char* label) {
    if (context.info().atLeast(4, 3) && label != nullptr && *label != '\0')
        glObjectLabel(type, id, lengthOf(label), label);
}

}  // namespace shoal::gpu
