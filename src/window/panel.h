// The panel: Decker's interface (forces, number and kind of molecules), the clock, how it is solved, and what
// a frame costs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "simulate/simulation.h"
#include "window/explanations.h"
#include "window/running_scene.h"

namespace shoal::window {

// The values of the sliders. The simulation's parameters follow them over a fifth of a second, so that a
// sudden move does not kick the springs.
struct Controls {
    glm::dvec3 gravity{0};
    float gravityFactor = 1, wind = 1, drag = 1, stiffness = 1, damping = 1;
    std::vector<float> forces;              // factors on the strengths of the scene's
    std::vector<float> fields;              // factors on the weights of the scene's
    int substeps = 4, plannedSubsteps = 4;  // the plan's own
    bool paused = false;

    explicit Controls(const Plan& plan);
    void follow(const Parameters& parameters);  // as a run that was resumed has them
    void follow(const Plan& plan);              // of a scene that was built anew: what the user moved stays
    void lead(Parameters& parameters, const Plan& plan, double seconds) const;
};

class Panel {
  public:
    enum class Action { none, step, restart, rebuild, switchPath, resetCamera, scenes, measure };

    explicit Panel(const Scene& scene);
    void follow(const Scene& scene);  // that was built anew

    // Draws the panel and returns what the user asked for in this frame.
    Action draw(Controls& controls, Simulation& simulation, Renderer& renderer, Explanations& explanations,
                double frameSeconds, const gpu::Traffic& lastFrame);

    // Puts the choices for which draw() asks for a rebuild into `choices`.
    void apply(Choices& choices) const;
    std::string error;            // of the method, as measured; empty: it was not
    Path path = Path::automatic;  // that runs, and after switchPath the one to go on with

  private:
    Action drawClock(Controls& controls, const Simulation& simulation);
    void drawForces(Controls& controls, const Simulation& simulation);
    Action drawGroups(const Simulation& simulation);
    Action drawMethod(Controls& controls, const Simulation& simulation);
    void drawView(Explanations& explanations, const Simulation& simulation);
    void drawCost(Simulation& simulation, Renderer& renderer, double frameSeconds,
                  const gpu::Traffic& lastFrame);

    struct Listed {
        std::string name;
        int count = 0;           // as in the scene
        bool fixed = false;      // placed one by one, or none at the start: the number cannot be changed
        bool particles = false;  // which are of no other kind
        std::string molecule;    // chosen file; empty: as in the scene
        int chosen = 0;          // count
    };
    std::vector<Listed> groups_;
    std::vector<std::string> molecules_;  // files to choose from
    int group_ = 0;                       // of groups_, that is shown
    std::optional<int> solver_;           // chosen: of solverWords()
    std::vector<std::string> forceNames_, fieldNames_;
    std::string sceneName_;
};

}  // namespace shoal::window
