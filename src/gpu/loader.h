// Where OpenGL's functions come from at the moment; inside `gpu` only.
#pragma once

namespace shoal::gpu {

using Procedure = void (*)();
using Loader = Procedure (*)(const char* name);

struct CurrentLoader {
    Loader load = nullptr;    // null: no context of ours is current
    bool isWindow = false;    // GLX or EGL below GLFW: the process's own libGL serves it
    unsigned generation = 1;  // counts the changes, so that pointers found earlier can be thrown away
};

const CurrentLoader& currentLoader();
void setCurrentLoader(Loader load, bool isWindow);

}  // namespace shoal::gpu
