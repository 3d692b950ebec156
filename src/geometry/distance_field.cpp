// Baking. Every sample: the unsigned distance by a closest point; its sign by the winding number, which
// unlike pseudo-normals [Baerentzen 2005] is right inside shells that overlap, and unlike parities
// of rays does not miscount where a ray meets an edge. What lies inside other shells is then no surface at
// all.
#include "geometry/distance_field.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/activity.h"
#include "core/error.h"
#include "core/parallel.h"
#include "geometry/closest_point.h"
#include "geometry/sample_grid.h"

namespace shoal {

namespace {

double longestSide(const Mesh& mesh) {
    const glm::dvec3 extent = mesh.high - mesh.low;
    return std::max({extent.x, extent.y, extent.z});
}

double shellOf(const FieldRequest& request, double cell, bool closed) {
    return closed ? 0 : std::max(request.shell.value_or(0), 2 * cell);
}

// A sample in the middle of the model, so that a thin plate along an axis has samples in it, and around it
// room for the shell, the thickness, and two cells.
SampleGrid gridAround(const Mesh& mesh, const FieldRequest& request, int resolution, bool closed) {
    SampleGrid grid;
    grid.cell = longestSide(mesh) / resolution;
    const double reach = request.thickness + shellOf(request, grid.cell, closed) / 2;
    const double margin = 2 + std::ceil(std::min(reach / grid.cell, 1e6));
    const glm::dvec3 half = glm::ceil((mesh.high - mesh.low) / (2 * grid.cell) - 1e-9) + margin;
    grid.size = 2 * glm::ivec3(half) + 1;
    grid.low = (mesh.low + mesh.high) / 2.0 - grid.cell * half;
    return grid;
}

double samplesOf(const SampleGrid& grid) {
    return double(grid.size.x) * double(grid.size.y) * double(grid.size.z);
}

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

// Measures a field in the middles of at most 20,000 cells, evenly chosen among those within a cell of the
// surface, or of where vertices of that thickness rest. What is inside and nearest to a hidden wall has no
// exact distance here and is left out.
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
            const ClosestPoint found = closest.find(x);
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

class Baker {
  public:
    Baker(const Mesh& mesh, const FieldRequest& request, const SurfaceReport& surface,
          const ClosestPoints& closest, int threads)
        : mesh_(mesh), request_(request), closest_(closest), threads_(threads) {
        field_.surface = surface;
    }

    DistanceField bake(int resolution, const FieldProgress& progress) {
        const bool closed = field_.surface.closed();
        field_.resolution = resolution;
        field_.grid = gridAround(mesh_, request_, resolution, closed);
        field_.shell = shellOf(request_, field_.grid.cell, closed);
        if (closed) {
            winding_ = windingNumbers(mesh_, field_.grid, threads_);
            findThin();
        }
        field_.distances.assign(field_.grid.count(), 0);
        hidden_.assign(closed ? field_.grid.count() : 0, 0);
        bakeSlices(progress);
        if (std::find(hidden_.begin(), hidden_.end(), 1) != hidden_.end())
            continueInwards(field_.distances, hidden_, field_.grid);
        findOutside();
        field_.error = measureError(field_, mesh_, closest_, request_.thickness, threads_);
        return std::move(field_);
    }

  private:
    // By rays inwards from the middle of every triangle.
    void findThin() {
        double thin = 0, all = 0;
        field_.thinnest = std::numeric_limits<double>::infinity();
        for (const glm::ivec3& t : mesh_.triangles) {
            glm::dvec3 p[3];
            for (int i = 0; i < 3; ++i)
                p[i] = mesh_.weldedPositions[size_t(mesh_.weld[size_t(t[i])])];
            const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double area = glm::length(across);
            if (!(area > 0)) continue;
            const glm::dvec3 middle = (p[0] + p[1] + p[2]) / 3.0;
            const glm::dvec3 inwards = across / (field_.surface.volume < 0 ? area : -area);
            const double thickness = closest_.across(middle, inwards);
            all += area;
            if (thickness < 2 * field_.grid.cell) thin += area;
            if (thickness < field_.thinnest) field_.thinnest = thickness, field_.thinWhere = middle;
        }
        field_.thinArea = all > 0 ? thin / all : 0;
    }

