// A CPU rasteriser's worker threads, left alone, share one core half of the time: up to twice the noise.
#pragma once

namespace shoal::measure {

// Ties the process's llvmpipe workers to one core each, in turn. Returns how many there were.
int pinRasteriserThreads();

}  // namespace shoal::measure
