// Fluid velocities u(x, t) of the analytic fields, in m/s. `x` is relative to the field's origin, which the
// caller subtracted from the molecule's anchor exactly. `time` counts from the start of the frame; what a field was up to
// then comes from the CPU, where time is in double (src/compile/clocks.h). Formulas and units: src/scene/field.h.
// Read as C++ through GLM by the tests. Needs physics/noise.glsl.
#include "physics/noise.glsl"

// angularFrequency in rad/s; start: the angle at the frame's start, rad.
vec3 oscillatingVelocity(float time, vec3 velocity, float angularFrequency, float start)
{
    return velocity * sin(angularFrequency * time + start);
}

// along, across1, across2: an orthonormal frame; size = (length, width); frozen turbulence that travels.
// n = (noise(p) + noise(2 p + 17.31)/2) * 1.2, a mean of 0 and a standard deviation of 0.257. The fronts had
// travelled by `gone` + `cells` of their length when the frame began. x is relative to the corner of cell `first`.
vec3 gustVelocity(vec3 x, float time, vec3 along, vec3 across, float speed, float strength, float frontSpeed,
                  vec2 size, float gone, uint cells, uint seed, uvec3 first)
{
    uvec3 passed = first - uvec3(cells, 0u, 0u);
    vec3 third = cross(along, across);
    vec3 p = vec3((dot(x, along) - frontSpeed * time) / size.x - gone, dot(x, across) / size.y, dot(x, third) / size.y);
    float fine = gradientNoise(2.0f * p + 17.31f, 2u * passed, seed + 1u);
    float n = 1.2f * (gradientNoise(p, passed, seed) + 0.5f * fine);
    return along * (speed * (1.0f + strength * n));
}

vec3 shearVelocity(vec3 x, vec3 velocity, vec3 row0, vec3 row1, vec3 row2)
{
    return velocity + vec3(dot(row0, x), dot(row1, x), dot(row2, x));
}

// Scully's vortex: peak `speed` at r = radius; `lift` along the axis on the axis.
vec3 vortexVelocity(vec3 x, vec3 axis, float speed, float radius, float lift)
{
    vec3 r = (x - axis * dot(x, axis)) / radius;
    float core = 1.0f / (1.0f + dot(r, r));
    return cross(axis, r) * (2.0f * speed * core) + axis * (lift * core);
}

vec3 abcVelocity(vec3 x, float a, float b, float c, float wavenumber)
{
    vec3 p = x * wavenumber;
    return vec3(a * sin(p.z) + c * cos(p.y), b * sin(p.x) + a * cos(p.z), c * sin(p.y) + b * cos(p.x));
}

vec3 taylorGreenVelocity(vec3 x, float speed, float wavenumber)
{
    vec3 p = x * wavenumber;
    return vec3(cos(p.x) * sin(p.y), -sin(p.x) * cos(p.y), 0.0f) * (speed * cos(p.z));
}

// Octave i has length and period 2^-i and speed 2^(-i/3) (Kolmogorov's spectrum) of the first. `gone` + `cells` periods
// had passed when the frame began. x is relative to the corner of cell `first`.
vec3 curlNoiseVelocity(vec3 x, float time, float speed, float size, float period, int octaves, float gone, uint cells,
                       uint seed, uvec3 first)
{
    vec3 sum = vec3(0.0f);
    float scale = 1.0f;
    float amplitude = speed;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude *
               curlNoise(x * (scale / size), scale * (gone + time / period), cells << uint(i), seed + uint(i),
                         first * (1u << uint(i)));
        scale *= 2.0f;
        amplitude *= 0.79370053f;
    }
    return sum;
}

// Noise by table (src/scene/noise_tile.h): places in a tile are in tiles, and the tile repeats. shaders/state/noise_tile.glsl
// reads it there.

// Returns a place for each number, far from that of the next.
vec3 tilePlace(uint number)
{
    return vec3(float(number * 3518319155u), float(number * 2882110345u), float(number * 2360945575u)) * 2.3283064e-10f;
}