    // Slice by slice; within a row the last triangle and distance bound the next search.
    void bakeSlices(const FieldProgress& progress) {
        std::atomic<int> done{0};
        const auto main = std::this_thread::get_id();
        parallel(field_.grid.size.z, threads_, [&](int z) {
            for (int y = 0; y < field_.grid.size.y; ++y) {
                ClosestPoint last;
                for (int x = 0; x < field_.grid.size.x; ++x) {
                    const glm::dvec3 place = field_.grid.place(x, y, z);
                    last =
                        closest_.find(place, (last.distance + field_.grid.cell) * (1 + 1e-9), last.triangle);
                    store(field_.grid.index(x, y, z), place, last);
                }
            }
            ++done;
            if (std::this_thread::get_id() != main) return;
            const double share = double(done) / field_.grid.size.z;
            Activity::reach(share);
            if (progress) progress(share);
        });
    }

    void store(size_t index, const glm::dvec3& x, const ClosestPoint& found) {
        if (field_.shell > 0) {
            field_.distances[index] = float(found.distance - field_.shell / 2);
            return;
        }
        const int winding = winding_[index];
        const double sign = winding != 0 ? -1 : 1;
        const bool on = found.distance < 1e-6 * field_.grid.cell;
        // beyond its closest point a sample inside must find the outside, or that is no surface
        hidden_[index] = winding != 0 && (on ? !besideOutside(index) : winding + (found.front ? 1 : -1) != 0);
        double distance = sign * found.distance;
        if (field_.thinArea > 0 && !on) {
            const glm::dvec3 inwards = (found.point - x) * (sign / found.distance);
            const double thickness = closest_.across(found.point, inwards);
            distance -= std::max(0.0, field_.grid.cell - thickness / 2);
        }
        field_.distances[index] = float(distance);
    }

    // Whether one of the 26 samples around is outside.
    bool besideOutside(size_t index) const {
        const glm::ivec3 size = field_.grid.size;
        const glm::ivec3 cell(int(index % size_t(size.x)), int(index / size_t(size.x) % size_t(size.y)),
                              int(index / size_t(size.x) / size_t(size.y)));
        for (int i = 0; i < 27; ++i) {
            const glm::ivec3 p =
                glm::clamp(cell + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1, glm::ivec3(0), size - 1);
            if (winding_[field_.grid.index(p.x, p.y, p.z)] == 0) return true;
        }
        return false;
    }

    void findOutside() {
        const SampleGrid& grid = field_.grid;
        double least = std::numeric_limits<double>::infinity();
        for (int z = 0; z < grid.size.z; ++z)
            for (int y = 0; y < grid.size.y; ++y)
                for (int x = 0; x < grid.size.x; ++x) {
                    const bool face = x == 0 || y == 0 || z == 0 || x == grid.size.x - 1 ||
                                      y == grid.size.y - 1 || z == grid.size.z - 1;
                    if (face) least = std::min(least, double(field_.distances[grid.index(x, y, z)]));
                }
        field_.outside = least;
    }

