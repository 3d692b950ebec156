#include "gpu/barrier.h"

#include "core/contract.h"
#include "gpu/gl.h"

namespace shoal::gpu {

static GLbitfield bit(Barrier reader) {
    switch (reader) {
    case Barrier::textureFetch:
        return GL_TEXTURE_FETCH_BARRIER_BIT;
    case Barrier::storage:
        return GL_SHADER_STORAGE_BARRIER_BIT;
    case Barrier::draw:
        return GL_COMMAND_BARRIER_BIT;
    case Barrier::command:
        return GL_COMMAND_BARRIER_BIT;
    default:
        return GL_BUFFER_UPDATE_BARRIER_BIT;
    }
}

void barrier(std::initializer_list<Barrier> readers) {
    GLbitfield bits = 0;
    for (const Barrier reader : readers)
        bits |= bit(reader);
    EXPECTS(glMemoryBarrier != nullptr && "needs OpenGL 4.3");
    glMemoryBarrier(bits);
}

}  // namespace shoal::gpu
