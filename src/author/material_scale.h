// Named materials, from soft to stiff, for the stiffness and mass of what is made from a mesh.
#pragma once

#include <span>
#include <string>

namespace shoal {

// Rounded values of handbooks. A sheet has the thickness; a body is as thick as it is.
struct ScaledMaterial {
    const char* name;
    double modulus;    // Pa, Young's
    double density;    // kg/m^3
    double thickness;  // m, of a sheet
    double damping;    // ratio of the lowest mode to critical
};

std::span<const ScaledMaterial> materialScale();
// Error: unknown, with the nearest.
const ScaledMaterial& scaledMaterial(const std::string& name);

// The lowest frequency of a free body or sheet of a material, Hz: of bending, as a beam that is free at both
// ends
//   (4.730^2 / 2 pi) sqrt(EI / (mass / length)) / length^2     (Euler and Bernoulli; Blevins, table 8-1)
// and no higher than that of stretching, sqrt(E / density) / (2 length).
// `length` m; `gyration` m: of the section about the axis that it bends about most easily; `density` kg/m^3.
double lowestFrequency(double modulus, double density, double length, double gyration);

}  // namespace shoal
