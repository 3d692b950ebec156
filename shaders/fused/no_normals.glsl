// Nothing is drawn that asks for normals (fused/normals.glsl).
void writeNormals(int molecule)
{
}
