// Lattice gradient noise. Integer hashes only, so that the lattice is the same on every device and on the CPU.
//
// At lattice point c of a 3D or 4D integer lattice, with a seed, the gradients are made from
//   pcg4d(uvec4(c.x, c.y, c.z, c.w or seed) + seeds)       [Jarzynski 2020]
// by taking a word's four bytes b: gradient component = b / 127.5 - 1, in [-1, 1].
// Interpolation is Perlin's quintic fade(t) = t^3 (6 t^2 - 15 t + 10) in every dimension [Perlin 2002].
// Read as C++ through GLM by the tests: no swizzles, floats marked f, results returned as structs.

uvec4 pcg4d(uvec4 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> 16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

float fade(float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

float fadeSlope(float t)
{
    return 30.0f * t * t * (t - 1.0f) * (t - 1.0f);
}

// A word's four bytes, lowest first, as components in [-1, 1].
vec4 gradientOf(uint word)
{
    return vec4(float(word & 255u), float((word >> 8u) & 255u), float((word >> 16u) & 255u), float(word >> 24u)) /
               127.5f -
           1.0f;
}

// Gradient noise in three dimensions: mean 0, mostly within [-1, 1]. p counts from lattice cell `first`, so that it
// stays small however far from the origin it is asked for and however far the noise has travelled.
float gradientNoise(vec3 p, uvec3 first, uint seed)
{
    vec3 corner = floor(p);
    vec3 f = p - corner;
    ivec3 cell = ivec3(corner);
    float wx = fade(f.x);
    float wy = fade(f.y);
    float wz = fade(f.z);
    float sum = 0.0f;
    for (int i = 0; i < 8; ++i) {
        ivec3 side = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        uvec4 hash = pcg4d(uvec4(uvec3(cell + side) + first, seed));
        vec4 gradient = gradientOf(hash.x);
        vec3 d = f - vec3(side);
        float weight = (side.x == 1 ? wx : 1.0f - wx) * (side.y == 1 ? wy : 1.0f - wy) *
                       (side.z == 1 ? wz : 1.0f - wz);
        sum += weight * (gradient.x * d.x + gradient.y * d.y + gradient.z * d.z);
    }
    return sum;
}

// The slope of gradientNoise(p, uvec3(0u), seed) along x, y and z, which is exact, and in w its value.
vec4 gradientNoiseSlope(vec3 p, uint seed)
{
    vec3 corner = floor(p);
    vec3 f = p - corner;
    ivec3 cell = ivec3(corner);
    vec3 w = vec3(fade(f.x), fade(f.y), fade(f.z));
    vec4 corners[8];  // a corner's gradient, and in w its value here
    for (int i = 0; i < 8; ++i) {
        ivec3 side = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        uvec4 hash = pcg4d(uvec4(uint(cell.x + side.x), uint(cell.y + side.y), uint(cell.z + side.z), seed));
        vec4 g = gradientOf(hash.x);
        vec3 d = f - vec3(side);
        corners[i] = vec4(g.x, g.y, g.z, g.x * d.x + g.y * d.y + g.z * d.z);
    }
    // Along x, then y, then z: what lies between two, and the difference of their values, by which the weight's slope counts.
    vec4 x0 = corners[0] + w.x * (corners[1] - corners[0]);
    vec4 x1 = corners[2] + w.x * (corners[3] - corners[2]);
    vec4 x2 = corners[4] + w.x * (corners[5] - corners[4]);
    vec4 x3 = corners[6] + w.x * (corners[7] - corners[6]);
    vec4 y0 = x0 + w.y * (x1 - x0);
    vec4 y1 = x2 + w.y * (x3 - x2);
    float low = corners[1].w - corners[0].w + w.y * (corners[3].w - corners[2].w - corners[1].w + corners[0].w);
    float high = corners[5].w - corners[4].w + w.y * (corners[7].w - corners[6].w - corners[5].w + corners[4].w);
    float acrossX = low + w.z * (high - low);
    float acrossY = x1.w - x0.w + w.z * (x3.w - x2.w - x1.w + x0.w);
    float acrossZ = y1.w - y0.w;
    return y0 + w.z * (y1 - y0) +
           vec4(fadeSlope(f.x) * acrossX, fadeSlope(f.y) * acrossY, fadeSlope(f.z) * acrossZ, 0.0f);
}

// Curl of a vector potential psi(p, t) of three 4D gradient noises; component k of psi takes its gradients
// from word k of pcg4d(cell.x, cell.y, cell.z, cell.w + 0x9e3779b9 seed). Derivatives are exact. p and t
// count from the lattice cells `firstPlace` and `first`.
vec3 curlNoise(vec3 p, float t, uint first, uint seed, uvec3 firstPlace)
{
    vec3 corner = floor(p);
    vec3 f = p - corner;
    ivec3 cell = ivec3(corner);
    float cornerTime = floor(t);
    float ft = t - cornerTime;
    uint cellTime = uint(int(cornerTime)) + first + 2654435769u * seed;
    vec3 w1 = vec3(fade(f.x), fade(f.y), fade(f.z));
    vec3 s1 = vec3(fadeSlope(f.x), fadeSlope(f.y), fadeSlope(f.z));
    float wt = fade(ft);
    // d psi_k / d x_j, one row per potential
    vec3 dx = vec3(0.0f);
    vec3 dy = vec3(0.0f);
    vec3 dz = vec3(0.0f);
    for (int i = 0; i < 16; ++i) {
        ivec3 side = ivec3(i & 1, (i >> 1) & 1, (i >> 2) & 1);
        int later = i >> 3;
        uvec4 hash = pcg4d(uvec4(uvec3(cell + side) + firstPlace, cellTime + uint(later)));
        vec4 gx = gradientOf(hash.x);
        vec4 gy = gradientOf(hash.y);
        vec4 gz = gradientOf(hash.z);
        vec4 d = vec4(f - vec3(side), ft - float(later));
        float wx = side.x == 1 ? w1.x : 1.0f - w1.x;
        float wy = side.y == 1 ? w1.y : 1.0f - w1.y;
        float wz = side.z == 1 ? w1.z : 1.0f - w1.z;
        float wt2 = later == 1 ? wt : 1.0f - wt;
        // weight and its slopes along x, y, z
        float w = wx * wy * wz * wt2;
        float sx = (side.x == 1 ? s1.x : -s1.x) * wy * wz * wt2;
        float sy = wx * (side.y == 1 ? s1.y : -s1.y) * wz * wt2;
        float sz = wx * wy * (side.z == 1 ? s1.z : -s1.z) * wt2;
        vec3 value = vec3(dot(gx, d), dot(gy, d), dot(gz, d));
        dx += sx * value + w * vec3(gx.x, gy.x, gz.x);
        dy += sy * value + w * vec3(gx.y, gy.y, gz.y);
        dz += sz * value + w * vec3(gx.z, gy.z, gz.z);
    }
    return vec3(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x);
}
