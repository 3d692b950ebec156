// The fused step, one workgroup a molecule and a lane a vertex: for molecules that do not fit one lane's registers.
// The vertices lie in shared memory; the springs around a vertex come from the topology table.
#include "fused/watch.glsl"
#include "physics/anchor.glsl"

layout(std430, binding = 0) writeonly buffer NewState { float newState[]; };
#ifdef RECORDS
layout(std430, binding = 1) writeonly buffer NewRecords { vec4 newRecords[]; };
#endif
#ifdef NORMALS
layout(std430, binding = 2) writeonly buffer NewNormals { float newNormals[]; };
#endif

// Component c of a molecule's floats, by its first element.
int floatIndex(int first, int number)
{
    return (first + (number / 4) * BLOCK) * 4 + number % 4;
}

void loadState(int first)
{
    for (int i = 0; i < VERTICES; ++i) {
        x[i] = packedVertex(oldState, first, i);
        v[i] = packedVertex(oldState, first + POSITION_ELEMENTS * BLOCK, i);
    }
}

void storeState(int first)
{
    for (int i = 0; i < VERTICES; ++i) {
        for (int c = 0; c < 3; ++c) {
            newState[floatIndex(first, 3 * i + c)] = x[i][c];
            newState[floatIndex(first + POSITION_ELEMENTS * BLOCK, 3 * i + c)] = v[i][c];
        }
    }
}

#ifdef NORMALS
void writeNormals(int first)
{
    for (int i = 0; i < VERTICES; ++i) {
        probe[i] = x[i];
    }
    surfaceNormals();
    for (int i = 0; i < VERTICES; ++i) {
        for (int c = 0; c < 3; ++c) newNormals[floatIndex(first, 3 * i + c)] = normal[i][c];
    }
}
#endif

// The anchor follows the molecule by steps of its lattice, exactly.
bool followAnchor()
{
    meet();
    vec3 shift = anchorShift(x[0]);
    for (int i = 0; i < VERTICES; ++i) {
        x[i] -= shift;
    }
    anchor += shift;
    return shift != vec3(0.0);
}

void run()
{
    for (int done = 0; done < substeps; ++done) {
        advance(done);
#ifdef COLLIDE
#ifdef MOVING_COLLIDERS
        contactTime = float(done + 1) * substep;
#endif
        resolveContacts();
#endif
    }
}

void main()
{
    int molecule = int(gl_WorkGroupID.x);
    int first = firstElement(molecule, STATE_ELEMENTS);
    loadState(first);
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
    storeState(first);
#ifdef WATCH
    watch();
#endif
#ifdef RECORDS
    if (gl_LocalInvocationID.x == 0u && (moved || released != wasReleased)) newRecords[molecule] = recordNow();
#endif
#endif
#ifdef NORMALS
    writeNormals(firstElement(molecule, POSITION_ELEMENTS));
#endif
}
