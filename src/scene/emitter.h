// Birth and death: what is born where, when and how, how long it lives, and how many there may be.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"
#include "scene/collider_path.h"
#include "scene/placement.h"

namespace shoal {

class Description;
struct Model;

// How a newborn finds a free place in its group. All but `ring` emit nothing while the group is full, and
// count what was not emitted.
enum class Allocator {
    gpu,    // the smallest free places, found on the GPU: no byte crosses the bus
    ring,   // one after another, over the oldest (UberFlow's time stamp modulo the capacity)
    stack,  // the place that was freed last, from the CPU [Latta 2004, section 3.4.1]
    heap,   // the smallest free place, from the CPU (the same)
};
const char* name(Allocator allocator);

constexpr double longestLife = 1e30;  // s: for ever

struct Burst {
    double time = 0;   // s
    int count = 1;     // at least 1, all at that moment
    double every = 0;  // s: again and again; 0: once
};

struct Emitter {
    enum class From {
        point,
        line,    // between two points
        disc,    // about `position`, across `direction`
        sphere,  // about `position`
        box,
        surface,  // of a model, each patch by its area
        death,    // where one of another group dies
    };
    std::string name;
    From from = From::point;
    glm::dvec3 position{0};             // m: point, disc, sphere
    glm::dvec3 lineFrom{0}, lineTo{0};  // m
    double radius = 0;                  // m: disc, sphere
    double hollow = 0;                  // in [0, 1]: disc, sphere: the share of the radius that is left out
    Box box;
    int model = -1;     // surface
    Selection select;   // surface
    std::string group;  // death: its name

    double rate = 0;      // 1/s, at least 0
    bool random = false;  // at random moments of that rate (Poisson); else evenly spaced
    double begin = 0, end = std::numeric_limits<double>::infinity();  // s: of the rate
    std::vector<Burst> bursts;
    int perDeath = 1;  // death: newborn for each

    // Velocity at birth: in a cone about the direction, each solid angle alike, plus a share of the emitter's
    // or of what died.
    enum class Along {
        direction,
        outward,  // from the middle of a disc or sphere; a surface's normal; any way from a point or death
    };
    Along along = Along::direction;
    glm::dvec3 direction{0, 1, 0};     // unit
    double spread = 0;                 // rad, in [0, pi]: half the cone's opening
    glm::dvec2 speed{0, 0};            // m/s, random between the two
    double inherit = 0;                // share of the velocity of the emitter's path, or of what died
    std::optional<ColliderPath> path;  // the emitter moves: poses as of a collider

    Location location;  // in the file, for messages
};

const char* name(Emitter::From from);

// Where newborn start, without the emitter's path and its radius.
struct EmitterPlace {
    glm::dvec3 middle{0};  // m, of a line its start; of what dies anything
    Box box;               // m: all of it
};
EmitterPlace placeOf(const Emitter& emitter, const std::vector<Model>& models);

// Describes birth and death in a group.
struct Lifecycle {
    int capacity = 0;  // places, at least the group's count
    Allocator allocator = Allocator::gpu;
    std::vector<Emitter> emitters;
    glm::dvec2 life{longestLife};        // s, above 0: random between the two
    std::optional<Box> within;           // dies outside
    std::optional<double> afterContact;  // s, at least 0: what touches a collider has only so long to live
    glm::dvec2 scale{1, 1};              // of newborn molecules, random between the two
    Placement::Turn turn = Placement::Turn::any;  // of newborn molecules
    double grow = 0, shrink = 0;  // s: molecules are drawn growing at birth and shrinking before death
    glm::dvec3 spin{0};           // rad/s: newborn molecules, about each axis up to this either way
    Location location;
};

const Description& describe(const Burst*);
const Description& describe(const Emitter*);
const Description& describe(const Lifecycle*);

// The capacity of a file that gives none: as many as can be alive at once, and a twentieth more, with `count`
// at the start. Nothing where nobody can say, or where they are more than a group may have.
std::optional<int> usualCapacity(int count, const Lifecycle& life);
double mostAlive(int count, const Lifecycle& life);  // at once, and a twentieth more
bool emitsFromDeaths(const Lifecycle& life);

}  // namespace shoal
