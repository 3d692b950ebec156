// The watchdog: one word for all groups, 0 until a molecule's new state is not finite or too fast. Who it is, the CPU
// finds when it looks. Needs fused/state.glsl.
#ifdef WATCH
#include "physics/runaway.glsl"

layout(std430, binding = 3) writeonly buffer Alarm { uint alarm; };

void watch()
{
    uint speed = 0u;
    vec3 places = vec3(0.0);  // their sum is finite where all of them are
    for (int i = 0; i < VERTICES; ++i) {
        speed = max(speed, squareBits(v[i]));
        places += x[i];
    }
    if (isRunaway(speed, squareBits(places))) alarm = 1u;
}
#endif
