// Contact with a single collider that stands still and is not thin, in the words of contact with several (step/joint_contact.glsl).
#include "step/no_table.glsl"
const bool collidersMove = false;
const bool areBounded = false;

float margin(vec3 anchor, vec3 position, vec3 velocity, float step, float time)
{
    return -1.0;
}

Contact collideAll(vec3 anchor, vec3 position, vec3 velocity, vec3 drifted, vec3 gravity, Drift drift, float time)
{
    return collideAll(anchor, position, velocity, drift);
}
