// The quantities that a scene is looked at for where paths part: numbers of each molecule of a group at one
// time. Pure functions of arrays, one entry a molecule, in SI units.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "simulate/simulation.h"

namespace shoal::measure {

// Centres of mass of the molecules that live.
struct Centers {
    std::vector<glm::dvec3> positions, velocities;  // m, m/s
    std::vector<int> molecules;                     // their numbers in the group
    size_t size() const { return positions.size(); }
};
// `masses`: of the vertices of one molecule, kg.
Centers centersOf(const Snapshot& snapshot, const std::vector<double>& masses);

std::vector<double> heights(const Centers& centers, const glm::dvec3& up);  // m, along a unit vector
std::vector<double> spreads(const Centers& centers);                        // m, from their mean position
std::vector<double> speeds(const Centers& centers);                         // m/s
std::vector<double> nearestDistances(const Centers& centers);               // m; of at least two

// The cosine between a molecule's velocity and the mean of all unit velocities; their mean is the
// polarisation, the length of that mean vector [Vicsek 1995]. What moves more slowly than `slowest`, m/s,
// has no direction: its unit velocity is 0.
std::vector<double> alignments(const Centers& centers, double slowest);

// The share of a ball around each centre, of this radius, that contact spheres fill, those of all molecules;
// where they overlap they count twice. `radii`: one a sphere, m.
std::vector<double> packings(const Centers& centers, const std::vector<glm::dvec3>& spheres,
                             const std::vector<double>& radii, double radius);
// m^3, that two balls have in common.
double commonVolume(double distance, double first, double second);

// The slope, in rad, of the cone of even density that has the molecules' mean height above the lowest one and
// their RMS distance from the upright axis through their mean position: height/4 and sqrt(3/10) radius.
double reposeAngle(const Centers& centers, const glm::dvec3& up);

}  // namespace shoal::measure
