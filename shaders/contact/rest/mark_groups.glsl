// How many slots are awake, and how many marked; and thrice the words that glDispatchComputeIndirect takes: workgroups of 64 lanes,
// a lane a slot that is awake; that is marked; a lane a slot if an impact has struck what rests, and else none.
layout(std430) buffer MarkGroups {
    uint awakeX;
    uint awakeY;
    uint awakeZ;
    uint markedX;
    uint markedY;
    uint markedZ;
    uint struckX;
    uint struckY;
    uint struckZ;
    uint awake;
    uint marked;
};

void noneMarked()
{
    awakeX = markedX = struckX = awake = marked = 0u;
    awakeY = markedY = struckY = 1u;
    awakeZ = markedZ = struckZ = 1u;
}
