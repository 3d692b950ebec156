// The beam that a sheet or a body is: bending by Euler and Bernoulli, of a body with the shear of
// Timoshenko, without the inertia of turning sections. It is what a molecule of few vertices is compared
// with.
#pragma once

#include <vector>

#include "author/mass_spread.h"

namespace shoal {

// What a beam is of. A body is as thick as it is.
struct BeamMaterial {
    double modulus = 1, density = 1;  // Pa, Young's; kg/m^3
    double thickness = 0;             // m, of a sheet; 0: a body
};

// In slices of equal length along an axis, from its low end.
struct Beam {
    double low = 0, step = 0;      // m
    std::vector<double> mass;      // kg
    std::vector<double> bending;   // N m^2: E I
    std::vector<double> softness;  // 1/N: 1 / (kappa G A); 0 of a sheet

    double high() const { return low + step * double(mass.size()); }
    double middle(size_t slice) const { return low + (double(slice) + 0.5) * step; }
    // Whether every section holds: none is empty.
    bool whole() const;
    // Between the values of two slices.
    double valueAt(const std::vector<double>& values, double place) const;
    // The part beyond a place of the axis.
    Beam from(double place) const;
    // The same seen from the other end: places change their sign.
    Beam turned() const;
};

// Bends along spread.axis, across it along spread.thin.
// Of a sheet, or of what a closed mesh encloses, whose triangles face outwards.
Beam beamOf(const Mesh& mesh, const MassSpread& spread, const BeamMaterial& material);

// m, at a place, of a beam that is clamped at its low end, under its own weight at `gravity`, m/s^2, and a
// load on its end, N.
double sagOf(const Beam& beam, double place, double gravity, double load);
struct BeamMode {
    double frequency = 0;       // Hz
    std::vector<double> shape;  // how each slice moves
};
// The lowest ones, of a beam that is clamped at its low end or free.
std::vector<BeamMode> modesOf(const Beam& beam, bool clamped, size_t count);
// N, on the end of one that is clamped at its low end.
double bucklingLoad(const Beam& beam);

}  // namespace shoal
