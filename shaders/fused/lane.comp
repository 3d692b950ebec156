// The fused step, one lane a molecule: reads it once, runs all substeps of the frame in registers, writes it once.
#include "fused/watch.glsl"
#include "physics/anchor.glsl"

#include "fused/store.glsl"
#ifdef NORMALS
layout(std430, binding = 2) writeonly buffer NewNormals { ELEMENT newNormals[]; };
#endif

#include "generated/packing.glsl"

#ifdef LIFE
#include "particles/age.glsl"
#endif

// The anchor follows the molecule by steps of its lattice, exactly.
bool followAnchor()
{
    vec3 shift = anchorShift(x[0]);
    if (shift == vec3(0.0)) return false;
    for (int i = 0; i < VERTICES; ++i) {
        x[i] -= shift;
    }
    anchor += shift;
    return true;
}

void run()
{
    int done = 0;
#ifdef COLLIDE
#ifdef GROUP_VOTE
    // All neighbours that run in step look for contacts together: where nothing touches, nothing is paid for it,
    // also on devices that run both sides of every branch.
    do {
        bool found;
        do {
            advance(done);
            ++done;
#ifdef MOVING_COLLIDERS
            contactTime = float(done) * substep;
#endif
            found = findContacts();
        } while (!anyInvocationARB(found) && done < substeps);
        if (found) resolveContacts();
    } while (done < substeps);
#else
    for (; done < substeps; ++done) {
        advance(done);
#ifdef MOVING_COLLIDERS
        contactTime = float(done + 1) * substep;
#endif
        if (findContacts()) resolveContacts();
    }
#endif
#else
    for (; done < substeps; ++done) advance(done);
#endif
}

#ifdef NORMALS
void writeNormals(int molecule)
{
    for (int i = 0; i < VERTICES; ++i) {
        probe[i] = x[i];
    }
    surfaceNormals();
    storeNormals(molecule);
}
#endif

void main()
{
    // Lanes past the last molecule work on what the buffers are padded with: a return here would make the rasteriser
    // mask everything that follows.
    int molecule = int(gl_GlobalInvocationID.x);
    loadState(molecule);
#ifndef ONLY_NORMALS
    loadUniforms();
#ifdef FIELDS
    loadFieldParameters();
#endif
#if defined(ACTUATION) && !defined(STEERED)
    loadMuscleAngles();
#endif
#ifdef FORCE_PARAMETERS
    loadForceParameters();
#endif
#ifdef COLLIDE
    loadColliderParameters();
#endif
    loadRecord(molecule);
#ifdef STEERED
    loadSteering(molecule);
#endif
    bool wasReleased = released;
    bool moved = false;
#ifdef RECORDS
    moved = followAnchor();
#endif
    beginSolver();
    sampleFrame();
    run();
    finishSolver();
#ifdef LIFE
    bool wasTaken = taken();
    if (wasTaken) {
        growOlder(molecule);
    } else {
        loadState(molecule);  // what has died stays as it was
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
#ifdef RECORDS
    if (moved || released != wasReleased) newRecords[molecule] = recordNow();
#endif
#endif
#ifdef NORMALS
    writeNormals(molecule);
#endif
}
