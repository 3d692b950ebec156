// Makes what shaders wrote into storage buffers visible to later commands, which OpenGL does not do by
// itself. Needs OpenGL 4.3, like the shaders that write.
#pragma once

#include <initializer_list>

namespace shoal::gpu {

enum class Barrier {
    textureFetch,  // reading through samplers, buffer textures among them
    storage,       // reading and writing storage buffers
    command,       // Program::dispatchIndirect
    draw,          // indirect draws
    bufferUpdate,  // Buffer::update, download and copyTo; these ask for it themselves
};

// Before the command that reads, naming how it reads.
void barrier(std::initializer_list<Barrier> readers);

}  // namespace shoal::gpu
