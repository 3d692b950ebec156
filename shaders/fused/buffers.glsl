// A lane of a compute shader has a molecule of the buffers.
#include "fused/store.glsl"

int ownMolecule()
{
    return int(gl_GlobalInvocationID.x);
}
