// Contact of the molecule's vertices with a single collider that stands still and is not thin, after a substep's drift. Needs fused/answers.glsl
// and generated/colliders.glsl.
#include "fused/clear_around.glsl"

// The surfaces that findContacts() found, where one costs more to look up than to keep, as that of a height field does.
vec4 seen[VERTICES];

// Returns whether a vertex that is not held lies inside the collider, after `done` substeps.
bool findContacts(int done)
{
    float least = 1e30;
    for (int i = 0; i < VERTICES; ++i) {
        touchPosition[i] = x[i];
    }
    for (int k = 0; k < VERTICES; ++k) {
        if (keepsSurface) seen[k] = surfaceAt(anchor, touchPosition[k]);
        if (!isHeld(pinned[k])) least = min(least, keepsSurface ? seen[k].w : clearance(anchor, touchPosition[k], 0.0));
    }
    return mayAnswer() && least < 0.0;
}

// Resolves the contacts of all vertices. One that does not touch changes only where the molecule answers as a
// rigid body (RIGID_IMPACT).
void resolveContacts(int done)
{
    beginAnswers();
    for (int k = 0; k < VERTICES; ++k) {
        if (!isHeld(pinned[k])) {
            vec4 surface = seen[k];
            if (!keepsSurface) surface = surfaceAt(anchor, touchPosition[k]);
            take(k, answerTo(surface, touchPosition[k], touchVelocity[k], DRIFT_OF(k)));
        }
    }
    answerAsBody();
    acceptAnswers(contactTime(done));
}
