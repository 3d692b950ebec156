// What the tests of OpenGL share.
#pragma once

#include "gpu/context.h"

// The one context of the process: SHOAL_TEST_CONTEXT=egl|osmesa|window, egl when it is not set. Current when
// a test begins; a test that makes others current puts it back.
shoal::gpu::Context& testContext();
