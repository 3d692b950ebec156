// The batches of the iterations. One is of two iterations, behind which arrays that take turns have their first names again; of an odd number
// the first is of three. The first has a lane for each slot that takes part, and so has each other where the one before leaves a residual above
// the scene's tolerance; else it has none.
struct Batch {
    uint groupsX;  // workgroups of 64 lanes, as glDispatchComputeIndirect takes them
    uint groupsY;
    uint groupsZ;
    uint residual;  // the largest that it leaves, as bits
};

// They have a buffer of their own, because a driver may watch over the whole buffer that it takes workgroups from.
layout(std430) buffer Batches {
    Batch batches[];
};
