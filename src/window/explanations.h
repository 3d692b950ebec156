// Drawings among the molecules that show how they work: springs by their strain, arrows of the fluid's
// velocity on a slice, and the molecule that was picked.
#pragma once

#include <optional>
#include <vector>

#include "render/lines.h"
#include "render/renderer.h"
#include "simulate/pick.h"
#include "simulate/simulation.h"

namespace shoal::window {

struct ExplanationSettings {
    bool springs = false;
    double strainShown = 0.1;  // at which a spring's colour is full
    bool field = false;
    int across = 1;          // the axis across the slice of arrows: 0 x, 1 y, 2 z
    double lineWidth = 1.5;  // pixels
    double sliceShift = 0;   // m, of the slice from what the camera looks at
};

class Explanations : public Overlay {
  public:
    Explanations(gpu::Context& context, const Scene& scene, const Plan& plan);

    ExplanationSettings settings;
    std::optional<PickedMolecule> picked;

    // Before a picture: what the CPU computes of it.
    void prepare(const Scene& scene, const Simulation& simulation, const View& view);
    void draw(const StateView& state, const DrawInputs& inputs) override;
    bool any() const { return settings.springs || settings.field || picked; }
    double fastest() const { return fastest_; }  // m/s, of the arrows: the longest ones

  private:
    SpringLines springs_;
    LineDrawer lines_;
    std::vector<Line> arrows_;
    double fastest_ = 0;
};

}  // namespace shoal::window
