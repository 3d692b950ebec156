uniform UINTS effectiveCounts;  // by slot, as bits (contact/prepare.glsl)

// Among how many contacts what a sphere gives way is shared; one that rests gives none. 0: neither it nor its body touches another.
float shareOf(int slot, Sphere sphere)
{
    return sphere.rests ? 1.0 : uintBitsToFloat(fetch(effectiveCounts, slot).x);
}
