#include "gpu/handle.h"

namespace shoal::gpu {

void deleteTexture(GLuint id) {
    glDeleteTextures(1, &id);
}
void deleteFramebuffer(GLuint id) {
    glDeleteFramebuffers(1, &id);
}
void deleteRenderbuffer(GLuint id) {
    glDeleteRenderbuffers(1, &id);
}
void deleteBuffer(GLuint id) {
    glDeleteBuffers(1, &id);
}
void deleteVertexArray(GLuint id) {
    glDeleteVertexArrays(1, &id);
}
void deleteShader(GLuint id) {
    glDeleteShader(id);
}
void deleteProgram(GLuint id) {
    glDeleteProgram(id);
}
void deleteQuery(GLuint id) {
    glDeleteQueries(1, &id);
}

}  // namespace shoal::gpu
