#include "reference/fields.h"

#include <algorithm>
#include <cmath>

#include "reference/noise.h"
#include "scene/field_kinds.h"

namespace shoal::reference {

namespace {

constexpr double twoPi = 6.283185307179586;

glm::dvec3 velocity(const UniformField& field, const glm::dvec3&, double) {
    return field.velocity;
}

glm::dvec3 velocity(const OscillatingField& field, const glm::dvec3&, double time) {
    return field.velocity * std::sin(twoPi * field.frequency * time + field.phase);
}

glm::dvec3 velocity(const GustField& field, const glm::dvec3& x, double time) {
    const glm::dvec3 along = glm::normalize(field.direction);
    const glm::dvec3 across = gustAcross(along);
    const glm::dvec3 p{(glm::dot(x, along) - field.frontSpeed * time) / field.length,
                       glm::dot(x, across) / field.width,
                       glm::dot(x, glm::cross(along, across)) / field.width};
    const double noise =
        field.noise == NoiseForm::table
            ? gustFromTile(p, field.seed)
            : 1.2 * (gradientNoise(p, field.seed) + gradientNoise(p * 2.0 + 17.31, field.seed + 1) / 2);
    return along * field.speed * (1 + field.strength * noise);
}

glm::dvec3 velocity(const ShearField& field, const glm::dvec3& x, double) {
    const glm::dvec3 d = x - field.origin;
    glm::dvec3 u = field.velocity;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            u[row] += field.gradient[column][row] * d[column];
    }
    return u;
}

glm::dvec3 velocity(const VortexField& field, const glm::dvec3& x, double) {
    const glm::dvec3 axis = glm::normalize(field.axis);
    const glm::dvec3 d = x - field.origin;
    const glm::dvec3 turn = glm::cross(axis, d);  // its length is the distance from the axis
    const double s = glm::length(turn) / field.radius;
    return (turn / field.radius * (2 * field.speed) + axis * field.lift) / (1 + s * s);
}

glm::dvec3 velocity(const AbcField& field, const glm::dvec3& x, double) {
    const glm::dvec3 p = (x - field.origin) * (twoPi / field.wavelength);
    return {field.a * std::sin(p.z) + field.c * std::cos(p.y),
            field.b * std::sin(p.x) + field.a * std::cos(p.z),
            field.c * std::sin(p.y) + field.b * std::cos(p.x)};
}

glm::dvec3 velocity(const TaylorGreenField& field, const glm::dvec3& x, double) {
    const glm::dvec3 p = (x - field.origin) * (twoPi / field.wavelength);
    const double layer = field.speed * std::cos(p.z);
    return {layer * std::cos(p.x) * std::sin(p.y), -layer * std::sin(p.x) * std::cos(p.y), 0};
}

glm::dvec3 velocity(const CurlNoiseField& field, const glm::dvec3& x, double time) {
    if (field.noise == NoiseForm::table)
        return field.speed * curlFromTile(x / field.length, time / field.period, field.octaves, field.seed);
    glm::dvec3 sum(0);
    for (int octave = 0; octave < field.octaves; ++octave) {
        const double fine = std::exp2(octave);
        sum += field.speed * std::exp2(-octave / 3.0) *
               curlNoise(x * fine / field.length, time * fine / field.period, field.seed + uint32_t(octave));
    }
    return sum;
}

// Returns the velocity at x in one frame of a grid.
glm::dvec3 gridVelocity(const GridField& field, const glm::dvec3& x, size_t frame) {
    glm::ivec3 low(0), high(0);
    glm::dvec3 share(0);
    for (int d = 0; d < 3; ++d) {
        const int cells = field.resolution[d];
        // cell i's centre is at i + 1/2 cells from the low face
        double s = (x[d] - field.low[d]) / (field.high[d] - field.low[d]) * cells - 0.5;
        if (field.wrap) {
            s -= std::floor(s / cells) * cells;
        } else {
            s = std::min(std::max(s, 0.0), double(cells - 1));
        }
        low[d] = std::min(int(s), cells - 1);
        share[d] = s - low[d];
        high[d] = field.wrap ? (low[d] + 1) % cells : std::min(low[d] + 1, cells - 1);
    }
    glm::dvec3 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
        glm::ivec3 cell;
        double weight = 1;
        for (int d = 0; d < 3; ++d) {
            const bool upper = (corner >> d) & 1;
            cell[d] = upper ? high[d] : low[d];
            weight *= upper ? share[d] : 1 - share[d];
        }
        const size_t index =
            frame * field.cells() +
            (size_t(cell.z) * size_t(field.resolution.y) + size_t(cell.y)) * size_t(field.resolution.x) +
            size_t(cell.x);
        sum += weight * glm::dvec3(field.values[index]);
    }
    return sum;
}

