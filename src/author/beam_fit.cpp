#include "author/beam_fit.h"

#include <algorithm>
#include <cmath>

#include "molecule/analysis.h"
#include "molecule/statics.h"

namespace shoal {

namespace {

constexpr double gravity = 9.81;  // m/s^2

// Of bending, rising. Each motion of the molecule is that whose shape is nearest to the beam's.
std::vector<Likeness> bendingOf(const Molecule& molecule, bool clamped, const Beam& beam,
                                const MassSpread& spread, size_t count) {
    const std::vector<BeamMode> modes = modesOf(beam, clamped, count);
    std::vector<VertexVectors> shapes;
    for (const BeamMode& mode : modes) {
        VertexVectors& shape = shapes.emplace_back();
        for (const Vertex& vertex : molecule.vertices)
            shape.push_back(beam.valueAt(mode.shape, glm::dot(vertex.position, spread.axis)) * spread.thin);
    }
    const std::vector<double> found = frequenciesLike(molecule, clamped, shapes);
    std::vector<Likeness> out;
    for (size_t i = 0; i < found.size(); ++i)
        out.push_back({hertz(found[i]), modes[i].frequency});
    return out;
}

// Multiplies the stiffness of all springs that join pinned vertices to others.
void scaleAtPins(Molecule& molecule, double factor) {
    const auto pinned = [&](int vertex) { return molecule.vertices[size_t(vertex)].pinned; };
    for (Spring& spring : molecule.springs)
        if (pinned(spring.a) != pinned(spring.b)) spring.stiffness *= factor;
}

// rad/s, by Rayleigh's quotient of the shape that gravity along a direction bends it to, of its motion in
// that direction alone.
double frequencyOf(const Molecule& molecule, const VertexVectors& moved, const glm::dvec3& direction) {
    double work = 0, inertia = 0;
    for (size_t i = 0; i < moved.size(); ++i) {
        const double way = glm::dot(moved[i], direction);
        work += gravity * molecule.vertices[i].mass * way;
        inertia += molecule.vertices[i].mass * way * way;
    }
    return std::sqrt(work / inertia);
}

MassSpread turnedTo(MassSpread spread, bool turned) {
    if (turned) spread.axis = -spread.axis;
    return spread;
}

}  // namespace

std::vector<Likeness> freeFigures(const Molecule& molecule, const Beam& beam, const MassSpread& spread,
                                  size_t count) {
    return bendingOf(molecule, false, beam, spread, count);
}

ClampedFigures clampedFigures(const Molecule& molecule, const Beam& beam, const MassSpread& spread,
                              const Clamp& clamp, size_t count) {
    const MassSpread seen = turnedTo(spread, clamp.turned);
    const Beam part = (clamp.turned ? beam.turned() : beam).from(clamp.place);
    const double length = part.high() - part.low;
    VertexVectors weights;
    for (const Vertex& vertex : molecule.vertices)
        weights.push_back(vertex.mass * gravity * seen.thin);
    const VertexVectors moved = displacements(molecule, true, weights);
    // The vertices of its end.
    constexpr double end = 0.01;
    double farthest = -1e300;
    const auto along = [&](const Vertex& vertex) { return glm::dot(vertex.position, seen.axis); };
    for (const Vertex& vertex : molecule.vertices)
        farthest = std::max(farthest, along(vertex));
    ClampedFigures out;
    int vertices = 0;
    for (size_t i = 0; i < moved.size(); ++i) {
        const double place = along(molecule.vertices[i]);
        if (place < farthest - end * length) continue;
        out.sag.molecule += glm::dot(moved[i], seen.thin);
        out.sag.beam += sagOf(part, place, gravity, 0);
        ++vertices;
    }
    out.sag.molecule /= vertices;
    out.sag.beam /= vertices;
    if (count > 0)
        out.frequencies = bendingOf(molecule, true, part, seen, count);
    else
        out.frequencies = {
            {hertz(frequencyOf(molecule, moved, seen.thin)), modesOf(part, true, 1)[0].frequency}};
    return out;
}

std::optional<Clamp> clampOf(const Mesh& mesh, const std::vector<bool>& pinned, const MassSpread& spread) {
    constexpr double least = 1e-3, overlap = 0.05;  // of the length
    for (const bool turned : {false, true}) {
        const glm::dvec3 axis = turnedTo(spread, turned).axis;
        double start = 1e300, held = -1e300, free = 1e300, end = -1e300;
        for (size_t v = 0; v < mesh.weldedPositions.size(); ++v) {
            const double place = glm::dot(mesh.weldedPositions[v], axis);
            start = std::min(start, place), end = std::max(end, place);
            if (pinned[v])
                held = std::max(held, place);
            else
                free = std::min(free, place);
        }
        const double length = end - start;
        if (held < start + least * length || free > end || held > end - overlap * length) continue;
        if (free > held - overlap * length) return Clamp{held, turned};
    }
    return {};
}

void shapeStiffness(Molecule& molecule, const Beam& beam, const MassSpread& spread) {
    const double window = 3 * (beam.high() - beam.low) / double(molecule.vertices.size());
    const auto along = [&](size_t i) { return glm::dot(molecule.vertices[i].position, spread.axis); };
    // The spread of the vertices across the beam near a place of it, m^2.
    const auto second = [&](double place) {
        double sum = 0, first = 0, squares = 0;
        for (size_t i = 0; i < molecule.vertices.size(); ++i) {
            const double weight = std::exp(-0.5 * std::pow((along(i) - place) / window, 2));
            const double across = glm::dot(molecule.vertices[i].position, spread.thin);
            sum += weight, first += weight * across, squares += weight * across * across;
        }
        return sum > 0 ? squares / sum - first * first / (sum * sum) : 0;
    };
    std::vector<double> seconds;
    for (size_t i = 0; i < beam.bending.size(); ++i)
        seconds.push_back(second(beam.middle(i)));
    const double most = *std::max_element(seconds.begin(), seconds.end());
    if (!(most > 0)) return;
    constexpr double least = 0.01;  // by the largest
    for (Spring& spring : molecule.springs) {
        const double place = 0.5 * (along(size_t(spring.a)) + along(size_t(spring.b)));
        spring.stiffness *=
            beam.valueAt(beam.bending, place) / std::max(beam.valueAt(seconds, place), least * most);
    }
}

void fitFree(Molecule& molecule, const Beam& beam, const MassSpread& spread) {
    const Likeness lowest = freeFigures(molecule, beam, spread, 1).front();
    const double factor = std::pow(lowest.beam / lowest.molecule, 2);
    for (Spring& spring : molecule.springs)
        spring.stiffness *= factor;
}

void fitClamped(Molecule& molecule, const Beam& beam, const MassSpread& spread, const Clamp& clamp) {
    const auto error = [](const Likeness& figure) { return std::log(figure.molecule / figure.beam); };
    const auto figuresOf = [&](const Molecule& tried, size_t count) {
        return clampedFigures(tried, beam, spread, clamp, count);
    };
    // The quick frequency is off by a share that hardly depends on the factor.
    const double quick =
        error(figuresOf(molecule, 1).frequencies[0]) - error(figuresOf(molecule, 0).frequencies[0]);
    // Of the logarithm of the factor; it falls.
    const auto difference = [&](double power) {
        Molecule tried = molecule;
        scaleAtPins(tried, std::exp(power));
        const ClampedFigures figures = figuresOf(tried, 0);
        return error(figures.sag) - error(figures.frequencies[0]) - quick;
    };
    double low = std::log(0.02), high = std::log(50);
    for (int round = 0; round < 14; ++round) {
        const double middle = 0.5 * (low + high);
        (difference(middle) > 0 ? low : high) = middle;
    }
    scaleAtPins(molecule, std::exp(0.5 * (low + high)));
}

}  // namespace shoal
