// Contact of the molecule's vertices with the colliders, after a substep's drift. Needs fused/step.glsl and
// generated/colliders.glsl.
//
// A solver with COMING_KICK still owes the velocity half a kick of the springs: contact acts on the velocity that
// will have it, or friction would cancel only half of what the springs do in a step.

// Whether a vertex that is not held lies inside a collider.
bool findContacts()
{
    float least = 1e30;
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) least = min(least, clearance(anchor, x[i]));
    }
    return least < 0.0;
}

void respondTo(inout vec3 position, inout vec3 velocity, vec3 kick)
{
    vec3 whole = velocity + kick;
    Contact c = collideAll(anchor, position, whole, gravity, Drift(driftOfStep.x, driftOfStep.y, driftOfStep.z));
    position = c.position;
    velocity = c.velocity != whole ? c.velocity - kick : velocity;
}

// All at once; nothing happens to those that do not touch.
void resolveContacts()
{
    for (int i = 0; i < VERTICES; ++i) {
        vec3 kick = vec3(0.0);
#ifdef COMING_KICK
        kick = comingKick[i];
#endif
        if (!isHeld(pinned[i])) respondTo(x[i], v[i], kick);
    }
}