glm::dvec3 velocity(const GridField& field, const glm::dvec3& x, double time) {
    const std::vector<double>& times = field.times;
    if (times.empty()) return gridVelocity(field, x, 0);
    if (field.repeats) time -= std::floor((time - times.front()) / field.period()) * field.period();
    const size_t next = size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (next == 0) return gridVelocity(field, x, 0);
    if (next == times.size() && !field.repeats) return gridVelocity(field, x, next - 1);
    const double before = times[next - 1];
    const double after = next < times.size() ? times[next] : times.front() + field.period();
    return glm::mix(gridVelocity(field, x, next - 1), gridVelocity(field, x, next % times.size()),
                    (time - before) / (after - before));
}

glm::dvec3 velocity(const WavesField& field, const glm::dvec3& x, double time) {
    const glm::dvec3 d = x - field.origin;
    double top = 0;
    for (const WaveTrain& train : field.trains)
        top += train.amplitude;
    glm::dvec3 sum(0);
    for (const WaveTrain& train : field.trains) {
        const double k = twoPi / train.wavelength, amplitude = train.amplitude;
        const glm::dvec3 along = glm::normalize(glm::dvec3(train.direction.x, 0, train.direction.z));
        // in water deeper than this the bottom is not felt within double precision, and cosh would overflow
        const bool deep = !field.depth || k * *field.depth > 100;
        const double y = std::min(deep ? d.y : std::max(d.y, -*field.depth), top);
        const double omega = std::sqrt(field.gravity * k * (deep ? 1 : std::tanh(k * *field.depth)));
        const double level =
            deep ? std::exp(k * y) : std::cosh(k * (y + *field.depth)) / std::sinh(k * *field.depth);
        const double upright =
            deep ? std::exp(k * y) : std::sinh(k * (y + *field.depth)) / std::sinh(k * *field.depth);
        const double a = k * glm::dot(along, d) - omega * time + train.phase;
        sum += amplitude * omega * (along * (level * std::cos(a)) + glm::dvec3(0, upright * std::sin(a), 0));
    }
    return sum;
}

glm::dvec3 velocity(const HurricaneField& field, const glm::dvec3& x, double) {
    const glm::dvec3 d = x - field.origin;
    const double r = std::hypot(d.x, d.z), part = d.y / field.height;
    if (r < 1e-6 * field.radius || part < 0 || part > 1) return glm::dvec3(0);
    const double s = std::pow(field.radius / r, field.shape);
    const double gradient = field.speed * field.speed * s * std::exp(1 - s);  // r dp/dr over the density
    const double f = field.coriolis;
    const double root = std::sqrt(gradient + r * r * f * f / 4);
    if (root == 0 || s > 600) return glm::dvec3(0);
    // not root - r f / 2, which cancels far out
    const double v = gradient / (root + r * f / 2);
    const double rise = gradient * field.shape * (s - 1) / r;  // d gradient / dr
    const double slope = (rise + r * f * f / 2) / (2 * root) - f / 2;
    const glm::dvec3 out(d.x / r, 0, d.z / r), around = glm::cross(glm::dvec3(0, 1, 0), out);
    const double pi = twoPi / 2, tangent = std::tan(field.inflow);
    return around * (std::copysign(v, field.speed) * std::cos(pi * part / 2)) -
           out * (tangent * v * std::cos(pi * part)) +
           glm::dvec3(0, tangent * (v / r + slope) * field.height / pi * std::sin(pi * part), 0);
}

bool holds(const Box& box, const glm::dvec3& x) {
    for (int d = 0; d < 3; ++d) {
        if (x[d] < box.low[d] || x[d] > box.high[d]) return false;
    }
    return true;
}

}  // namespace

glm::dvec3 gustAcross(const glm::dvec3& along) {
    const glm::dvec3 up = std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    return glm::normalize(glm::cross(up, along));
}

glm::dvec3 fieldVelocity(const FieldShape& shape, const glm::dvec3& x, double time) {
    return std::visit([&](const auto& field) { return velocity(field, x, time); }, shape);
}

glm::dvec3 fluidVelocity(const std::vector<Field>& fields, const glm::dvec3& x, double time) {
    glm::dvec3 sum(0);
    for (const Field& field : fields) {
        if (field.box && !holds(*field.box, x)) continue;
        sum += field.weight * fieldVelocity(*field.shape, x, time);
    }
    return sum;
}

}  // namespace shoal::reference
