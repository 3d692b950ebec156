// A group that meets no colliders (fused/contact.glsl).
#include "step/no_table.glsl"
const bool areBounded = false;

void takeRadius(float scale, float lived)
{
}

vec4 footing(vec3 anchor, vec3 position, float time)
{
    return vec4(0.0, 0.0, 0.0, -1.0);
}

vec3 heldBy(vec3 n, float friction, vec3 acceleration)
{
    return acceleration;
}

void beginContact()
{
}

bool mayTouch()
{
    return false;
}

bool findContacts(int done)
{
    return false;
}

void resolveContacts(int done)
{
}
