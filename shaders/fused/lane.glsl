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

#ifdef LIFE
// The molecule is stored as it was.
void keepState(int molecule)
{
    loadState(molecule);
}
#endif

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
            found = findContacts(done);
        } while (!anyInvocationARB(found) && done < substeps);
        if (found) resolveContacts(done);
    } while (done < substeps);
#else
    while (done < substeps) {
        advance(done);
        ++done;
        if (findContacts(done)) resolveContacts(done);
    }
#endif
#else
    for (; done < substeps; ++done) advance(done);
#endif
}
