// The states and pictures that a device must come to: computed once, small enough to ship
// (models/golden/states.json and pictures.png; docs/testing.md says how they are made).
//
// Each group has a handful of statistics, and some vertices where these can be foretold. A tolerance is eight
// times the change of a figure when every vertex is shifted by a rounding or two (3e-7 of its place) every
// tenth frame, and at least 2e-4 of the figure's scale. Where these shifts move vertices by more than a
// quarter of a molecule, as they do after a while with contact and births, the vertices' places are chance,
// and only the statistics are stored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "bench/runner.h"
#include "core/image.h"
#include "core/json.h"
#include "simulate/simulation.h"

namespace shoal::bench {

struct StoredGroup {
    std::string name;
    std::vector<double> statistics, tolerances;  // of statisticNames()
    std::vector<glm::dvec3> vertices;            // m, of sampledVertices(); empty: chance
    double vertexTolerance = 0;                  // m
};

struct StoredState {
    std::string name;
    int frames = 0;
    std::vector<StoredGroup> groups;
};

struct StoredStates {
    std::vector<StoredState> states;
    std::vector<std::string> pictures;  // the names of the rows of the sheet, from the top
    const StoredState* find(const std::string& name) const;
};

// Error: the file is missing or not ours.
StoredStates readStoredStates(const std::string& file);
JsonValue asJson(const StoredStates& stored);

// How far a state is from the stored one: its worst figure over that figure's tolerance, and which it is.
struct Mismatch {
    double ofTolerance = 0;
    std::string worst;
};
Mismatch mismatch(const Simulation& simulation, const StoredGroup& stored, size_t group);

// Runs the scene, shifted and not. Error: the driver's, a state that runs away.
StoredState recordState(const std::string& name, const Scene& scene, int frames, const BenchDevice& device);

// ---- Pictures
// The means of a picture's blocks are stored, which rasterisers agree on better than on pixels: 48 x 27
// of them, one above the other in one sheet.
constexpr int blockColumns = 48, blockRows = 27, blockSide = 10;  // pixels

// Draws blockColumns * blockSide x blockRows * blockSide pixels of a simulation; this room does not know how.
using PictureMaker = std::function<Image(const Scene&, const Simulation&)>;
constexpr int picturedFrames = 30;
// The blocks of a scene after picturedFrames.
Image recordPicture(const Scene& scene, const BenchDevice& device, const PictureMaker& draw);

Image blockMeans(const Image& picture);
// Mean over the channels of two pictures of blocks, of 255, over what devices may differ by; `row` of the
// sheet.
Mismatch pictureMismatch(const Image& blocks, const Image& sheet, int row);

}  // namespace shoal::bench
