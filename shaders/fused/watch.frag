// The watchdog in fragments. A texel is discarded unless its molecule has run away, and nothing is written: a query tells
// whether a texel was left.
// Needs fused/lane.glsl.
#include "fused/watch.glsl"

void main()
{
    int molecule = ownMolecule();
    loadState(molecule);
    if (!taken()) discard;
    if (!runsAway()) discard;
}
