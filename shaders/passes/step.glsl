// The numbers of a substep (src/simulate/step.h) that the passes which move vertices are given.
#include "state/textures.glsl"
#include "physics/anchor.glsl"

uniform sampler2D vertexNormals;
uniform float time;        // s, since the frame's start, of the substep's start
uniform float substep;     // h, s
uniform vec3 gravity;      // m/s^2
uniform float wind;        // factor on the fields
uniform vec2 decay;        // 1 - exp(-gamma h) across and along the surface
uniform vec2 phi;          // decay / gamma, h where gamma = 0
uniform vec2 dragRate;     // gamma, 1/s, across and along the surface
uniform int slips;         // not 0: drag is so heavy that positions drift by the new velocity alone
uniform bool moveAnchors;  // in the first substep: to where the records pass has just set them

#ifdef FIELDS
#include "generated/fields.glsl"
#endif
#include "step/advance.glsl"
#include "step/drag.glsl"

// Returns how far a molecule's anchor has moved, in m. `places`: where it was followed from.
vec3 anchorMove(sampler2D places, int molecule)
{
    if (ANCHORS_MOVE && moveAnchors) return anchorShift(texelFetch(places, stateTexel(0, molecule), 0).xyz);
    return vec3(0.0);
}