// Where a gust reads its noise: as gustVelocity, and moved across by a part of the tile for each tile along. row0, row1,
// row2: along the wind and across, tiles a m; rate: of the fronts, tiles a s, which had travelled by `gone` + `cells` tiles
// when the frame began.
vec3 gustPlace(vec3 x, float time, vec3 row0, vec3 row1, vec3 row2, float rate, float gone, uint cells, uint seed)
{
    float s = dot(x, row0) - rate * time - gone;
    vec3 travelled = vec3(0.0f, float(cells * 820338753u), float(cells * 506806141u)) * 2.3283064e-10f;
    return vec3(s, dot(x, row1) + 0.191f * s, dot(x, row2) + 0.118f * s) + (tilePlace(2654435769u * seed) - travelled);
}

// Curl noise that changes: the same tile, seen by two moments that follow one another, each at a place of its own and
// adrift along one of the four diagonals of a tetrahedron, so that no direction is before another and small eddies change
// faster than large ones, as when large ones sweep them along [Tennekes 1975]. The velocity is firstPart * tile(first) +
// secondPart * tile(second); the squares of the parts add up to 1.
struct MomentPair {
    vec3 first;
    vec3 second;
    float firstPart;
    float secondPart;
};

vec3 momentDirection(uint number)
{
    float x = (number & 2u) == 0u ? 1.0f : -1.0f;
    float y = (number & 1u) == 0u ? 1.0f : -1.0f;
    return vec3(x, y, x * y);
}

// scale: tiles a m; rate: moments a s; drift: along each axis, tiles a moment. `gone` + `cells` moments had passed when the
// frame began.
MomentPair momentsOf(vec3 x, float time, float scale, float rate, float drift, float gone, uint cells, uint seed)
{
    float age = gone + rate * time;
    float whole = floor(age);
    float f = age - whole;
    uint number = cells + uint(int(whole)) + 2654435769u * seed;
    float later = fade(f);
    float earlier = 1.0f - later;
    float norm = 1.0f / sqrt(earlier * earlier + later * later);
    vec3 p = x * scale;
    return MomentPair(p + tilePlace(number) - (drift * f) * momentDirection(number),
                      p + tilePlace(number + 1u) + (drift * (1.0f - f)) * momentDirection(number + 1u), norm * earlier,
                      norm * later);
}

// One wave train of linear theory; x is relative to a point of the still surface. phase: at that point when the frame
// begins. speed: amplitude times angular
// frequency, over 1 - e^(-2 wavenumber depth); top: the sum of all trains' amplitudes. As exponentials,
// because cosh and sinh of deep water overflow: cosh k(y + d) / sinh kd = (e^ky + e^-k(y + 2d)) / (1 - e^-2kd).
vec3 waveVelocity(vec3 x, float time, vec2 direction, float wavenumber, float angularFrequency, float phase, float speed,
                  float depth, float top)
{
    float y = clamp(x.y, -depth, top);
    float fromSurface = exp(wavenumber * y);
    float fromBottom = exp(-wavenumber * (y + 2.0f * depth));
    float a = phase + wavenumber * (direction.x * x.x + direction.y * x.z) - angularFrequency * time;
    float along = speed * (fromSurface + fromBottom) * cos(a);
    return vec3(direction.x * along, speed * (fromSurface - fromBottom) * sin(a), direction.y * along);
}

// x is relative to the eye at the ground; inflow: the tangent of its angle. Where s is above 40 the wind is below
// 1e-8 of its peak.
vec3 hurricaneVelocity(vec3 x, float speed, float radius, float shape, float inflow, float height, float coriolis)
{
    float r = max(length(vec2(x.x, x.z)), 1e-6f * radius);
    float s = pow(radius / r, shape);
    if (s > 40.0f || x.y < 0.0f || x.y > height) return vec3(0.0f);
    float pressure = speed * speed * s * exp(1.0f - s);
    float turning = 0.5f * coriolis * r;
    float root = max(sqrt(pressure + turning * turning), 1e-15f);
    float v = pressure / (root + turning);
    float slope = (0.5f * shape * (s - 1.0f) * pressure / r + 0.5f * coriolis * turning) / root - 0.5f * coriolis;
    float a = 3.14159265f * x.y / height;
    float around = (speed < 0.0f ? -v : v) * cos(0.5f * a) / r;
    float inwards = inflow * v * cos(a) / r;
    float up = inflow * (v / r + slope) * height * 0.318309886f * sin(a);
    return vec3(around * x.z - inwards * x.x, up, -around * x.x - inwards * x.z);
}
