#include "gpu/platform.h"

namespace shoal::gpu {

// A global, because OpenGL's "current context" is one, and because glXGetProcAddressARB and the OpenGL 1.1
// functions (gpu/forward.cpp) have no argument that could carry it.
static CurrentLoader current;

const CurrentLoader& currentLoader() {
    return current;
}

void setCurrentLoader(Loader load, bool isWindow) {
    if (load == current.load && isWindow == current.isWindow) return;
    current.load = load;
    current.isWindow = isWindow;
    ++current.generation;
}

}  // namespace shoal::gpu
