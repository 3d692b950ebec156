// A solver that goes on from nothing but places and velocities (fused/bdf2.glsl has more).
vec3 dx[VERTICES];
vec3 dv[VERTICES];
const float noHistory = 0.0;

#define DRIFT(acceleration, beyond) Drift(driftOfStep.x, driftOfStep.y, driftOfStep.z, acceleration)

void forgetHistory()
{
}

vec3 wayBeyond(vec3 moved, vec3 gained, vec3 ended)
{
    return vec3(0.0);
}

bool changeHistory(vec3 shift, vec3 change, inout vec3 displacement, inout vec3 gained, vec3 ended)
{
    return false;
}
