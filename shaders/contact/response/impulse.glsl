// The impulse of a contact as one of its two spheres has it, and its two parts, in which a step keeps it and leaves it to the next.
const int NO_PART = 0;    // the contact takes no part in the response
const int IMPACT = 1;
const int PERSISTENT = 2;  // it is remembered
const int REPEATED = 3;    // an impact like one in the step before

struct ContactImpulse {
    vec3 impulse;      // on this slot's sphere, N s
    float multiplier;  // kg m, how far it pushes the two apart
    bool sticks;       // or else slides
    vec3 anchor;       // m, from the other's centre to this one's when they began to stick
    float start;       // N s, the impulse with which the step began
    int kind;
};

vec4 firstPart(ContactImpulse c)
{
    return vec4(c.impulse, c.sticks ? c.multiplier : -max(c.multiplier, 1e-30));
}

vec4 secondPart(ContactImpulse c)
{
    float kind = c.kind == IMPACT ? 0.0 : c.kind == NO_PART ? -1.0 : -2.0;
    return vec4(c.anchor, c.kind == PERSISTENT ? c.start + 1e-20 : kind);
}

ContactImpulse impulseFrom(vec4 first, vec4 second)
{
    int kind = second.w > 0.0 ? PERSISTENT : second.w == 0.0 ? IMPACT : second.w > -1.5 ? NO_PART : REPEATED;
    return ContactImpulse(first.xyz, abs(first.w), first.w >= 0.0, second.xyz, second.w, kind);
}

// Whether a step has begun with something that the contact carries.
bool isLoaded(ContactImpulse begun)
{
    return begun.kind == PERSISTENT && begun.start > 1e-19;
}

// The same contact as the other sphere has it.
ContactImpulse mirrored(ContactImpulse c)
{
    c.impulse = -c.impulse;
    c.anchor = -c.anchor;
    return c;
}

ContactImpulse noImpulse(int kind)
{
    return ContactImpulse(vec3(0.0), 0.0, true, vec3(0.0), 0.0, kind);
}
