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

// `value` with the sign that the highest bit of `word` says.
float signedBy(float value, uint word)
{
    return uintBitsToFloat(floatBitsToUint(value) ^ (word & 2147483648u));
}

// A corner's part of simplexNoiseSlope(), at `d` from it. Its gradient is one of eight, of ones with the signs of bits.
vec4 simplexCorner(vec3 d, uint word)
{
    uint hash = (word ^ (word >> 15u)) * 2146121005u;
    hash = hash ^ (hash >> 13u);
    float near = max(0.5f - dot(d, d), 0.0f);
    float square = near * near;
    float cube = near * square;
    float ramp = signedBy(d.x, hash) + signedBy(d.y, hash << 7u) + signedBy(d.z, hash << 14u);
    float back = -6.0f * square * ramp;
    return vec4(signedBy(cube, hash) + back * d.x, signedBy(cube, hash << 7u) + back * d.y,
                signedBy(cube, hash << 14u) + back * d.z, cube * ramp);
}

// Simplex noise [Perlin 2001]: its slope along x, y and z, which is exact, and in w its value. Its RMS and that of its slope
// are those of gradientNoise(). It has four corners instead of eight, for what only has to look like noise.
vec4 simplexNoiseSlope(vec3 place, uint seed)
{
    const float finer = 0.63f;
    const float strength = 11.5f;
    const uint stepX = 2654435769u;
    const uint stepY = 2246822507u;
    const uint stepZ = 3266489909u;
    vec3 p = finer * place;
    vec3 corner = floor(p + (p.x + p.y + p.z) / 3.0f);
    vec3 d = p - corner + (corner.x + corner.y + corner.z) / 6.0f;
    ivec3 cell = ivec3(corner);
    uint word = uint(cell.x) * stepX + uint(cell.y) * stepY + uint(cell.z) * stepZ + seed;
    // The corners between the first and the opposite one are one step, and two, along the largest components.
    bool xy = d.x >= d.y;
    bool yz = d.y >= d.z;
    bool xz = d.x >= d.z;
    bvec3 firstStep = bvec3(xy && xz, !xy && yz, !xz && !yz);
    bvec3 bothSteps = bvec3(xy || xz, !xy || yz, !xz || !yz);
    uint firstWord = word + (firstStep.x ? stepX : 0u) + (firstStep.y ? stepY : 0u) + (firstStep.z ? stepZ : 0u);
    uint bothWord = word + (bothSteps.x ? stepX : 0u) + (bothSteps.y ? stepY : 0u) + (bothSteps.z ? stepZ : 0u);
    vec4 sum = simplexCorner(d, word) + simplexCorner(d - vec3(firstStep) + 1.0f / 6.0f, firstWord) +
               simplexCorner(d - vec3(bothSteps) + 1.0f / 3.0f, bothWord) +
               simplexCorner(d - 0.5f, word + stepX + stepY + stepZ);
    return strength * vec4(finer * sum.x, finer * sum.y, finer * sum.z, sum.w);
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
