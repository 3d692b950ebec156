// The error of contact between molecules against what it costs: a scene is run with growing numbers of
// substeps, which are as many contact steps unless the scene says how many, and of iterations. Nothing rests.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/accuracy.h"

namespace shoal::measure {

// What contact has got wrong in a run.
struct ContactErrors {
    // Depths over the radius of the smaller sphere: RMS over the contacts at the ends of all frames, and the
    // largest of them.
    double overlap = 0, largestOverlap = 0;
    // What all molecules together gain from the end of a frame to that of a later one, at most, over E: the
    // largest kinetic energy, at least the work of their weight over a radius. Restitution, friction and drag
    // only take. Nothing where something else moves them: ContactCurve::driven.
    std::optional<double> energyGiven;
    // Length of the change of momentum in a frame after the run in which neither gravity nor colliders act,
    // over the sum of m |v| and of the weights times that frame. Nothing where pins hold.
    std::optional<double> momentum;
};

struct ContactPoint {
    int substeps = 1, iterations = 1;  // of a frame; of a contact step, at most
    Outcome outcome = Outcome::leftOut;
    std::string why = {};  // of a refusal, or what was left out
    ContactErrors errors = {};
    double contacts = 0;  // of a contact step, mean over the frames
    int steps = 1;        // contact steps of a frame
    Spread time = {};     // s a frame, over whole runs, in turn; no samples: not timed
    bool front = false;   // no other is both faster and has less overlap
    bool scenes = false;  // what the scene runs with
    double secondsPerContact() const { return contacts > 0 ? time.min / (contacts * steps) : 0; }
};

struct ContactCurve {
    std::string scene, solver;  // solvers of its groups
    double frameRate = 60, duration = 1;
    int molecules = 0, spheres = 0;
    std::string
        driven;  // what moves the molecules but gravity, so that their energy may grow; empty: nothing
    std::vector<ContactPoint> points;  // by substeps, then iterations
    std::vector<std::string> notes;
};

struct ContactCurveOptions {
    double duration = 1;                 // s of simulated time, rounded to whole frames
    std::vector<int> substeps = {};      // empty: the scene's, a half, twice and four times as many
    std::vector<int> iterations = {};    // empty: the scene's, and from a quarter to four times as many
    int rounds = 3;                      // runs of each that are timed
    std::optional<double> seconds = {};  // of all of it, about; the scene's own point comes first
    std::function<void(double share)> tell = [](double) {};
};

// Error: no group of the scene has contact between molecules; nothing of it can run.
ContactCurve measureContact(const Scene& scene, const ContactCurveOptions& options,
                            const AccuracyDevice& device);

// Sets ContactPoint::front of all that were timed.
void markFront(std::vector<ContactPoint>& points);

}  // namespace shoal::measure
