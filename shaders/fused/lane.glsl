// One lane a molecule, in its registers: of a compute shader or, with LAYERED, of a fragment shader. For fused/frame.glsl.
#ifndef LAYERED
#include "fused/store.glsl"
#endif
#if defined(NORMALS) && !defined(LAYERED)
layout(std430, binding = 2) writeonly buffer NewNormals { ELEMENT newNormals[]; };
#endif

#include "generated/packing.glsl"

// Lanes past the last molecule work on what the state is padded with: a return would make the rasteriser mask everything
// that follows.
int ownMolecule()
{
#ifdef LAYERED
    return int(gl_FragCoord.y) * STATE_WIDTH + int(gl_FragCoord.x);
#else
    return int(gl_GlobalInvocationID.x);
#endif
}

int vertexOf(int i)
{
    return i;
}

bool isFirstLane()
{
    return true;
}

bool anyLane(bool value)
{
    return value;
}

// The position of vertex 0, m.
vec3 firstPlace()
{
    return x[0];
}

// The molecule is stored as it was.
void keepState(int molecule)
{
    loadState(molecule);
}

#ifdef GROUP_VOTE
#define SOME_LANE(value) anyInvocationARB(value)
#else
#define SOME_LANE(value) value
#endif

void run()
{
    int done = 0;
#ifdef COLLIDE
    beginContact();
#if defined(GROUP_VOTE) || defined(SOFTWARE)
    // All neighbours that run in step look for contacts together: where nothing touches, little is paid for it, also on
    // devices that run both sides of every branch, and once what follows a loop. Where such a device lets nobody vote, a
    // lane waits at the end of its loop until all of them are there.
    do {
        bool found;
        do {
#ifdef BOUNDED
            bool near;
            do {
                advance(done);
                ++done;
                near = mayTouch();
            } while (!SOME_LANE(near) && done < substeps);
            found = near && findContacts(done);
#else
            advance(done);
            ++done;
            found = findContacts(done);
#endif
        } while (!SOME_LANE(found) && done < substeps);
        if (found) resolveContacts(done);
    } while (done < substeps);
#else
    while (done < substeps) {
        advance(done);
        ++done;
        if (mayTouch() && findContacts(done)) resolveContacts(done);
    }
#endif
#else
    for (; done < substeps; ++done) advance(done);
#endif
}
