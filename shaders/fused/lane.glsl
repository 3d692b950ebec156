// One lane a molecule, in its registers: of a compute shader (fused/buffers.glsl) or of a fragment shader (fused/layers.glsl). Lanes past the
// last molecule work on what the state is padded with: a return would make the rasteriser mask everything that follows.
#include "generated/packing.glsl"

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

void runAlone()
{
    int done = 0;
    while (done < substeps) {
        advance(done);
        ++done;
        if (mayTouch() && findContacts(done)) resolveContacts(done);
    }
}

// Lanes that run in step advance until one of them finds a contact, and resolve their contacts together. So a
// substep without contact costs little, even on devices that run both sides of every branch: these run what follows
// a loop only once. Where lanes cannot vote, each waits at the end of its loop for the others.
void runTogether()
{
    int done = 0;
    do {
        bool found;
        do {
            bool near = true;
            if (areBounded) {
                do {
                    advance(done);
                    ++done;
                    near = mayTouch();
                } while (!SOME_LANE(near) && done < substeps);
            } else {
                advance(done);
                ++done;
            }
            found = near && findContacts(done);
        } while (!SOME_LANE(found) && done < substeps);
        if (found) resolveContacts(done);
    } while (done < substeps);
}

void run()
{
    beginContact();
    if (TOGETHER) {
        runTogether();
    } else {
        runAlone();
    }
}
