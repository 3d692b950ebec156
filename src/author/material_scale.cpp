#include "author/from_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace shoal {

std::span<const ScaledMaterial> materialScale() {
    static constexpr ScaledMaterial scale[] = {
        {"jelly", 5e3, 1000, 1e-3, 0.05},     {"flesh", 1e5, 1050, 1e-3, 0.1},
        {"foam", 2e5, 60, 2e-3, 0.1},         {"rubber", 2e6, 1100, 1e-3, 0.05},
        {"petal", 1e6, 600, 2e-4, 0.1},       {"soft-leaf", 3e6, 700, 2e-4, 0.08},
        {"leaf", 1e7, 800, 2.5e-4, 0.06},     {"cloth", 2e7, 500, 3e-4, 0.1},
        {"paper", 2e9, 800, 1e-4, 0.03},      {"card", 2e9, 800, 3e-4, 0.03},
        {"stiff-card", 3e9, 800, 1e-3, 0.03}, {"wood", 1e10, 600, 2e-3, 0.02},
    };
    return scale;
}

const ScaledMaterial& scaledMaterial(const std::string& name) {
    std::vector<std::string> names;
    for (const ScaledMaterial& material : materialScale()) {
        if (name == material.name) return material;
        names.emplace_back(material.name);
    }
    throw Error("unknown material \"", name, "\"", suggestion(name, names));
}

double lowestFrequency(double modulus, double density, double length, double gyration) {
    const double speed = std::sqrt(modulus / density);
    const double bending = 4.730 * 4.730 / (2 * std::numbers::pi) * gyration * speed / (length * length);
    return std::min(bending, speed / (2 * length));
}

}  // namespace shoal
