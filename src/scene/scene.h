// A scene: everything a run needs, in the words of the scene file. Anything left out is not simulated.
// SI units, radians, right-handed, +Y up. Every default below is the file's default.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/error.h"
#include "geometry/mesh.h"
#include "molecule/molecule.h"
#include "scene/collider.h"
#include "scene/color_scale.h"
#include "scene/emitter.h"
#include "scene/field.h"
#include "scene/force.h"
#include "scene/particle.h"
#include "scene/placement.h"
#include "scene/school.h"
#include "scene/solver.h"
#include "scene/water.h"

namespace shoal {

class Description;

// ---- Models

// The look of a model's drawn grain.
enum class GrainKind {
    earth,  // soil and grass on what faces up, else bark
    stone,  // pits and stains, alike in all directions
};

struct Model {
    std::string name, file;
    glm::dvec3 position{0};
    glm::dquat rotation{1, 0, 0, 0};
    double scale = 1;
    bool stand = false;  // its lowest point is at `position`'s height, instead of its origin
    bool draw = true;
    glm::dvec3 color{1};              // multiplies its own
    std::optional<double> roughness;  // in [0, 1]; nothing: as its materials say
    double grain = 0;                 // strength of the drawn grain, in [0, 1]
    GrainKind grainOf = GrainKind::earth;
    Mesh mesh;  // in scene coordinates: position, rotation and scale applied
};

// ---- Groups of molecules

// Stokes drag rate in 1/s (gamma = 6 pi eta r / m for a sphere of radius r and mass m).
struct Drag {
    double normal = 0;   // across the surface
    double tangent = 0;  // along it; equal to `normal` for plain drag
    bool directional() const { return normal != tangent; }
    bool any() const { return normal != 0 || tangent != 0; }
};

// Pins are released when the springs pull on one by more than `force`, or at random at `rate`.
struct Release {
    std::optional<double> force;  // N
    std::optional<double> rate;   // 1/s, per molecule
    double after = 0;             // s: not before this time
};

// Contact with other molecules: spheres of one radius at the vertices, and where asked on the triangles,
// which those leave uncovered.
struct GroupContact {
    double radius = 0;       // m, times the instance's scale; in a file: what closes the gaps, unless given
    bool triangles = false;  // a sphere at the middle of each triangle, too
    bool closed = false;     // spheres on edges and triangles, so close that nothing like them passes
    bool self = false;       // also between spheres of one molecule that are apart in its rest shape
    Location location;
};

// A group holds at most this many molecules, if memory does.
constexpr int maxGroupCount = 1 << 30;

struct Group {
    std::string name;
    Molecule molecule;
    std::optional<ParticleType> particle;  // then `molecule` is the type's
    int count = 0;                         // at the start
    Placement place;
    std::optional<Lifecycle> life;  // nothing: none is born and none dies
    std::optional<School> school;   // nothing: they do not steer
    Drag drag;
    bool held = true;  // pinned vertices hold; false: they are free from the start
    std::optional<Release> release;
    double stiffness = 1, damping = 1;  // factors on every spring of the molecule
    glm::dvec3 velocity{0};             // m/s at the start
    glm::dvec3 spin{0};                 // rad/s at the start, about the molecule's placed origin
    double phaseSpread = 0;             // rad: actuation phase varies by up to this between instances
    bool collide = true;
    std::optional<GroupContact> contact;           // nothing: molecules of the group pass through one another
    std::string surface;                           // what it is made of, for surfacePairs
    double restitution = 0.2, friction = 0.5;      // against other groups
    std::optional<glm::dvec3> color, secondColor;  // override the molecule's material
    // Share by which the brightness of instances varies, in [0, 1]; nothing: usualVariation with a second
    // colour, else 0.
    std::optional<double> variation;
    std::optional<ColorScale> colorBy;  // in place of those
    Location location;                  // of the group in the file, for messages
};

// The colours that the instances of a group of molecules lie between, and how their brightness varies
// (shaders/render/looks.glsl).
struct InstanceColors {
    glm::dvec3 first{0}, second{0};  // linear RGB
    double variation = 0;
};
InstanceColors instanceColors(const Group& group);
constexpr double usualVariation = 0.2;

// ---- The rest

constexpr int maxSubsteps = 1000;  // of a frame

// Where and how often fields are read. What is read once a frame is read where the molecule will be in the
// middle of the frame, at that time, which keeps an error of second order in the frame.
enum class FieldSampling {
    vertexSubstep,  // at every vertex, every substep: as exact as the solver
    vertexFrame,    // at every vertex, once a frame
    moleculeFrame,  // at the molecule's middle, once a frame
};
const char* name(FieldSampling sampling);

struct SolverSettings {
    std::optional<SolverKind> kind;  // nothing: chosen for each group (compile/choose_solver.h)
    int substeps = 4;                // per frame
    FieldSampling fieldSampling = FieldSampling::vertexSubstep;
    Location location;
};

// How spheres that may touch are found (compile/contact_plan.h).
enum class ContactSearch {
    exact,      // all 27 cells around a sphere
    single,     // UberFlow: neighbours in the order of the cells
    staggered,  // UberFlow: the same on a second grid, moved by half a cell, as well
};
const char* name(ContactSearch search);

enum class ContactResponse {
    simultaneous,  // all that touch at once
    nearest,       // UberFlow: the nearest one only; loses momentum where three meet
};
const char* name(ContactResponse response);

struct ContactSettings {
    ContactSearch search = ContactSearch::exact;
    ContactResponse response = ContactResponse::simultaneous;
    int neighbors = 8;  // of the UberFlow searches, to either side
    int steps = 0;      // contact steps of a frame; 0: one a substep
    static constexpr int mostIterations = 256;
    int iterations = 0;             // of the simultaneous response, at most; 0: as many as its masses take
    double tolerance = 5e-4;        // the residual at which they end
    std::optional<double> fastest;  // m/s, relative to one another: none passes through another up to this
    std::optional<double> rest;     // m/s: what moves more slowly for a while rests; nothing: nothing does
    std::optional<double> cell;     // m; nothing: as large as the largest spheres need
    Location location;
};

struct Camera {
    glm::dvec3 eye{0, 2, 8}, target{0, 1, 0};
    double fieldOfView = 0.8;  // rad, vertical
    double exposure = 1;
};

struct Light {
    glm::dvec3 direction{-0.4, -1, -0.3};  // in which sunlight travels
    glm::dvec3 color{1, 0.95, 0.85};
    double intensity = 3.2;
    bool shadows = true;
};

struct Sky {
    glm::dvec3 zenith{0.18, 0.36, 0.72}, horizon{0.74, 0.82, 0.88}, ground{0.22, 0.2, 0.16};
    double intensity = 1;
    double fog = 0;        // 1/m: how fast the horizon's colour covers things
    double clouds = 0;     // share of the sky that they cover, in [0, 1]
    double occlusion = 1;  // in [0, 1]: how much of what near things hide of its light is missing
};

struct Scene {
    std::string name, comment, file;
    uint64_t seed = 1;
    double frameRate = 60;  // Hz: one frame simulates 1 / frameRate seconds
    glm::dvec3 gravity{0};  // m/s^2
    SolverSettings solver;
    ContactSettings contact;  // means something where groups have contact
    std::vector<Field> fields;
    std::vector<Force> forces;
    std::vector<Collider> colliders;
    std::vector<SurfaceRule> surfacePairs;
    std::vector<Model> models;
    std::vector<Group> groups;
    Camera camera;
    Light light;
    Sky sky;
    std::optional<Water> water;     // nothing: all is in the air
    std::vector<Warning> warnings;  // found while reading
};

const Description& describe(const Model*);
const Description& describe(const Drag*);
const Description& describe(const Release*);
const Description& describe(const GroupContact*);
const Description& describe(const Group*);
const Description& describe(const SolverSettings*);
const Description& describe(const ContactSettings*);
const Description& describe(const Camera*);
const Description& describe(const Light*);
const Description& describe(const Sky*);
const Description& describe(const Scene*);

// Where one molecule of a group starts.
struct Instance {
    glm::dvec3 position{0};
    glm::dquat rotation{1, 0, 0, 0};
    double scale = 1;
    uint32_t seed = 0;
};

// Calls visit(i, instance) for each of the group.count instances, from several threads at once and in any
// order. Instance i is deterministic in (scene.seed, the group's index, i). Error (located at the group):
// nothing matches the selection.
void forEachInstance(const Scene& scene, size_t group,
                     const std::function<void(size_t, const Instance&)>& visit);
// All of them in their order.
std::vector<Instance> place(const Scene& scene, size_t group);

}  // namespace shoal
