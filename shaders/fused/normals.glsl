// Writes the normals of the molecule as it is. Needs storeNormals() of fused/lane.glsl or fused/group.glsl.
void writeNormals(int molecule)
{
    for (int i = 0; i < VERTICES; ++i) {
        probe[i] = x[i];
    }
    surfaceNormals();
    storeNormals(molecule);
}
