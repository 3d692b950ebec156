// The buffers to which a lane writes a molecule: the whole state, and its record.
#include "state/stored.glsl"

layout(std430) writeonly buffer NewState { ELEMENT newState[]; };
#ifdef RECORDS
layout(std430) writeonly buffer NewRecords { vec4 newRecords[]; };

void storeRecord(int molecule)
{
    newRecords[molecule] = recordNow();
}
#else
void storeRecord(int molecule)
{
}
#endif
