// What every group of a plan shares and no frame changes: the topology of the molecules, and the samples of
// grids and height fields. Layout: compile/plan.h.
#pragma once

#include "compile/plan.h"
#include "gpu/texture.h"

namespace shoal {

struct Tables {
    gpu::Texture topology, samples;

    Tables(gpu::Context& context, const Plan& plan);
};

}  // namespace shoal
