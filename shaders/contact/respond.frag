// respond: a texel a slot, a stage of contact/respond.glsl.
#include "contact/respond.glsl"

#ifdef CROWD
layout(location = 0) out uvec4 newCrowd;
#else
layout(location = 0) out vec4 newImpulse;
#if defined(BEGIN) || defined(RELAX)
layout(location = 1) out vec4 keptPushes[LIST / 4];
#elif defined(SETTLE)
layout(location = 1) out vec4 newShift;
#endif
#endif

void main()
{
    int slot = ownNumber();
    int listed = slot < count ? min(int(fetch(counts, slot).x), LIST) : 0;
    if (listed == 0) discard;
#ifndef CROWD
    for (int i = 0; i < LIST / 4; ++i) newPushes[i] = vec4(0.0);
#endif
    respond(slot, listed);
#ifdef CROWD
    newCrowd = uvec4(floatBitsToUint(largestEigenvalue(normalSum)), 0u, 0u, 0u);
#else
    newImpulse = vec4(impulse, 0.0);
#if defined(BEGIN) || defined(RELAX)
    keptPushes = newPushes;
#elif defined(SETTLE)
    newShift = shiftOf();
#endif
#endif
}
