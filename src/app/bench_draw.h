// The pictures that `shoal bench` draws.
#pragma once

#include "bench/runner.h"

namespace shoal::app {

constexpr int pictureWidth = 640, pictureHeight = 360;

// Borrows the context.
bench::DrawMaker drawMaker(gpu::Context& context);

}  // namespace shoal::app
