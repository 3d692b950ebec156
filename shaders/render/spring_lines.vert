// A molecule's springs as lines, straight from the state, coloured by their strain. Set by C++, true or false: SCALED,
// instances differ in size.

#include "state/molecule.glsl"

layout(location = 0) in vec3 spring;  // x one end, y the other end (vertices), z rest length, m; alike at six corners

uniform mat4 toClip;
uniform int firstMolecule;
uniform float strainShown;  // at which a colour is full
uniform vec2 halfWidth;     // of a line, in clip space

out vec3 color;

void main()
{
    int molecule = firstMolecule + gl_InstanceID;
    int corner = gl_VertexID % 6;
    bool atStart = corner == 0 || corner == 1 || corner == 3;
    bool left = corner == 0 || corner == 3 || corner == 5;
    vec3 near = vertexPlace(molecule, int(spring.x)), far = vertexPlace(molecule, int(spring.y));
    float rest = spring.z * (SCALED ? moleculeScale(molecule) : 1.0);
    float strain = clamp((distance(near, far) / max(rest, 1e-9) - 1.0) / strainShown, -1.0, 1.0);
    vec3 full = strain > 0.0 ? vec3(2.2, 0.18, 0.05) : vec3(0.08, 0.3, 2.4);
    color = mix(vec3(0.16, 0.18, 0.14), full, abs(strain));
    // a little nearer than the surface that it lies in
    vec4 from = toClip * vec4(near * 0.998, 1.0), to = toClip * vec4(far * 0.998, 1.0);
    vec2 along = (to.xy / to.w - from.xy / from.w) / halfWidth;
    vec2 across = vec2(-along.y, along.x) / max(length(along), 1e-6) * halfWidth;
    gl_Position = atStart ? from : to;
    gl_Position.xy += (left ? across : -across) * gl_Position.w;
    if (!isAlive(molecule)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
}
