// The colliders near a sphere, nearest first (MOST_WALLS, set by C++), two texels each, or with TEXTURES two layers: xyz unit normal, w the gap; xyz
// the surface's velocity, w friction.
struct Wall {
    vec3 normal;    // unit
    float gap;      // m, from the sphere's centre to where it would rest; 1e30: none is near
    vec3 velocity;  // m/s, of the surface
    float friction;
};

#ifdef TEXTURES
#define WALL_RECORDS sampler2DArray
#define wallTexel(values, i, k) texelFetch(values, ivec3(texelOf(i), k), 0)
#else
#define WALL_RECORDS samplerBuffer
#define wallTexel(values, i, k) texelFetch(values, 2 * MOST_WALLS * (i) + (k))
#endif
