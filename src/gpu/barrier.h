// What later commands must see of what shaders wrote into storage buffers. OpenGL orders nothing by itself
// there. Needs OpenGL 4.3, like the shaders that write.
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
