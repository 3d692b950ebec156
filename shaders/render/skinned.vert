// A corner of a molecule's skin (src/molecule/skin.h): gl_InstanceID is the molecule, gl_VertexID the skin's
// vertex, which depends on SKIN_WEIGHTS (1 to 8) of the molecule's vertices. Its two tangents move as it
// does, so that its normal turns and shears with the molecule. Set by C++, true or false: SKIN_OFFSETS, some vertex has
// offsets along the molecule's normal. Variants are those of render/drawn.glsl.

#include "state/molecule.glsl"
#include "render/drawn.glsl"
#include "render/grown.glsl"
#include "render/instance_color.glsl"

layout(location = 0) in vec2 cornerUv;
layout(location = 1) in vec3 offsets;  // along the molecule's normal: of the place, m; of the tangents
// The vertex, its weight for the place, and its weights for the two tangents.
layout(location = 2) in mat4 influences;      // of the first four
layout(location = 6) in mat4 moreInfluences;  // and of four more

uniform mat4 toClip;

out vec2 uv;
out vec3 place;
out vec3 normal;
flat out vec3 color;

vec4 influenceAt(int k)
{
    return k < 4 ? influences[min(k, 3)] : moreInfluences[max(k - 4, 0)];
}

// Sums over the influences, of places from the first one's: what is far from the eye keeps its digits.
struct Sums
{
    vec3 place, along, across, normal;
};

void addInfluence(inout Sums sums, int molecule, vec3 first, vec4 influence)
{
    int vertex = int(influence.x);
    vec3 from = drawnPlace(molecule, vertex) - first;
    sums.place += influence.y * from;
    sums.along += influence.z * from;
    sums.across += influence.w * from;
    if (SKIN_OFFSETS) sums.normal += influence.y * vertexNormal(molecule, vertex);
}

void main()
{
    int molecule;
    bool drawn = findDrawn(gl_InstanceID, gl_InstanceID + 1, molecule);
    vec3 first = drawnPlace(molecule, int(influenceAt(0).x));
    Sums sums = Sums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    for (int k = 0; k < SKIN_WEIGHTS; ++k) addInfluence(sums, molecule, first, influenceAt(k));
    if (SKIN_OFFSETS) {
        float size = length(sums.normal);
        vec3 outward = size > 0.0 ? sums.normal / size : vec3(0.0);
        sums.place += offsets.x * outward;
        sums.along += offsets.y * outward;
        sums.across += offsets.z * outward;
    }
    vec3 vertex = first + sums.place;
    uv = cornerUv;
    place = vertex;
    vec3 turned = cross(sums.along, sums.across);
    float area = length(turned);
    normal = area > 1e-6 ? turned / area : vec3(0.0);  // zero: the triangle's own is taken
    color = instanceColor(molecule);
    gl_Position = toClip * vec4(vertex, 1.0);
    if (!drawn) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
}
