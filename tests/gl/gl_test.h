// The context and the path that the tests of OpenGL share.
#pragma once

#include "compile/path.h"
#include "gpu/context.h"

// The one context of the process: SHOAL_TEST_CONTEXT=egl|osmesa|window, egl when it is not set. Current when
// a test begins; a test that makes others current puts it back.
shoal::gpu::Context& testContext();
// Whether programs with the same arithmetic leave the same bits: compilers of GPUs contract and reorder sums
// (docs/testing.md tells what else devices may differ in).
inline bool keepsBits() {
    return testContext().info().software;
}
// The path that simulations are tested on: SHOAL_TEST_PATH=fused|fragments|ping-pong, else what the context
// can do.
shoal::Path testPath();
