// What a headless run tells of itself, and what is required of it (--require).
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/line/options.h"
#include "measure/diagnostics.h"

namespace shoal::app {

class RunDiagnostics {
  public:
    // Borrows all of it. WrongUse: something is required that the scene does not have.
    RunDiagnostics(const Options& options, const Scene& scene, const Simulation& simulation);

    // Once at the start and after each frame. Returns whether there is another reading.
    bool follow();
    // Takes the last reading. `whole`: the run has come to its end, so that what it does not know of itself
    // by then does not hold, and references that are required are worth a wait.
    void finish(bool whole);
    // Which requirement does not hold, and why, in a line; empty: all hold, as far as is known.
    const std::string& broken() const { return broken_; }

    std::string shortText() const { return measure::shortText(*diagnostics_.reading()); }
    void print(std::ostream& out) const;  // all of the last reading
    JsonValue json() const;               // the last reading, and all of them

  private:
    void take(bool end);

    const Options& options_;
    bool judgesError_;  // so that a reference may take longer
    measure::Diagnostics diagnostics_;
    std::vector<measure::Reading> readings_;
    std::string broken_;
};

}  // namespace shoal::app
