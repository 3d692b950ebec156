// The impacts that a slot has had in this step (contact/arrays.txt): nothing else of them counts where there are none.
#pragma reads impacts

const uint NEVER = 0x7f800000u;  // infinitely long ago
const uvec4 NO_IMPACT = uvec4(uvec3(0u), NEVER);

bool isStruck(int slot)
{
    return impactsAt(slot, 0).w != NEVER;
}

// For how long it has moved straight in this step, s.
float straightTimeOf(int slot)
{
    return min(uintBitsToFloat(impactsAt(slot, 0).w), stepTime);
}

// Whether entry e of its list is among them.
bool hasHit(int slot, int e)
{
    return (impactsAt(slot, 2)[e >> 5] >> uint(e & 31) & 1u) != 0u;
}

// The slot with which it had the last of them.
int lastHitOf(int slot)
{
    return int(impactsAt(slot, 1).w);
}
