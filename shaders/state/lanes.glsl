// A pass over numbered elements, from `firstNumber` on: a lane of a compute shader has one, or a texel of a pass in fragments.
#include "state/numbered.glsl"

uniform int firstNumber;
uniform int numbers;  // how many

#ifdef TEXTURES
// Returns which of them this texel is for, from 0. Texels beside them are left as they are.
int ownLane()
{
    int lane = ownNumber() - firstNumber;
    if (lane < 0 || lane >= numbers) discard;
    return lane;
}

bool isBehindLast()
{
    return false;
}

void discardTexel()
{
    discard;
}
#else
layout(local_size_x = 64) in;

int ownNumber()
{
    return int(gl_GlobalInvocationID.x);
}

// Lanes behind the last repeat the last one's work.
int ownLane()
{
    return min(ownNumber(), numbers - 1);
}

bool isBehindLast()
{
    return ownNumber() >= numbers;
}

void discardTexel()
{
}
#endif
