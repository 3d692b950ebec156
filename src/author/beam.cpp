#include "author/beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace shoal {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr size_t slices = 120;
constexpr double poisson = 0.3, shearShare = 5.0 / 6;  // of a body's section [Timoshenko 1921]

// Of a section, times the length of the slice.
struct Moments {
    double area = 0, first = 0, second = 0;
    double aboutMiddle() const { return area > 0 ? std::max(0.0, second - first * first / area) : 0; }
};

// The part of a polygon in the plane of x along the axis and y across it, where x is below or above a place.
using Polygon = std::vector<glm::dvec3>;
Polygon clipped(const Polygon& polygon, const glm::dvec3& axis, double place, double sign) {
    Polygon out;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = sign * (glm::dot(a, axis) - place), db = sign * (glm::dot(b, axis) - place);
        if (da >= 0) out.push_back(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) out.push_back(glm::mix(a, b, da / (da - db)));
    }
    return out;
}

// Adds a polygon of a sheet; or of the surface of a body, whose moments are the flux through it of y, y^2/2
// and y^3/3 along y, which is `across`, from outside in.
void addPolygon(Moments& moments, const Polygon& polygon, const glm::dvec3& across, bool body) {
    for (size_t i = 2; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
        const double y[] = {glm::dot(a, across), glm::dot(b, across), glm::dot(c, across)};
        const glm::dvec3 area = 0.5 * glm::cross(b - a, c - a);
        // Means of y, y^2 and y^3 over the triangle.
        double mean = 0, square = 0, cube = 0;
        for (int j = 0; j < 3; ++j)
            for (int k = j; k < 3; ++k)
                for (int l = k; l < 3; ++l)
                    cube += y[j] * y[k] * y[l] / 10;
        for (int j = 0; j < 3; ++j)
            for (int k = j; k < 3; ++k)
                square += y[j] * y[k] / 6;
        for (const double place : y)
            mean += place / 3;
        const double amount = body ? glm::dot(area, across) : glm::length(area);
        moments.area += amount * (body ? mean : 1);
        moments.first += amount * (body ? square / 2 : mean);
        moments.second += amount * (body ? cube / 3 : square);
    }
}

// Flexibility of the clamped beam between the middles of its slices: m/N.
MatrixXd flexibility(const Beam& beam) {
    const size_t count = beam.mass.size();
    MatrixXd out = MatrixXd::Zero(Eigen::Index(count), Eigen::Index(count));
    for (size_t i = 0; i < count; ++i)
        for (size_t j = i; j < count; ++j) {
            double sum = 0;
            for (size_t k = 0; k <= i; ++k) {
                // of the slice of i the half before its middle
                const double length = k < i ? beam.step : 0.5 * beam.step;
                const double place = beam.low + double(k) * beam.step + 0.5 * length;
                const double own = length * length / 12;
                sum +=
                    length * (((beam.middle(i) - place) * (beam.middle(j) - place) + own) / beam.bending[k] +
                              beam.softness[k]);
            }
            out(Eigen::Index(i), Eigen::Index(j)) = out(Eigen::Index(j), Eigen::Index(i)) = sum;
        }
    return out;
}

}  // namespace

bool Beam::whole() const {
    const auto above = [](double value) { return value > 0; };
    return std::all_of(mass.begin(), mass.end(), above) && std::all_of(bending.begin(), bending.end(), above);
}

double Beam::valueAt(const std::vector<double>& values, double place) const {
    const double slice = std::clamp((place - low) / step - 0.5, 0.0, double(values.size() - 1));
    const size_t before = std::min(size_t(slice), values.size() - 2);
    return std::lerp(values[before], values[before + 1], slice - double(before));
}

Beam Beam::from(double place) const {
    Beam out = *this;
    out.low = place;
    out.step = (high() - place) / double(mass.size());
    for (size_t i = 0; i < mass.size(); ++i) {
        out.mass[i] = valueAt(mass, out.middle(i)) * out.step / step;
        out.bending[i] = valueAt(bending, out.middle(i));
        out.softness[i] = valueAt(softness, out.middle(i));
    }
    return out;
}

Beam Beam::turned() const {
    Beam out = *this;
    out.low = -high();
    for (std::vector<double>* values : {&out.mass, &out.bending, &out.softness})
        std::reverse(values->begin(), values->end());
    return out;
}

