// `shapes` describes the spheres of a molecule, one texel each:
//   of a vertex     x 1/mass (1/kg), y 1: pinned, z first of its triangles' spheres in `around`, w how many
//   of a triangle   its corners and their parts (contact/grid/triangle_point.glsl)
// Behind them is `around`: the spheres of the triangles around a vertex, one texel each: x which, y the vertex's weight in it.
// Set by C++: VERTICES, SPHERES, POSITION_ELEMENTS, STATE_ELEMENTS, BLOCK or with LAYERED STATE_WIDTH.
#include "contact/grid/triangle_point.glsl"
#include "state/packed.glsl"
#include "state/lanes.glsl"
#pragma reads shapes slots

uniform int firstShape;   // of the group
uniform int firstSphere;  // of the group, or of its part

int slotOf(int sphere)
{
    return int(slotsAt(sphere));
}

vec4 shapeOf(int k)
{
    return shapesAt(firstShape + k);
}

float weightOf(vec4 shape, bool released)
{
    return shape.y > 0.5 && !released ? 0.0 : shape.x;
}