    const Mesh& mesh_;
    const FieldRequest& request_;
    const ClosestPoints& closest_;
    int threads_;
    DistanceField field_;
    std::vector<int16_t> winding_;
    std::vector<char> hidden_;  // samples inside whose closest point is inside another shell
};

// Coarse to fine: the error shrinks at least about as fast as the cells.
DistanceField refine(const Mesh& mesh, const FieldRequest& request, const SurfaceReport& surface,
                     const ClosestPoints& closest, const FieldProgress& progress, int threads) {
    const int finest = finestResolution(mesh, request, surface.closed());
    int resolution = std::min(16, finest);
    for (;;) {
        DistanceField field = Baker(mesh, request, surface, closest, threads).bake(resolution, progress);
        const double ratio = field.error.most / *request.error;
        if (ratio <= 1) return field;
        if (resolution >= finest)
            throw Error("the finest grid that fits, of resolution ", finest, ", is still off by ",
                        field.error.most, " m, more than ", *request.error);
        resolution = std::min(finest, int(std::ceil(resolution * std::clamp(1.1 * ratio, 1.2, 4.0))));
    }
}

}  // namespace

int finestResolution(const Mesh& mesh, const FieldRequest& request, bool closed) {
    int low = 0, high = mostResolution;
    while (low < high) {
        const int middle = (low + high + 1) / 2;
        if (samplesOf(gridAround(mesh, request, middle, closed)) <= double(mostSamples)) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low >= leastResolution ? low : 0;
}

DistanceField bakeDistanceField(const Mesh& mesh, const FieldRequest& request, const FieldProgress& progress,
                                int threads) {
    const Activity baking("baking a distance field");
    const auto start = std::chrono::steady_clock::now();
    const SurfaceReport surface = examineSurface(mesh);
    if (!(surface.area > 0)) throw Error("has no surface: none of its triangles has an area");
    const int finest = finestResolution(mesh, request, surface.closed());
    if (finest == 0)
        throw Error("a thickness of ", request.thickness, " m", request.shell ? " and its shell" : "",
                    " around a model of ", longestSide(mesh), " m take too large a grid");
    const int resolution = request.resolution.value_or(std::min(defaultResolution, finest));
    if (!request.error && resolution > finest) {
        const SampleGrid grid = gridAround(mesh, request, resolution, surface.closed());
        throw Error("a grid of ", grid.size.x, " x ", grid.size.y, " x ", grid.size.z,
                    " samples is more than the ", mostSamples, " that a field may have (", mostSamples >> 16,
                    " MiB on the device): at most resolution ", finest, " fits");
    }
    if (threads < 1) threads = allThreads();
    const ClosestPoints closest(mesh);
    DistanceField field = request.error
                              ? refine(mesh, request, surface, closest, progress, threads)
                              : Baker(mesh, request, surface, closest, threads).bake(resolution, progress);
    field.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return field;
}

FieldValue valueAt(const DistanceField& field, const glm::dvec3& x) {
    const SampleGrid& grid = field.grid;
    const glm::dvec3 last = glm::dvec3(grid.size - 1), p = (x - grid.low) / grid.cell;
    const glm::dvec3 inside = glm::clamp(p, glm::dvec3(0), last);
    if (p != inside) {
        const double way = glm::length(p - inside);
        return {way * grid.cell + field.outside, (p - inside) / way};
    }
    const glm::ivec3 c = glm::min(glm::ivec3(p), grid.size - 2);
    const glm::dvec3 f = p - glm::dvec3(c);
    double value = 0;
    glm::dvec3 gradient(0);
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 side(i & 1, (i >> 1) & 1, i >> 2);
        const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(side)), s = glm::dvec3(2 * side - 1);
        const double d = double(field.distances[grid.index(c.x + side.x, c.y + side.y, c.z + side.z)]);
        value += d * w.x * w.y * w.z;
        gradient += d * glm::dvec3(s.x * w.y * w.z, w.x * s.y * w.z, w.x * w.y * s.z);
    }
    // where the field is level the way out is away from the middle, else up
    gradient = gradient / grid.cell + 1e-7 * (p / last - 0.5) + glm::dvec3(0, 1e-12, 0);
    return {value, gradient};
}

std::vector<std::string> fieldWarnings(const DistanceField& field, const FieldRequest& request) {
    std::vector<std::string> out;
    const double cell = field.grid.cell;
    if (field.shell > 0) {
        out.push_back(concat("is not closed (", whyOpen(field.surface),
                             "): without an inside it becomes a shell ", field.shell, " m thick"));
        if (request.shell && *request.shell < field.shell)
            out.push_back(concat("a shell of ", *request.shell, " m would fall between samples ", cell,
                                 " m apart: it is two of these thick; resolution ",
                                 std::ceil(2 * cell * field.resolution / *request.shell), " would hold it"));
    } else if (request.shell) {
        out.push_back("is closed: \"shell\" is of models that are not");
    }
    if (field.thinArea > 0)
        out.push_back(concat("has parts thinner than two of its cells of ", cell, " m (",
                             std::max(0.1, std::round(1000 * field.thinArea) / 10),
                             " % of the surface; the thinnest ", field.thinnest, " m near (",
                             field.thinWhere.x, ", ", field.thinWhere.y, ", ", field.thinWhere.z,
                             ")): they are thickened to that; resolution ",
                             std::ceil(2 * cell * field.resolution / field.thinnest), " would hold them"));
    return out;
}

}  // namespace shoal
