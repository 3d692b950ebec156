// The error of a run, estimated as it goes on: sampled molecules are read twice, a second of simulated time
// apart, and the double-precision reference goes the same way from the first of these states.
#pragma once

#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "measure/accuracy_reference.h"
#include "measure/reading.h"
#include "measure/timing.h"
#include "simulate/packed_state.h"

namespace shoal::measure {

struct DiagnosticsOptions {
    double share = 0.01;        // of the time on the clock that all of it may take
    double interval = 1;        // s on the clock, between two readings
    double duration = 1;        // s of simulated time, after which an error is taken
    int molecules = 32;         // of each group, at once
    double leastSeconds = 0.1;  // that a molecule's reference may take, however short the run is
    std::function<double()> clock = steadySeconds;
};

// Lets a work that is done once in a while take a share of the time on the clock.
class Duty {
  public:
    explicit Duty(double share) : share_(share) {}
    bool allows(double moment) const { return moment >= next_; }
    void took(double seconds, double moment) { next_ = std::max(next_, moment) + seconds / share_; }

  private:
    double share_, next_ = 0;  // next_: s
};

// Goes through the molecules of a group, some at a time.
class MovingSample {
  public:
    MovingSample(int count, int size) : count_(count), size_(std::min(count, size)) {}
    MoleculeRange next();

  private:
    int count_, size_, first_ = 0;
};

// A molecule as it is read.
struct SampledState {
    double scale = 1, phase = 0;  // phase: rad
    bool alive = true, released = false;
    reference::State state;
};
std::vector<SampledState> readSample(const Simulation& simulation, size_t group, const MoleculeRange& range);

class Stretches {
  public:
    // Borrows the simulation, copies what it needs of the scene. Reads nothing yet.
    Stretches(const Scene& scene, const Simulation& simulation, const DiagnosticsOptions& options);
    ~Stretches();

    // Once at the start and after each frame; once more changes nothing. False: the state is not that of a
    // frame which was followed. Where time and frames have not gone on by one, or parameters are others, all
    // begins anew.
    bool follow();
    // Forgets what was read: the state is another.
    void forget();
    // Takes the reference of what is open, in about so many seconds. Where no error was taken so far, the
    // stretch that goes on ends here.
    void finish(double seconds);
    // Error, energy, and of what they are.
    void tell(Reading& reading) const;
    // Why groups have no error.
    const std::vector<Warning>& unknownGroups() const { return unknown_; }

  private:
    struct GroupReference;
    struct Open;
    struct Ended;
    struct Judged {
        size_t group = 0;
        int molecule = 0;
        std::optional<double> error;      // nothing: not known
        double energy = 0, duration = 0;  // of E, s
        double seconds = 0;               // on the clock, that it took
    };

    void open();
    void close();
    std::function<Judged()> nextJudgement();
    void take(Judged judged);
    std::string nameOf(const Judged& judged) const;

    const Simulation& simulation_;
    DiagnosticsOptions options_;
    Duty duty_;
    double begun_;                                         // s on the clock
    std::vector<std::shared_ptr<GroupReference>> groups_;  // null: has none
    std::vector<MovingSample> samples_;
    std::vector<Warning> unknown_;
    std::unique_ptr<Open> open_;
    std::deque<Ended> ended_;    // that wait for their reference
    double endedAt_ = 0;         // s on the clock
    std::deque<Judged> judged_;  // the last
    std::future<Judged> judging_;
    bool outdated_ = false;  // what is being judged
    bool stepped_ = false;   // to the state by a frame that was followed
    Parameters parameters_;
    int frames_;
    double time_;  // s
};

}  // namespace shoal::measure
