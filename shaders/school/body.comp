// A lane a molecule of one group.
#include "school/body.glsl"

layout(local_size_x = 64) in;

uniform int partMolecules;
uniform int firstBody;  // of the part

layout(std430) writeonly buffer Bodies { vec4 bodies[]; };

void main()
{
    int molecule = min(int(gl_GlobalInvocationID.x), partMolecules - 1);
    vec4 body[BODY_ELEMENTS];
    findBody(molecule, body);
    for (int e = 0; e < BODY_ELEMENTS; ++e) bodies[BODY_ELEMENTS * (firstBody + molecule) + e] = body[e];
}
