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
    int k = number - molecule * SPHERES;
    Wall near[MOST_WALLS] = nearWalls(sphereOfState(molecule, k), k);
    vec4 walls[2 * MOST_WALLS];
    for (int w = 0; w < MOST_WALLS; ++w) {
        walls[2 * w] = vec4(near[w].normal, near[w].gap);
        walls[2 * w + 1] = vec4(near[w].velocity, near[w].friction);
    }
    newWalls = walls;
}
