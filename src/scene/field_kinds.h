// The kinds of vector fields, each with its description for files, the call of its function in
// shaders/physics/field.glsl, and its double-precision twin in reference/fields.cpp. docs/adding-a-force.md
// says how to add one. SI units, radians.
//
// `near` of a call: a point amid the molecules, m. Where it is far from a field's origin, what repeats or is
// linear is told from a point near it, because a float holds no long way to the millimetre.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "scene/field.h"
#include "scene/glsl_call.h"

namespace shoal {

struct UniformField {
    glm::dvec3 velocity{0};  // m/s
    GlslCalls calls(const glm::dvec3& near) const;
};

// Flows alike everywhere, to and fro in time: u = velocity sin(2 pi frequency t + phase).
struct OscillatingField {
    glm::dvec3 velocity{0};  // m/s, at the peak
    double frequency = 1;    // Hz, at least 0
    double phase = 0;        // rad
    GlslCalls calls(const glm::dvec3& near) const;
};

// How a field has its noise.
enum class NoiseForm {
    table,     // read from a tile (scene/noise_tile.h)
    computed,  // from its lattice, wherever it is asked for
};

// Direction constant, strength varied in space and time: fronts of size length x width travel along the
// direction with frontSpeed. u = direction * speed * (1 + strength n), n = gradient noise with one extra
// octave, of mean 0, standard deviation 0.257 and about within [-1, 1], at the point ((s - frontSpeed t) /
// length, p / width, q / width) with s along the direction and p, q across it: p along y x direction (x x
// direction where |direction.y| >= 0.9), q along direction x p.
struct GustField {
    glm::dvec3 direction{1, 0, 0};  // any length above 0; normalised
    double speed = 5;               // m/s, mean
    double strength = 0.6;          // relative variation, at least 0
    double length = 8;              // m, of a front along the direction
    double width = 6;               // m, of a front across it
    double frontSpeed = 5;          // m/s
    uint32_t seed = 0;
    NoiseForm noise = NoiseForm::table;
    GlslCalls calls(const glm::dvec3& near) const;
};

struct ShearField {
    glm::dvec3 origin{0};
    glm::dvec3 velocity{0};  // m/s at the origin
    glm::dmat3 gradient{0};  // 1/s; rows in the file: u = velocity + gradient (x - origin)
    GlslCalls calls(const glm::dvec3& near) const;
};

// Scully's vortex: turns about the axis with peak speed at the core radius,
// speed * 2 (r/R) / (1 + (r/R)^2), plus `lift` along the axis times the same profile's core 1/(1+(r/R)^2).
struct VortexField {
    glm::dvec3 origin{0};
    glm::dvec3 axis{0, 1, 0};
    double speed = 3;   // m/s at r = radius
    double radius = 1;  // m
    double lift = 0;    // m/s on the axis
    GlslCalls calls(const glm::dvec3& near) const;
};

// Arnold-Beltrami-Childress: u = (A sin kz + C cos ky, B sin kx + A cos kz, C sin ky + B cos kx), k = 2 pi /
// wavelength.
struct AbcField {
    glm::dvec3 origin{0};
    double a = 1, b = 1, c = 1;             // m/s
    double wavelength = 6.283185307179586;  // m
    GlslCalls calls(const glm::dvec3& near) const;
};

// Taylor-Green: u = speed (cos kx sin ky, -sin kx cos ky, 0) cos kz.
struct TaylorGreenField {
    glm::dvec3 origin{0};
    double speed = 1;                       // m/s
    double wavelength = 6.283185307179586;  // m
    GlslCalls calls(const glm::dvec3& near) const;
};

// Curl of three gradient noises in (x / length, t / period): divergence-free and unbiased because it
// evolves in time instead of being scrolled [Bridson 2007].
struct CurlNoiseField {
    double speed = 1;   // m/s, about the RMS of u
    double length = 2;  // m, of the largest eddies
    double period = 2;  // s, in which they change
    int octaves = 1;    // 1 to 4, each half the length, period and 2^(-1/3) of the speed
    uint32_t seed = 0;
    NoiseForm noise = NoiseForm::table;
    GlslCalls calls(const glm::dvec3& near) const;
};

// Numbered files as frames in time.
struct FileSequence {
    std::optional<int> first, last;  // without them the lowest and the highest number in the folder
    int step = 1;
    std::optional<double> frameRate;  // Hz; either this or the times
    double start = 0;                 // s, of the first file, with frameRate
    std::vector<double> times;        // s, rising, one a file
    bool repeats = false;
};

// The axes that a file was written in, and how they become the scene's (right-handed, +Y up).
enum class FieldAxes {
    yUp,     // as they are
    zUp,     // right-handed, +Z up: (x, y, z) -> (x, z, -y)
    unreal,  // left-handed, +Z up: (x, y, z) -> (x, z, y)
    unity,   // left-handed, +Y up: (x, y, z) -> (x, y, -z)
};

// Names the files of a grid, and says how they are read.
struct GridSource {
    std::string file = {};  // as it is written; # stand for the number of a sequence
    std::optional<FileSequence> sequence = {};
    std::string layout = {};  // .raw: the file that says how its numbers lie
    std::string array = {};   // .vti: the name of the data array; empty: the one that there is
    FieldAxes axes = FieldAxes::yUp;
    double scale = 1;                          // m per unit of the file, for bounds and velocities
    std::optional<double> velocityScale = {};  // m/s per unit of the file, instead of `scale`
    glm::dvec3 origin{0};                      // m, added to the bounds in the scene's axes
    std::optional<Box> bounds = {};            // m, in the scene's axes, instead of the file's
};

// A regular grid of velocities, trilinear between cell centres; a sequence of such grids, linear in time.
struct GridField {
    GridSource source;
    std::string file;  // that was read; of a sequence the first
    glm::ivec3 resolution{0};
    glm::dvec3 low{0}, high{0};     // m, in the scene's axes: the outer faces of the outer cells
    std::vector<glm::vec3> values;  // m/s, x fastest, then y, then z, then the frame
    bool wrap = false;              // repeat outside the bounds, else clamp to the border

