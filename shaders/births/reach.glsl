// How far the next step goes: one past the last place that is taken, or was one step before, on the other side of the
// state. Needs births/control.glsl, the buffer Control and controlBase.
uniform int stepLanes;   // molecules that a workgroup of the step takes
uniform int partPlaces;  // of each part of the state, but the last may have fewer
uniform int partCount;
layout(std430) writeonly buffer StepGroups { uvec4 stepGroups[]; };  // of each part's step: workgroups x y z

void reachTo(uint mark)
{
    uint reach = max(mark, control[controlBase + controlMarkBefore]);
    control[controlBase + controlMark] = mark;
    for (int p = 0; p < partCount; ++p) {
        uint before = uint(p) * uint(partPlaces);
        uint here = min(max(reach, before) - before, uint(partPlaces));
        stepGroups[p] = uvec4((here + uint(stepLanes) - 1u) / uint(stepLanes), 1u, 1u, 0u);
    }
}
