// A collider near a sphere, in two texels of `colliders`.
struct NearCollider {
    vec3 normal;    // unit
    float gap;      // m, from the sphere's centre to where it would rest; 1e30: none is near
    vec3 velocity;  // m/s, of the surface
    float friction;
};

vec4[2 * MOST_COLLIDERS] packedColliders(NearCollider near[MOST_COLLIDERS])
{
    vec4 texels[2 * MOST_COLLIDERS];
    for (int k = 0; k < MOST_COLLIDERS; ++k) {
        texels[2 * k] = vec4(near[k].normal, near[k].gap);
        texels[2 * k + 1] = vec4(near[k].velocity, near[k].friction);
    }
    return texels;
}
