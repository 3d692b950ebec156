// The watchdog in fragments: what is fine is discarded and nothing is written: a query tells whether anything was left.
// Needs fused/lane.glsl.
#include "fused/watch.glsl"

void main()
{
    int molecule = ownMolecule();
    loadState(molecule);
    if (!taken()) discard;
    if (!runsAway()) discard;
}
