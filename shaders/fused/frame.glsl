// The fused step: reads each molecule once, runs all substeps of the frame, writes it once. Needs fused/lane.glsl or
// fused/group.glsl, and loadParameters() of src/simulate/fused_kernel.cpp.
#include "fused/watch.glsl"
#include "fused/normals.glsl"
#include "physics/anchor.glsl"
#ifdef LIFE
#include "particles/age.glsl"
#endif

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

#ifdef MAY_BE_CUT
#include "step/cut_short.glsl"

#ifdef MOLECULE_VERTICES
const int turnsLeft = 64;  // that storing takes
#else
const int turnsLeft = 0;
#endif

// Whether the ways among many colliders took more turns of loops than they may, or all loops more than some of Mesa's CPU
// rasterisers take (mostSoftwareTurns in src/gpu/context.h).
bool loopsEndEarly()
{
    bool early = false;
#ifdef TABLED
    early = turns > mostTurns;
#endif
#ifdef SOFTWARE
    int taken = 0;
    do {  // Mesa does not write it out; a `for` or a `while` of it hangs the linker of 26.2
        ++taken;
    } while (taken <= substeps + turnsLeft);
    early = early || taken <= substeps + turnsLeft;
#endif
    return early;
}
#endif

#ifdef RESTING
uniform bool probes;     // whether anything other than contact acts differently than in the last step
vec3 gained[VERTICES];  // m/s, in a step from rest
#endif

#ifdef REMEMBERS
void loadLoads(int molecule)
{
    for (int i = 0; i < VERTICES; ++i) {
        vec4 own = fetch(contactLoads, firstSphere + molecule * SPHERES + vertexOf(i));
        load[i] = own.xyz;
#ifdef RIGID_IMPACT
        heldByContact = heldByContact && own.w == HELD_BY_CONTACT;
#endif
    }
}
#endif

void main()
{
#ifdef ISSUED_AHEAD
    if (comesTooLate()) return;
#endif
    int molecule = ownMolecule();
    loadState(molecule);
    loadParameters();
    loadRecord(molecule);
#ifdef STEERED
    loadSteering(molecule);
#endif
#ifdef REMEMBERS
    loadLoads(molecule);
#endif
#ifdef RESTING
    float mover = fetch(contactLoads, firstSphere + molecule * SPHERES).w;
    bool probed = mover == COME_TO_REST || (probes && isResting(mover));
#ifndef MOLECULE_VERTICES
    if (isResting(mover) && !probed) substeps = 0;
#endif
#endif
#ifdef MAY_BE_CUT
    bool isCutShort = x[0] == cutShort();
#ifndef MOLECULE_VERTICES
    if (isCutShort) substeps = 0;
#endif
#endif
    bool wasReleased = released;
    bool moved = false;
#ifdef RECORDS
    moved = followAnchor();
#endif
#ifdef COLLIDE
    takeRadius(scale, min((age + frameDuration) / max(span, 1e-9), 1.0));
#endif
    beginSolver();
    sampleFrame();
    run();
    finishSolver();
#ifdef MAY_BE_CUT
    isCutShort = isCutShort || loopsEndEarly();
#endif
#ifdef RESTING
    // A molecule at rest is stored as it was, but with the velocities that it would gain: when these change,
    // contact/rest/rest.pass.glsl wakes it.
    if (isResting(mover)) {
        for (int i = 0; i < VERTICES; ++i) {
            gained[i] = probed ? v[i] : vec3(0.0);
        }
        keepState(molecule);
        for (int i = 0; i < VERTICES; ++i) {
            v[i] = gained[i];
        }
        moved = false;
    }
#endif
#ifdef MAY_BE_CUT
    if (isCutShort) x[0] = cutShort();
#endif
#ifdef LIFE
    bool wasTaken = taken();
    growOlder(molecule);
    if (!wasTaken) {
        keepState(molecule);  // what has died stays as it was
        moved = false;
    }
#endif
    storeState(molecule);
#ifdef WATCH
#ifdef LIFE
    if (wasTaken)
#endif
    watch();
#endif
#if defined(RECORDS) && !defined(LAYERED)
    if (isFirstLane() && (moved || released != wasReleased)) newRecords[molecule] = recordNow();
#endif
#ifdef NORMALS
    writeNormals(molecule);
#endif
}
