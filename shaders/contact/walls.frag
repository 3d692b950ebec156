// walls: a texel a sphere, of one group that collides: the colliders near it (contact/walls.glsl).
#include "state/numbered.glsl"
#include "contact/shape.glsl"
#include "contact/state_sphere.glsl"

layout(location = 0) out vec4 newWalls[2 * MOST_WALLS];

void main()
{
    int number = ownNumber() - firstSphere;
    if (number < 0 || number >= partSpheres) discard;
    int molecule = number / SPHERES;
    Wall near[MOST_WALLS] = nearWalls(sphereOfState(molecule, number - molecule * SPHERES), number - molecule * SPHERES);
    vec4 walls[2 * MOST_WALLS];
    for (int k = 0; k < MOST_WALLS; ++k) {
        walls[2 * k] = vec4(near[k].normal, near[k].gap);
        walls[2 * k + 1] = vec4(near[k].velocity, near[k].friction);
    }
    newWalls = walls;
}
