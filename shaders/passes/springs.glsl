// The force of all springs around a vertex.
#include "state/textures.glsl"

uniform float stiffnessFactor;
uniform float dampingFactor;
uniform float predictTime;   // s: leapfrog's force uses the velocity v + a h/2; 0 at the start of a frame
#ifdef VERLET
uniform float substep;  // h, s
#endif
#ifdef MUSCLES
uniform vec4 muscleAngles[MUSCLES];  // rad, when the frame begins, four frequencies each
#endif

int sprungMolecule;  // whose springs are asked for
float scale;         // of its rest lengths
float phase;         // of its muscles, rad

#define springPlace(vertex) texelFetch(positions, stateTexel(vertex, sprungMolecule), 0).xyz
#ifdef SPRING_DAMPING
#define springVelocity(vertex) kickedVelocity(stateTexel(vertex, sprungMolecule), predictTime)
#else
#define springVelocity(vertex) vec3(0.0)
#endif
#define springInverseMass(vertex) inertia(vertex).x
#include "step/gather_springs.glsl"

// Returns it in N. springTime: s since the frame's start, for muscles.
vec3 springForces(int vertex, int molecule, float springTime)
{
    vec4 constant = texelFetch(constants, recordTexel(molecule), 0);
    sprungMolecule = molecule;
    scale = constant.y;
    phase = constant.z;
    return springForceOn(vertex, springTime);
}
