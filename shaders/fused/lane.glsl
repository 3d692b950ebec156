// One lane a molecule, in its registers. For fused/frame.comp.
#include "fused/store.glsl"
#ifdef NORMALS
layout(std430, binding = 2) writeonly buffer NewNormals { ELEMENT newNormals[]; };
#endif

#include "generated/packing.glsl"

// Lanes past the last molecule work on what the buffers are padded with: a return would make the rasteriser mask
// everything that follows.
int ownMolecule()
{
    return int(gl_GlobalInvocationID.x);
}

bool writesRecord()
{
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
