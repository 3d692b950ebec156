// The step tells that a state has run away (fused/watch.glsl).
#include "fused/watch.glsl"

layout(std430) buffer Alarm { uint alarm; };

void watch()
{
    if (runsAway()) alarm = uint(givenCounts.x) + 1u;
}

// Whether an earlier frame left a state that ran away.
bool comesTooLate()
{
    uint raised = alarm;
    return raised != 0u && raised != uint(givenCounts.x) + 1u;
}
