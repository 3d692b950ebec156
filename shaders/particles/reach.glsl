// How far the next step goes: one past the last place that is taken, or was one step before, on the other side of the
// state. Needs particles/control.glsl, the buffer Control and controlBase.
uniform int stepLanes;  // molecules that a workgroup of the step takes

void reachTo(uint mark)
{
    uint reach = max(mark, control[controlBase + controlMarkBefore]);
    control[controlBase + controlMark] = mark;
    control[controlBase + controlStepGroups] = (reach + uint(stepLanes) - 1u) / uint(stepLanes);
}
