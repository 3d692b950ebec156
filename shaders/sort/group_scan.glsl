// Sums over a workgroup of LANES lanes in shared memory [Hillis 1986].
#include "sort/wait.glsl"

shared uint scanned[LANES];

// The sum of the values of the lanes before this one; `total` of all. Every lane must call it.
uint sumBefore(uint value, out uint total)
{
    int lane = int(gl_LocalInvocationID.x);
    scanned[lane] = value;
    waitForGroup();
    for (int reach = 1; reach < LANES; reach *= 2) {
        uint other = lane >= reach ? scanned[lane - reach] : 0u;
        waitForGroup();
        scanned[lane] += other;
        waitForGroup();
    }
    total = scanned[LANES - 1];
    uint before = scanned[lane] - value;
    waitForGroup();  // before the next call writes
    return before;
}
