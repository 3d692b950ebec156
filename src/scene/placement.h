// Where the molecules of a group start, or are born.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/box.h"

namespace shoal {

class Description;

// Which vertices or triangles of a model may carry molecules. All conditions that are given must hold.
struct Selection {
    // The thinnest share, in (0, 1], of the vertices that meet all other conditions: the smallest branches.
    std::optional<double> thinnest;
    std::optional<double> maxThickness;  // m: local thickness (shape diameter) at most this
    std::string object;                  // name of an object of the model; empty: all
    std::optional<glm::dvec3> color;     // vertex colour within colorTolerance per channel
    double colorTolerance = 0.1;
    std::optional<double> minHeight, maxHeight;  // m, along y

    bool operator==(const Selection&) const = default;
};

struct Placement {
    enum class Kind { vertices, surface, volume, grid, list };
    Kind kind = Kind::volume;
    int model = -1;  // index of the scene's model, for vertices and surface
    Selection select;
    Box box;                           // volume
    glm::dvec3 origin{0}, spacing{1};  // grid
    glm::ivec3 cells{1};               // grid: counts along x, y, z
    struct Item {
        glm::dvec3 position{0};
        glm::dquat rotation{1, 0, 0, 0};
        double scale = 1;
    };
    std::vector<Item> items;  // list

    // Where the molecule's +Y points before turning. In files: normal on vertices and surfaces.
    enum class Align { none, up, normal };
    Align align = Align::none;
    // Random turn about that axis, or any rotation. In files: none for lists, whose items say how they stand.
    enum class Turn { none, yaw, any };
    Turn turn = Turn::yaw;
    double tilt = 0;         // rad: then tipped by up to this much in a random direction
    double droop = 0;        // in [0, 1]: the axis is bent this share of the way to straight down
    glm::dvec2 scale{1, 1};  // random between the two
    double offset = 0;       // m along the axis, before it is bent

    bool onModel() const { return kind == Kind::vertices || kind == Kind::surface; }
};

const Description& describe(const Selection*);
const Description& describe(const Placement::Item*);
const Description& describe(const Placement*);

}  // namespace shoal
