// Molecules that are not born and do not die (particles/age.glsl).
void growOlder(int molecule)
{
}
