// One workgroup a molecule and a lane a vertex, for molecules that do not fit one lane's registers: the vertices lie in
// shared memory. For fused/frame.glsl.
layout(std430, binding = 0) writeonly buffer NewState { float newState[]; };
#ifdef RECORDS
layout(std430, binding = 1) writeonly buffer NewRecords { vec4 newRecords[]; };
#endif
#ifdef NORMALS
layout(std430, binding = 2) writeonly buffer NewNormals { float newNormals[]; };
#endif

int ownMolecule()
{
    return int(gl_WorkGroupID.x);
}

bool writesRecord()
{
    return gl_LocalInvocationID.x == 0u;
}

void loadState(int molecule)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    for (int i = 0; i < VERTICES; ++i) {
        x[i] = packedVertex(oldState, first, 0, i);
        v[i] = packedVertex(oldState, first, POSITION_ELEMENTS, i);
    }
}

void storeState(int molecule)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    for (int i = 0; i < VERTICES; ++i) {
        for (int c = 0; c < 3; ++c) {
            newState[floatIndex(first, 3 * i + c)] = x[i][c];
            newState[floatIndex(first + POSITION_ELEMENTS * BLOCK, 3 * i + c)] = v[i][c];
        }
    }
}

#ifdef NORMALS
void storeNormals(int molecule)
{
    int first = firstElement(molecule, POSITION_ELEMENTS);
    for (int i = 0; i < VERTICES; ++i) {
        for (int c = 0; c < 3; ++c) newNormals[floatIndex(first, 3 * i + c)] = normal[i][c];
    }
}
#endif

void run()
{
    for (int done = 0; done < substeps; ++done) {
        advance(done);
#ifdef COLLIDE
        resolveContacts(done + 1);
#endif
    }
}
