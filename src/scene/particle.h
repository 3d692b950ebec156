// A type of point particle: its mass and its looks. What changes with age is computed from age and seed where
// it is drawn, never stored [Latta 2004, section 3.3]. A group of particles has one type.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "molecule/molecule.h"

namespace shoal {

class Description;

// Limits of a type, inclusive. Beyond them products overflow single precision, or half precision in the light
// that is added up.
constexpr double leastParticleMass = 1e-12, mostParticleMass = 1e12;  // kg
constexpr double leastParticleSize = 1e-9, mostParticleSize = 1e6;    // m; growth too: a factor, from 0
constexpr double mostParticleTurn = 1e6;                              // rad, and rad/s
constexpr double mostParticleColor = 1000;
constexpr double mostParticlePixels = 64;
constexpr int mostTiles = 64;           // of an image along one side
constexpr double mostFrameRate = 1000;  // 1/s, of a flip-book

// Colour and opacity at a moment of a particle's life; between two they follow a straight line.
struct ColorKey {
    double age = 0;       // share of its life, in [0, 1]
    glm::dvec3 color{1};  // linear RGB, at least 0; more than 1 glows
    double opacity = 1;   // in [0, 1]
};
constexpr size_t mostColorKeys = 4;

// An image cut into columns x rows tiles, numbered from 0 at the upper left, along the rows.
struct ParticleImage {
    std::string file;                 // PNG with alpha
    int columns = 1, rows = 1;        // at least 1
    int firstTile = 0, lastTile = 0;  // those in use
    // Each particle shows one tile by its seed, or all of them one after another.
    bool flipBook = false;
    // 1/s, of a flip-book, which starts over, each particle somewhere else by its seed; 0: once, over the
    // particle's life.
    double frameRate = 0;
    bool blend = true;  // neighbouring frames of a flip-book fade into one another
};

enum class ParticleShape {
    points,   // of a fixed number of pixels: the cheapest
    sprites,  // GL_POINTS, turned and cut out of the image in the fragment stage [Latta 2004, section 3.4.6]
    quads,    // instances of four corners that all share [Kapoulkine 2008]
};
enum class ParticleFacing {
    camera,    // turned about the line of sight
    velocity,  // along the velocity, as seen by the camera; longer the faster
    free,      // turned in space, by a quaternion: about an axis of its own, from a rotation of its own
};
const char* name(ParticleShape shape);
const char* name(ParticleFacing facing);

struct ParticleType {
    double mass = 1;  // kg
    ParticleShape shape = ParticleShape::quads;
    ParticleFacing facing = ParticleFacing::camera;  // quads only
    double pixels = 2;                               // the diameter of shape points, at least 1
    glm::dvec2 size{0.02, 0.02};                     // m, the diameter: random between the two
    glm::dvec2 growth{1, 1};  // factors on the size at birth and at the end of life, at least 0
    glm::dvec2 turn{0, 0};    // rad at birth, random between the two
    glm::dvec2 spin{0, 0};    // rad/s, random between the two
    double stretch = 0;       // s: facing velocity, the length grows by this times the speed across the view
    std::vector<ColorKey> colors = std::vector<ColorKey>(1);  // 1 to mostColorKeys; ages rise
    std::optional<ParticleImage> image;                       // nothing: a round dot with a soft edge
    double softness = 0;  // m: with a blend, fades where a surface is nearer than this behind it; 0: does not
    bool lit = false;     // by sun and sky, as a ball, facing free as a sheet; else it sends its colour
    Blend blend = Blend::alpha;
    DrawSort sort = DrawSort::frame;  // with blend alpha
    int spreadFrames = 20;            // with sort spread
};

const Description& describe(const ColorKey*);
const Description& describe(const ParticleImage*);
const Description& describe(const ParticleType*);

// The keyframes as up to three straight pieces that are added up (shaders/particles/attributes.glsl).
struct ColorPieces {
    glm::vec4 first{1};                                  // linear RGB and opacity
    std::array<glm::vec4, mostColorKeys - 1> changes{};  // of each piece
    glm::vec3 begins{0}, perAge{0};                      // ages, and 1 / their lengths; 0: no piece
};
ColorPieces colorPieces(const std::vector<ColorKey>& keys);

// Between its neighbours in age, so that the keyframes stay in order.
double ageBetween(const std::vector<ColorKey>& keys, size_t key, double age);
// A keyframe more, in the middle of the widest gap and of the colour that is there. Does nothing where there
// are mostColorKeys, or no gap.
void addColorKey(std::vector<ColorKey>& keys);

// Warns of what changes with age in a type, and so never shows in a group that lives for ever.
std::vector<Warning> agelessWarnings(const ParticleType& type, const Location& where);

// The molecule of one vertex that stands for the type.
Molecule moleculeOf(const ParticleType& type);

}  // namespace shoal
