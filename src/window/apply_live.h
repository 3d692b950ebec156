// Edits of a scene that a run takes while it goes on.
#pragma once

#include <optional>
#include <vector>

#include "core/json.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "simulate/simulation.h"

namespace shoal::window {

// What differs between two texts of a scene.
struct SceneDifference {
    struct Live {
        size_t group;  // of the scene
        bool looks, life, school;
    };
    std::vector<Live> live;   // of groups: what applyLive() takes
    bool picture = false;     // light, sky or camera: another renderer
    bool simulation = false;  // anything else
};
SceneDifference differenceOf(const JsonValue& before, const JsonValue& after);

// A group's index in a plan, which leaves out groups without molecules.
std::optional<size_t> planGroupOf(const Plan& plan, size_t group);

// Puts the looks, lives and schools in which the groups of two scenes differ into the run of the first. The
// run is then what it would be with a simulation of the second that goes on from its state. False: another
// simulation is needed, and nothing has changed.
bool applyLive(const std::vector<SceneDifference::Live>& edits, const std::vector<Group>& before,
               const std::vector<Group>& after, Simulation& simulation, Renderer& renderer);

}  // namespace shoal::window
