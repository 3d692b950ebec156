// Normals of the state as it is; nothing moves. Needs fused/lane.glsl or fused/group.glsl.
#include "fused/normals.glsl"

void main()
{
    int molecule = ownMolecule();
    loadState(molecule);
    writeNormals(molecule);
}
