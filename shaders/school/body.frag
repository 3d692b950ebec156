// A texel a molecule of one group.
#include "school/body.glsl"
#include "state/numbered.glsl"

uniform int groupMolecules;
uniform int firstBody;  // of the group

layout(location = 0) out vec4 newBody[BODY_ELEMENTS];

void main()
{
    int molecule = ownNumber() - firstBody;
    if (molecule < 0 || molecule >= groupMolecules) discard;
    vec4 body[BODY_ELEMENTS];
    findBody(molecule, body);
    newBody = body;
}