Beam beamOf(const Mesh& mesh, const MassSpread& spread, const BeamMaterial& material) {
    const glm::dvec3 middle = 0.5 * (mesh.low + mesh.high);
    const bool body = material.thickness == 0;
    double low = 1e300, high = -1e300;
    for (const glm::dvec3& place : mesh.weldedPositions) {
        low = std::min(low, glm::dot(place, spread.axis));
        high = std::max(high, glm::dot(place, spread.axis));
    }
    const double start = glm::dot(middle, spread.axis), step = (high - low) / double(slices);
    std::vector<Moments> sections(slices);
    const auto slice = [&](double place) {
        return std::clamp(int(std::floor((place + start - low) / step)), 0, int(slices) - 1);
    };
    for (const glm::ivec3& t : mesh.triangles) {
        Polygon rest;
        double from = 1e300, to = -1e300;
        for (int i = 0; i < 3; ++i) {
            rest.push_back(mesh.positions[size_t(t[i])] - middle);
            from = std::min(from, glm::dot(rest.back(), spread.axis));
            to = std::max(to, glm::dot(rest.back(), spread.axis));
        }
        for (int i = slice(from); i <= slice(to); ++i) {
            const double end = low - start + (i + 1) * step;
            addPolygon(sections[size_t(i)], clipped(rest, spread.axis, end, -1), spread.thin, body);
            rest = clipped(rest, spread.axis, end, 1);
        }
    }
    Beam out;
    out.low = low;
    out.step = step;
    const double t = material.thickness;
    for (const Moments& section : sections) {
        const double area = section.area / step, second = section.aboutMiddle() / step;
        out.mass.push_back(material.density * section.area * (body ? 1 : t));
        out.bending.push_back(material.modulus * (body ? second : t * second + t * t * t / 12 * area));
        const double rigidity = shearShare * material.modulus / (2 * (1 + poisson)) * area;
        out.softness.push_back(body && area > 0 ? 1 / rigidity : 0);
    }
    // Thin ends, such as fins, are no beam of few vertices.
    constexpr double leastBending = 0.01;  // by the largest
    const double most = *std::max_element(out.bending.begin(), out.bending.end());
    for (double& bending : out.bending)
        if (body && bending > 0) bending = std::max(bending, leastBending * most);
    return out;
}

double sagOf(const Beam& beam, double place, double gravity, double load) {
    // The moment at each slice, then its curvature and shear carried to the place.
    double sag = 0;
    const size_t count = beam.mass.size();
    double force = load, moment = 0;  // of all beyond, about the middle of the slice
    for (size_t i = count; i-- > 0;) {
        const double weight = beam.mass[i] * gravity, half = 0.5 * beam.step;
        moment += force * half + weight * half / 4;
        const double reach = place - beam.middle(i);
        if (reach > 0)
            sag += beam.step * (moment * reach / beam.bending[i] + (force + weight / 2) * beam.softness[i]);
        moment += (force + weight) * half - weight * half / 4;
        force += weight;
    }
    return sag;
}

std::vector<BeamMode> modesOf(const Beam& beam, bool clamped, size_t count) {
    const auto size = Eigen::Index(beam.mass.size());
    MatrixXd flexible = flexibility(beam);
    VectorXd root(size);
    for (Eigen::Index i = 0; i < size; ++i)
        root(i) = std::sqrt(beam.mass[size_t(i)]);
    flexible = root.asDiagonal() * flexible * root.asDiagonal();
    if (!clamped) {
        // Without moving and turning as a whole.
        MatrixXd rigid(size, 2);
        for (Eigen::Index i = 0; i < size; ++i)
            rigid.row(i) << root(i), root(i) * (beam.middle(size_t(i)) - beam.low) / beam.step;
        const MatrixXd basis =
            Eigen::HouseholderQR<MatrixXd>(rigid).householderQ() * MatrixXd::Identity(size, 2);
        flexible -= basis * (basis.transpose() * flexible);
        flexible -= (flexible * basis) * basis.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(flexible);
    std::vector<BeamMode> out;
    for (size_t k = 0; k < count; ++k) {
        const Eigen::Index column = size - 1 - Eigen::Index(k);
        BeamMode& mode = out.emplace_back();
        mode.frequency = 1 / (2 * std::numbers::pi * std::sqrt(solver.eigenvalues()(column)));
        const VectorXd shape = solver.eigenvectors().col(column).cwiseQuotient(root);
        mode.shape.assign(shape.begin(), shape.end());
    }
    return out;
}

double bucklingLoad(const Beam& beam) {
    // The slopes at the ends of slices, of which the first is 0: sum of B (change)^2 / step - P step slope^2.
    const auto size = Eigen::Index(beam.mass.size());
    MatrixXd stiffness = MatrixXd::Zero(size, size);
    VectorXd length = VectorXd::Constant(size, beam.step);
    length(size - 1) *= 0.5;
    for (Eigen::Index i = 0; i < size; ++i) {
        const double held = beam.bending[size_t(i)] / beam.step;
        stiffness(i, i) += held;
        if (i == 0) continue;
        stiffness(i - 1, i - 1) += held;
        stiffness(i, i - 1) = stiffness(i - 1, i) = -held;
    }
    const VectorXd scale = length.cwiseSqrt().cwiseInverse();
    stiffness = scale.asDiagonal() * stiffness * scale.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

}  // namespace shoal
