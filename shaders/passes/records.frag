// records: once a frame, per molecule: the anchor follows the molecule, and pins may be released.
// Positions are moved to the new anchor by the frame's first advect, from the same shift.
#include "state/textures.glsl"
#include "physics/anchor.glsl"
#include "passes/springs.glsl"
#include "physics/random.glsl"

uniform float springTime;     // s since the frame's start
uniform float releaseForce;   // N: above this pull on a pin, all pins of the molecule are released
uniform float releaseChance;  // in this frame
uniform int frame;

layout(location = 0) out vec4 newRecord;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    int molecule = (texel.y - firstRecordRow) * 1024 + texel.x;
    vec4 record = texelFetch(records, texel, 0);
    if (!isPadding(molecule)) {
        record.xyz += anchorShift(texelFetch(positions, stateTexel(0, molecule), 0).xyz);
        if (RELEASE && record.w < 0.5) {
            float pull = 0.0;
            for (int v = 0; v < vertexCount; ++v)
                if (inertia(v).y > 0.5) pull = max(pull, length(springForces(v, molecule, springTime)));
            uint seed = uint(texelFetch(constants, texel, 0).x);
            if (isReleased(pull, releaseForce, seed, frame, releaseChance)) record.w = 1.0;
        }
    }
    newRecord = record;
}
