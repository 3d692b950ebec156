// Turns a shape so that it swims along +Z, and gives it its muscles.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "author/from_mesh.h"
#include "core/error.h"

namespace shoal {

glm::dvec3 parseAxis(const std::string& text) {
    const bool signedAxis = text.size() == 2 && (text[0] == '+' || text[0] == '-');
    const size_t axis = std::string("XYZ").find(text.empty() ? ' ' : char(std::toupper(text.back())));
    if ((!signedAxis && text.size() != 1) || axis == std::string::npos)
        throw Error("expected an axis such as +X, found \"", text, "\"");
    glm::dvec3 out(0);
    out[int(axis)] = text[0] == '-' ? -1 : 1;
    return out;
}

void turnForward(Mesh& mesh, const glm::dvec3& axis) {
    const glm::dvec3 up = axis.y == 0 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -axis.y),
                     side = glm::cross(up, axis);
    const auto turned = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(v, side), glm::dot(v, up), glm::dot(v, axis)) + 0.0;  // never -0
    };
    for (auto* all : {&mesh.positions, &mesh.normals, &mesh.weldedPositions, &mesh.weldedNormals})
        std::transform(all->begin(), all->end(), all->begin(), turned);
    const glm::dvec3 a = turned(mesh.low), b = turned(mesh.high);
    mesh.low = glm::min(a, b);
    mesh.high = glm::max(a, b);
}

namespace {

struct Swing {
    double amplitude = 0, phase = 0;  // rad
};

// The curvature of the wave y(s) = a(s) sin(2 pi (f t - s)) of a fish that is 1 long, s from its snout: its
// second derivative. The envelope a grows from head to tail like a saithe's [Videler 1993].
Swing curvatureOf(double s) {
    constexpr double k = 2 * std::numbers::pi;
    const double a = 0.02 - 0.083 * s + 0.163 * s * s, slope = -0.083 + 0.326 * s, bend = 0.326;
    const double sine = bend - k * k * a, cosine = -2 * k * slope;
    return {std::hypot(sine, cosine), std::atan2(cosine, sine) - k * s};
}

}  // namespace

double addMuscles(Molecule& molecule, double lowest) {
    // Beyond its lowest frequency a body no longer follows; few fish beat faster at rest.
    constexpr double share = 0.7, fastest = 4;
    const double beat = std::min(fastest, std::round(1e3 * share * lowest) / 1e3);
    double low = 1e300, high = -1e300;
    for (const Vertex& vertex : molecule.vertices) {
        low = std::min(low, vertex.position.z);
        high = std::max(high, vertex.position.z);
    }
    const double length = high - low;
    const auto rounded = [](double value) { return std::round(value * 1e6) / 1e6; };
    for (Spring& spring : molecule.springs) {
        const double reach = bendReach(molecule, spring) / length;
        if (std::abs(reach) < 1e-6) continue;
        const double middle = 0.5 * (molecule.vertices[size_t(spring.a)].position.z +
                                     molecule.vertices[size_t(spring.b)].position.z);
        const Swing swing = curvatureOf((high - middle) / length);
        constexpr double round = 2 * std::numbers::pi;
        const double phase = std::fmod(swing.phase + (reach < 0 ? 5 : 4) * std::numbers::pi, round);
        spring.actuation = {rounded(swing.amplitude * std::abs(reach)), beat, rounded(phase)};
    }
    return beat;
}

}  // namespace shoal
