#include "geometry/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "geometry/closest_point.h"

namespace shoal {

namespace {

constexpr size_t mostProbes = 20000;

// The grid of the cells' middles.
SampleGrid middles(const SampleGrid& grid) {
    return {grid.size - 1, grid.low + grid.cell / 2, grid.cell};
}

std::vector<glm::ivec3> probesNear(const DistanceField& field, const SampleGrid& cells, double thickness) {
    std::vector<glm::ivec3> out;
    for (int z = 0; z < cells.size.z; ++z)
        for (int y = 0; y < cells.size.y; ++y)
            for (int x = 0; x < cells.size.x; ++x) {
                const double d = valueAt(field, cells.place(x, y, z)).distance;
                if (d >= -field.grid.cell && d <= thickness + field.grid.cell) out.push_back({x, y, z});
            }
    const size_t step = out.size() / mostProbes + 1;
    for (size_t i = 0; i * step < out.size(); ++i)
        out[i] = out[i * step];
    out.resize((out.size() + step - 1) / step);
    return out;
}

}  // namespace

FieldError measureError(const DistanceField& field, const Mesh& mesh, const ClosestPoints& closest,
                        double thickness, int threads) {
    const SampleGrid cells = middles(field.grid);
    const std::vector<glm::ivec3> probes = probesNear(field, cells, thickness);
    const std::vector<int16_t> winding =
        field.shell > 0 ? std::vector<int16_t>() : windingNumbers(mesh, cells, threads);
    std::vector<double> errors(probes.size(), 0);
    constexpr int piece = 256;
    parallel(int((probes.size() + piece - 1) / piece), threads, [&](int part) {
        const size_t from = size_t(part) * piece, to = std::min(from + piece, probes.size());
        for (size_t i = from; i < to; ++i) {
            const glm::dvec3 x = cells.place(probes[i].x, probes[i].y, probes[i].z);
            const ClosestPoint found = closest.at(x);
            double exact = found.distance - field.shell / 2;
            if (!winding.empty()) {
                const int w = winding[cells.index(probes[i].x, probes[i].y, probes[i].z)];
                errors[i] = std::numeric_limits<double>::quiet_NaN();
                if (w != 0 && w + (found.front ? 1 : -1) != 0) continue;
                if (w != 0) exact = -exact;
            }
            errors[i] = valueAt(field, x).distance - exact;
        }
    });
    FieldError out;
    double squares = 0;
    for (size_t i = 0; i < errors.size(); ++i) {
        if (std::isnan(errors[i])) continue;
        ++out.probes;
        squares += errors[i] * errors[i];
        if (std::abs(errors[i]) <= out.most) continue;
        out.most = std::abs(errors[i]);
        out.where = cells.place(probes[i].x, probes[i].y, probes[i].z);
    }
    out.rms = out.probes > 0 ? std::sqrt(squares / double(out.probes)) : 0;
    return out;
}

}  // namespace shoal
