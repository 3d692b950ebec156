// A run tells of itself while it goes on: strains, contacts, and an estimate of its error, in a share of
// its time.
//
// It reads the simulation back between frames and changes nothing of it: the run leaves the same bits. A
// reading is taken at most once a second; what it or a reference has taken is waited for so many times that
// all of it stays within the share. A reference is solved in another thread while frames go on.
#pragma once

#include "measure/stretches.h"

namespace shoal::measure {

class Diagnostics {
  public:
    // Borrows the simulation, copies what it needs of the scene. Reads nothing yet.
    Diagnostics(const Scene& scene, const Simulation& simulation, const DiagnosticsOptions& options = {});

    // Why the scene has no such quantity, where it says so; nothing: it has it.
    std::optional<Warning> lacks(Diagnostic quantity) const;
    // Once at the start and after each frame. Returns whether there is another reading.
    bool follow();
    // Takes the state as another one than the frames have made.
    void forget() {
        stretches_.forget();
        stepped_ = false;
    }
    // Takes a last reading, with references for about so many seconds.
    void finish(double seconds);
    // Nothing: none has been taken yet.
    const std::optional<Reading>& reading() const { return reading_; }

  private:
    void read();
    void readStrain(Reading& reading);
    void readContact(Reading& reading) const;

    const Simulation& simulation_;
    DiagnosticsOptions options_;
    Stretches stretches_;
    Duty duty_;
    double last_;           // s on the clock, of the last reading
    bool stepped_ = false;  // the last frame was followed, so that its contacts are those of the state
    struct GroupSprings {
        Molecule molecule;  // without muscles that a school steers
        MovingSample sample;
    };
    std::vector<GroupSprings> springs_;  // of each group
    Location scene_;
    std::optional<Reading> reading_;
};

}  // namespace shoal::measure
