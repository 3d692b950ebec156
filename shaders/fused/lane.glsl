// One lane a molecule, in its registers: of a compute shader or, with LAYERED, of a fragment shader. For fused/frame.glsl.
#ifndef LAYERED
#include "fused/store.glsl"
#endif
#if defined(NORMALS) && !defined(LAYERED)
layout(std430) writeonly buffer NewNormals { ELEMENT newNormals[]; };
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
    // Lanes that run in step advance until one of them finds a contact, and resolve their contacts together. So a
    // substep without contact costs little, even on devices that run both sides of every branch: these run what follows
    // a loop only once. Where lanes cannot vote, each waits at the end of its loop for the others.
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
