// The panel: Decker's interface (forces, number and kind of molecules), the clock, and what a frame costs.
#pragma once

#include <string>
#include <vector>

#include "render/renderer.h"
#include "simulate/simulation.h"

namespace shoal::app {

// What the sliders say. The simulation's parameters follow them over a fifth of a second, so that a sudden
// move does not kick the springs.
struct Controls {
    glm::dvec3 gravity{0};
    float gravityFactor = 1, wind = 1, drag = 1, stiffness = 1, damping = 1;
    std::vector<float> forces;  // factors on the strengths of the scene's
    int substeps = 4;
    bool paused = false;

    explicit Controls(const Plan& plan);
    void follow(const Parameters& parameters);  // as a run that was resumed has them
    void lead(Parameters& parameters, const Plan& plan, double seconds) const;
};

// The group that the panel edits: applied when the user lets go, because it makes a new simulation.
struct GroupChoice {
    int group = 0;
    int count = 0;
    int molecule = -1;  // index of `Panel::molecules`; -1: as in the scene
};

class Panel {
  public:
    enum class Action { none, step, restart, rebuild, switchPath, resetCamera };

    Panel(const Scene& scene, std::vector<std::string> moleculeFiles);

    // Draws the panel and returns what the user asked for in this frame.
    Action draw(Controls& controls, Simulation& simulation, Renderer& renderer, double frameSeconds,
                const gpu::Traffic& lastFrame);

    GroupChoice choice;
    Path path = Path::automatic;         // that runs, and after switchPath the one to go on with
    std::vector<std::string> molecules;  // files

  private:
    Action drawClock(Controls& controls, const Simulation& simulation);
    void drawForces(Controls& controls, const Simulation& simulation);
    Action drawGroups(const Simulation& simulation);
    Action drawPath(const Simulation& simulation);
    void drawCost(Simulation& simulation, Renderer& renderer, double frameSeconds,
                  const gpu::Traffic& lastFrame);

    std::vector<std::string> groupNames_;
    std::vector<int> groupCounts_;
    std::vector<bool> fixedCount_;  // placed one by one, or none at the start: the number cannot be changed
    std::vector<bool> particles_;   // which are of no other kind
    std::vector<std::string> forceNames_;
    std::string sceneName_;
};

}  // namespace shoal::app
