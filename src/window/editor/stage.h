// Where the molecule that is edited lives: one of it, simulated and drawn as in any scene, in wind, dropped
// on a plane, or still. It follows what is edited while it moves; springs' numbers within a frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "molecule/analysis.h"
#include "render/renderer.h"
#include "simulate/simulation.h"

namespace shoal::window {

struct StageSettings {
    enum class Around { still, wind, drop };
    Around around = Around::wind;
    double wind = 4;        // m/s
    double gravity = 9.81;  // m/s^2, but for still
    double drag = 6;        // 1/s, across the surface; along it a fifth
    bool pinsHold = true;
    bool floorShows = true;
    int substeps = 8;                  // of a frame of 1/60 s
    std::optional<SolverKind> solver;  // nothing: chosen by the stiffness
    bool operator==(const StageSettings&) const = default;
};

class EditorStage {
  public:
    static constexpr double frameRate = 60;  // Hz

    explicit EditorStage(gpu::Context& context);

    // Shows a valid molecule, played by `settings`; takes over what differs from before. Error: compile's;
    // the stage goes on as it was.
    void show(const Molecule& molecule, const StageSettings& settings);
    bool ready() const { return simulation_ != nullptr; }

    bool playing = false;
    // One frame, if it plays. What ran away stops, and the message says so; else empty.
    std::string advance();
    void step();           // one frame
    void rewind();         // to the rest shape
    void seek(int frame);  // one that was played
    int frame() const { return frame_; }
    int frames() const { return int(played_.size()); }  // that were played, the rest shape with them
    double time() const { return frame_ / frameRate; }  // s
    bool moved() const { return ready() && (playing || frame_ > 0); }  // or it moves: it is not as edited

    // A vertex that the pointer holds follows it. Nothing: none is held.
    struct Pull {
        int vertex = 0;
        glm::dvec3 target{0};  // m
    };
    std::optional<Pull> pull;
    // Shows a motion instead of playing: rest shape + shape * reach (m).
    void wobble(const Mode& mode, double reach);
    void rest() {  // back to what was played
        if (wobbling_) seek(frame_);
    }

    const gpu::Texture& draw(const View& view, int width, int height);  // the picture
    Image picture(const View& view, int width, int height);
    // Positions of the vertices as they are drawn, m.
    const std::vector<glm::dvec3>& positions() const { return positions_; }

    SolverKind solver() const { return simulation_->plan().groups[0].solver; }
    const std::string& solverWhy() const { return simulation_->plan().groups[0].solverWhy; }

  private:
    Scene sceneOf(const Molecule& molecule, const StageSettings& settings) const;
    void rebuild(Plan plan, bool goOn);
    void takePositions() { positions_ = simulation_->snapshot(0).positions; }
    void applyPull();

    gpu::Context* context_;
    Scene scene_;
    StageSettings settings_;
    Molecule drawn_;  // that the renderer was made for
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Renderer> renderer_;
    std::vector<SavedState> played_;
    int frame_ = 0;
    double floor_ = 0;  // m
    std::vector<glm::dvec3> positions_;
    bool wobbling_ = false;
};

// The cost of stepping the molecule, measured with many of it on this machine.
struct MoleculeCost {
    double secondsPerMolecule = 0;  // of a frame, simulate only
    int measuredAt = 0;             // molecules
    std::string machine;            // in words
};
// Steps `count` of the molecule in a field of gusts for about a tenth of a second. Error: compile's.
MoleculeCost measureCost(gpu::Context& context, const Molecule& molecule, const StageSettings& settings,
                         int count = 4096);

}  // namespace shoal::window
