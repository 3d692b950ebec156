// The fused step: reads each molecule once, runs all substeps of the frame, writes it once. Needs fused/lane.glsl or
// fused/group.glsl, and loadParameters() of src/simulate/fused_kernel.cpp.
#include "physics/anchor.glsl"
#include "step/cut_short.glsl"
#include "contact/rest/states.glsl"

// The anchor follows the molecule by steps of its lattice, exactly.
bool followAnchor()
{
    vec3 shift = anchorShift(firstPlace());
    for (int i = 0; i < VERTICES; ++i) {
        x[i] -= shift;
    }
    anchor += shift;
    return shift != vec3(0.0);
}

const int turnsLeft = LANE_A_VERTEX ? 64 : 0;  // that storing takes

// Whether the ways among many colliders took more turns of loops than they may, or all loops more than some of Mesa's CPU
// rasterisers take (mostSoftwareTurns in src/gpu/context.h).
bool loopsEndEarly()
{
    bool early = areTabled && turns > mostTurns;
    if (!isSoftware) return early;
    int taken = 0;
    do {  // Mesa does not write it out; a `for` or a `while` of it hangs the linker of 26.2
        ++taken;
    } while (taken <= substeps + turnsLeft);
    return early || taken <= substeps + turnsLeft;
}

uniform bool probes;     // whether anything other than contact acts differently than in the last step
vec3 gained[VERTICES];  // m/s, in a step from rest

void main()
{
    if (ISSUED_AHEAD && comesTooLate()) return;
    int molecule = ownMolecule();
    loadState(molecule);
    loadParameters();
    loadRecord(molecule);
#ifdef STEERED
    loadSteering(molecule);
#endif
    loadLoads(molecule);
    float mover = RESTS ? moverOf(molecule) : AWAKE;
    bool rests = RESTS && isResting(mover);
    bool probed = mover == COME_TO_REST || (RESTS && probes && rests);
    if (rests && !probed && !LANE_A_VERTEX) substeps = 0;
    bool isCutShort = MAY_BE_CUT && x[0] == cutShort();
    if (isCutShort && !LANE_A_VERTEX) substeps = 0;
    bool wasReleased = released;
    bool moved = ANCHORS_MOVE && followAnchor();
    takeRadius(scale, min((age + frameDuration) / max(span, 1e-9), 1.0));
    beginSolver();
    sampleFrame();
    run();
    finishSolver();
    if (MAY_BE_CUT) isCutShort = isCutShort || loopsEndEarly();
    // A molecule at rest is stored as it was, but with the velocities that it would gain: when these change,
    // contact/rest/rest.pass.glsl wakes it.
    if (rests) {
        for (int i = 0; i < VERTICES; ++i) {
            gained[i] = probed ? v[i] : vec3(0.0);
        }
        keepState(molecule);
        for (int i = 0; i < VERTICES; ++i) {
            v[i] = gained[i];
        }
        moved = false;
    }
    if (isCutShort) x[0] = cutShort();
    bool wasTaken = taken();
    growOlder(molecule);
    if (!wasTaken) {
        keepState(molecule);  // what has died stays as it was
        moved = false;
    }
    storeState(molecule);
    if (wasTaken) watch();
    if (isFirstLane() && (moved || released != wasReleased)) storeRecord(molecule);
    writeNormals(molecule);
}
