// How a workgroup stores the normals (fused/group.glsl).
void storeNormals(int molecule)
{
    int first = firstElement(molecule, POSITION_ELEMENTS);
    waitForGroup();
    for (int i = 0; i < VERTICES; ++i) {
        share(PLACES, i, normal[i]);
    }
    waitForGroup();
    for (int e = row(); e < POSITION_ELEMENTS; e += ROWS) newNormals[first + e * BLOCK] = stored(sharedElement(PLACES, e));
}
