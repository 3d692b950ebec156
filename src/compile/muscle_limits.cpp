#include "compile/muscle_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "compile/school_plan.h"

namespace shoal {

namespace {

constexpr double shortest = 0.25;     // of the rest length
constexpr double fewestSubsteps = 8;  // of a beat

double lengthOf(const Molecule& molecule) {
    double low = 1e300, high = -1e300;
    for (const Vertex& vertex : molecule.vertices) {
        low = std::min(low, vertex.position.z);
        high = std::max(high, vertex.position.z);
    }
    return high - low;
}

// rad/s, of the spring between its own two masses.
double ownFrequency(const Molecule& molecule, const Group& group, const Spring& spring) {
    const double weight =
        1 / molecule.vertices[size_t(spring.a)].mass + 1 / molecule.vertices[size_t(spring.b)].mass;
    return std::sqrt(spring.stiffness * group.stiffness * weight);
}

}  // namespace

void checkMuscles(const Scene& scene, const Group& group, std::vector<Warning>& warnings) {
    const Molecule& molecule = group.molecule;
    const double length = lengthOf(molecule);
    double curvature = 0, tempo = 1;  // the most of them
    if (group.school && length > 0) curvature = group.school->bend / length;
    if (group.school && group.school->beat > 0) tempo = group.school->fastest / group.school->beat;
    const double substep = 1 / scene.frameRate / scene.solver.substeps;
    bool tight = false, quick = false, stiff = false;
    for (size_t s = 0; s < molecule.springs.size(); ++s) {
        const Spring& spring = molecule.springs[s];
        if (!spring.actuation) continue;
        const Location& where =
            s < molecule.places.springs.size() ? molecule.places.springs[s] : group.location;
        const double frequency = spring.actuation->frequency * tempo;
        const double left = 1 - spring.actuation->amplitude - std::abs(bendOf(molecule, spring)) * curvature;
        if (left <= 0.01)
            throw Error(where,
                        concat("a muscle of \"", group.name, "\" would be shorter than nothing: its beat ",
                               "takes ", spring.actuation->amplitude, " of its length, the bend of its ",
                               "school ", 1 - left - spring.actuation->amplitude));
        if (left < shortest && !std::exchange(tight, true))
            warnings.push_back({where, concat("a muscle of \"", group.name, "\" shrinks to ", left,
                                              " of its length: what it moves may turn inside out")});
        if (spring.actuation->amplitude == 0) continue;
        if (frequency * substep * fewestSubsteps > 1 && !std::exchange(quick, true))
            warnings.push_back({where, concat("a muscle of \"", group.name, "\" beats at up to ", frequency,
                                              " Hz, and a substep is ", substep,
                                              " s: ", std::ceil(fewestSubsteps * frequency / scene.frameRate),
                                              " substeps of a frame would follow it")});
        const double own = ownFrequency(molecule, group, spring) / (2 * std::numbers::pi);
        if (frequency > own && !std::exchange(stiff, true))
            warnings.push_back({where, concat("a muscle of \"", group.name, "\" beats at up to ", frequency,
                                              " Hz, and its spring follows up to ", own,
                                              " Hz: a stiffer spring or lighter vertices would")});
    }
}

}  // namespace shoal
