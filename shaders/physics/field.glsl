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
// n = (noise(p) + noise(2 p + 17.31)/2) * 1.2, a mean of 0 and a standard deviation of about 0.4. The fronts had
// travelled by `gone` + `cells` of their length when the frame began.
vec3 gustVelocity(vec3 x, float time, vec3 along, vec3 across, float speed, float strength, float frontSpeed,
                  vec2 size, float gone, uint cells, uint seed)
{
    vec3 third = cross(along, across);
    vec3 p = vec3((dot(x, along) - frontSpeed * time) / size.x - gone, dot(x, across) / size.y, dot(x, third) / size.y);
    float fine = gradientNoise(2.0f * p + 17.31f, 0u - 2u * cells, seed + 1u);
    float n = 1.2f * (gradientNoise(p, 0u - cells, seed) + 0.5f * fine);
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
// had passed when the frame began.
vec3 curlNoiseVelocity(vec3 x, float time, float speed, float size, float period, int octaves, float gone, uint cells,
                       uint seed)
{
    vec3 sum = vec3(0.0f);
    float scale = 1.0f;
    float amplitude = speed;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude *
               curlNoise(x * (scale / size), scale * (gone + time / period), cells << uint(i), seed + uint(i));
        scale *= 2.0f;
        amplitude *= 0.79370053f;
    }
    return sum;
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
