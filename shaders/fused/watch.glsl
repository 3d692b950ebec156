// The watchdog: whether a molecule's new state is not finite or too fast. With compute one word for all groups holds
// 1 + the number of the frame (fused/alarm.glsl); in fragments a pass of its own asks (fused/watch.frag). Which
// molecule it was, the CPU finds in the state.
#include "fused/state.glsl"
#include "physics/runaway.glsl"

bool runsAway()
{
    uint speed = 0u;
    vec3 places = vec3(0.0);  // their sum is finite where all of them are
    for (int i = 0; i < VERTICES; ++i) {
        speed = max(speed, squareBits(v[i]));
        places += x[i];
    }
    return isRunaway(speed, squareBits(places));
}
