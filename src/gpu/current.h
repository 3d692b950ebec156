// Threads and the context that is current: it is so in one thread at a time.
#pragma once

namespace shoal::gpu {

// Afterwards no context is current in this thread, and another may make it so in its own
// (Context::makeCurrent).
void leaveCurrent();

}  // namespace shoal::gpu
