// Contact of the molecule's vertices with the colliders, after a substep's drift. Needs fused/step.glsl and
// generated/colliders.glsl.
//
// A solver with COMING_KICK still owes the velocity half a kick of the springs: contact acts on the velocity that
// will have it, or friction would cancel only half of what the springs do in a step.
bool touches[VERTICES];

// Marks the vertices that are inside a collider; whether there is one.
bool findContacts()
{
    bool found = false;
    for (int i = 0; i < VERTICES; ++i) {
        touches[i] = !isHeld(pinned[i]) && clearance(anchor, x[i]) < 0.0;
        found = found || touches[i];
    }
    return found;
}

void respondTo(inout vec3 position, inout vec3 velocity, vec3 kick)
{
    vec3 whole = velocity + kick;
    Contact c = collideAll(anchor, position, whole, gravity, Drift(driftOfStep.x, driftOfStep.y, driftOfStep.z));
    position = c.position;
    if (c.velocity != whole) velocity = c.velocity - kick;
}

#ifdef CONTACT_ONE_BY_ONE
// One vertex after the other, as many as touch: for molecules of many vertices, of which few touch at a time.
void resolveContacts()
{
    int k = VERTICES;
    for (int i = 0; i < VERTICES; ++i) {
        if (touches[i]) k = min(k, i);
    }
    while (k < VERTICES) {
        vec3 position = vec3(0.0);
        vec3 velocity = vec3(0.0);
        vec3 kick = vec3(0.0);
        for (int i = 0; i < VERTICES; ++i) {
            position = i == k ? x[i] : position;
            velocity = i == k ? v[i] : velocity;
#ifdef COMING_KICK
            kick = i == k ? comingKick[i] : kick;
#endif
        }
        respondTo(position, velocity, kick);
        int next = VERTICES;
        for (int i = 0; i < VERTICES; ++i) {
            x[i] = i == k ? position : x[i];
            v[i] = i == k ? velocity : v[i];
            next = touches[i] && i > k ? min(next, i) : next;
        }
        k = next;
    }
}
#else
void resolveContacts()
{
    for (int i = 0; i < VERTICES; ++i) {
        if (touches[i]) {
            vec3 kick = vec3(0.0);
#ifdef COMING_KICK
            kick = comingKick[i];
#endif
            respondTo(x[i], v[i], kick);
        }
    }
}
#endif