    // s, of a sequence's frames, rising, at least two; empty: one grid, at all times. Before the first and
    // after the last the ends hold; where it repeats, the first follows the last as it follows the one before
    // it.
    std::vector<double> times;
    bool repeats = false;

    size_t cells() const { return size_t(resolution.x) * size_t(resolution.y) * size_t(resolution.z); }
    double period() const { return times.back() - times.front() + times.back() - times[times.size() - 2]; }
    GlslCalls calls(const glm::dvec3& near) const;
};

// One wave train: the surface is amplitude cos(k . x - omega t + phase) above its level, k = 2 pi /
// wavelength along the direction, omega^2 = gravity k tanh(k depth).
struct WaveTrain {
    glm::dvec3 direction{1, 0, 0};  // of travel; only x and z count
    double amplitude = 0.2;         // m, half the height; k times it below 1, where crests would curl over
    double wavelength = 6;          // m
    double phase = 0;               // rad, at the origin at time 0
};

// Water under waves [Fournier 1986]: orbits are circles whose
// radius falls as e^(ky) in deep water, and ellipses that flatten to lines at the bottom of shallow water.
// For y from -depth to the sum of the amplitudes, and beyond as there,
//   u = amplitude omega (cosh k(y + depth) cos a, sinh k(y + depth) sin a) / sinh(k depth), a as above,
// along the direction and up. Free of divergence and of rotation.
struct WavesField {
    glm::dvec3 origin{0};         // m, of the still surface
    std::optional<double> depth;  // m, of the bottom below it; without it the water is deep
    double gravity = 9.81;        // m/s^2
    std::vector<WaveTrain> trains;
    GlslCalls calls(const glm::dvec3& near) const;
};

// Holland's gradient wind [Holland 1980, eq. 5]
// around the vertical, anticlockwise seen from above where `speed` is positive, with an inflow below and an
// outflow above. With r from the axis, h above the origin, s = (radius / r)^shape, f = coriolis:
//   V(r) = sqrt(speed^2 s e^(1 - s) + (r f / 2)^2) - r f / 2
//   around  V cos(pi h / (2 height)),  inwards  tan(inflow) V cos(pi h / height),
//   up      tan(inflow) (V / r + dV/dr) (height / pi) sin(pi h / height)
// which is free of divergence: what flows in rises where V / r + dV/dr is large, in the eyewall inside
// the radius, and leaves above. No wind below the origin and above the height.
struct HurricaneField {
    glm::dvec3 origin{0};   // m, of the eye at the ground
    double speed = 50;      // m/s, the most at the ground, without inflow (and without coriolis)
    double radius = 30000;  // m, where that is
    double shape = 1.5;     // Holland's B, 1 to 2.5 in nature
    double inflow = 0.35;   // rad, at the ground
    double height = 15000;  // m
    double coriolis = 0;    // 1/s, at least 0
    GlslCalls calls(const glm::dvec3& near) const;
};

struct FieldShape : std::variant<UniformField, OscillatingField, GustField, ShearField, VortexField, AbcField,
                                 TaylorGreenField, CurlNoiseField, GridField, WavesField, HurricaneField> {
    using variant::variant;
};

const Description& describe(const UniformField*);
const Description& describe(const OscillatingField*);
const Description& describe(const GustField*);
const Description& describe(const ShearField*);
const Description& describe(const VortexField*);
const Description& describe(const AbcField*);
const Description& describe(const TaylorGreenField*);
const Description& describe(const CurlNoiseField*);
const Description& describe(const FileSequence*);
const Description& describe(const GridField*);  // scene/field_files: its values are in files
const Description& describe(const WaveTrain*);
const Description& describe(const WavesField*);
const Description& describe(const HurricaneField*);

}  // namespace shoal
