// `shapes` describes the spheres of a molecule, one texel each:
//   of a vertex     x 1/mass (1/kg), y 1: pinned, z first of its triangles' spheres in `around`, w how many
//   of a triangle   xyz its corners
// Behind them is `around`: the spheres of the triangles around a vertex, one texel each (x).
// Set by C++: VERTICES, SPHERES, POSITION_ELEMENTS, STATE_ELEMENTS, BLOCK or with LAYERED STATE_WIDTH.
#include "state/packed.glsl"
#include "state/numbered.glsl"

#ifndef TEXTURES
layout(local_size_x = 64) in;
#endif

uniform FLOATS shapes;
uniform UINTS slots;      // of a sphere
uniform UINTS cells;      // contact/records.glsl
uniform int firstSphere;  // of the part, or in fragments of the group
uniform int partSpheres;

int slotOf(int sphere)
{
    return int(fetch(slots, sphere).x);
}

vec4 shapeOf(int sphere)
{
    return fetch(shapes, sphere);
}

float weightOf(vec4 shape, bool released)
{
    return shape.y > 0.5 && !released ? 0.0 : shape.x;
}
