#include "app/export/export.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/file.h"
#include "run/checkpoints.h"

namespace shoal::app {

namespace fs = std::filesystem;

namespace {

template <typename... Values>
void print(std::string& out, const char* format, Values... values) {
    char line[512];
    const int length = std::snprintf(line, sizeof line, format, values...);
    out.append(line, size_t(length));
}

// Three numbers between separators: all that a double holds where it is far from the origin.
std::string place(const glm::dvec3& x, char between) {
    std::string out;
    for (int i = 0; i < 3; ++i) {
        if (i > 0) out += between;
        print(out, "%.*g", std::abs(x[i]) < farOff ? 9 : 17, x[i]);
    }
    return out;
}

std::string csv(Simulation& simulation) {
    std::string out = "frame,time,group,molecule,vertex,x,y,z,vx,vy,vz,nx,ny,nz\n";
    forMolecules(simulation, [&](size_t g, const Snapshot& state, size_t m) {
        for (size_t vertex = 0; vertex < size_t(state.vertexCount); ++vertex) {
            const size_t i = m * size_t(state.vertexCount) + vertex;
            const glm::dvec3 &x = state.positions[i], &v = state.velocities[i];
            const glm::vec3& n = state.normals[i];
            print(out, "%d,%.9g,%zu,%zu,%zu,%s,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", simulation.frames(),
                  state.time, g, m, vertex, place(x, ',').c_str(), v.x, v.y, v.z, double(n.x), double(n.y),
                  double(n.z));
        }
    });
    return out;
}

std::string ply(Simulation& simulation, const Scene& scene) {
    std::string vertices, faces;
    size_t vertexCount = 0, faceCount = 0;
    forMolecules(simulation, [&](size_t g, const Snapshot& state, size_t m) {
        for (size_t vertex = 0; vertex < size_t(state.vertexCount); ++vertex) {
            const size_t i = m * size_t(state.vertexCount) + vertex;
            const glm::dvec3 &x = state.positions[i], &v = state.velocities[i];
            const glm::vec3& n = state.normals[i];
            print(vertices, "%s %.9g %.9g %.9g %.9g %.9g %.9g %zu %zu %zu\n", place(x, ' ').c_str(),
                  double(n.x), double(n.y), double(n.z), v.x, v.y, v.z, g, m, vertex);
        }
        for (const Triangle& t : scene.groups[g].molecule.triangles)
            print(faces, "3 %zu %zu %zu\n", vertexCount + size_t(t.a), vertexCount + size_t(t.b),
                  vertexCount + size_t(t.c));
        vertexCount += size_t(state.vertexCount);
        faceCount += scene.groups[g].molecule.triangles.size();
    });
    std::string out = "ply\nformat ascii 1.0\n";
    print(out, "comment shoal: frame %d, time %.9g s; metres, metres per second\nelement vertex %zu\n",
          simulation.frames(), simulation.time(), vertexCount);
    for (const char* property : {"x", "y", "z", "nx", "ny", "nz", "vx", "vy", "vz"})
        print(out, "property double %s\n", property);
    for (const char* property : {"group", "molecule", "vertex"})
        print(out, "property int %s\n", property);
    print(out, "element face %zu\nproperty list uchar int vertex_indices\nend_header\n", faceCount);
    return out + vertices + faces;
}

}  // namespace

std::string exportName(const std::string& target, int frame, bool several, int last) {
    const std::string kind = lowerExtension(target);
    if (kind == ".pvd")
        return numbered(fs::path(target).replace_extension(".vtp").string(), frame, true, last);
    if (kind == ".csv" || kind == ".ply" || kind == ".vtp") return numbered(target, frame, several, last);
    return numbered((fs::path(target) / "state.csv").string(), frame, true, last);
}

Exporter::Exporter(const Options& options, int first, int last)
    : options_(options), first_(first), last_(last) {
    if (options.exportEvery && *options.exportEvery > last - first)
        throw WrongUse(
            concat("--export-every ", *options.exportEvery, " is beyond the last frame, ", last - first));
    if (options.exports.empty()) return;
    const std::string kind = lowerExtension(options.exports);
    checkWritable(kind == ".pvd" ? options.exports : exportName(options.exports, last, several(), last));
    sole_.emplace(kind.empty() ? fs::path(options.exports) / "state.csv" : fs::path(options.exports));
}

bool Exporter::several() const {
    return options_.exportFrames.size() > 1 || options_.exportEvery;
}

bool Exporter::asksFor(int frame) const {
    if (options_.exports.empty()) return false;
    if (!options_.exportFrames.empty()) return contains(options_.exportFrames, frame);
    return !asksForLast() && (frame - first_) % options_.exportEvery.value_or(1) == 0;
}

// An index gets every frame instead: that of a single one is of no use.
bool Exporter::asksForLast() const {
    return !options_.exports.empty() && options_.exportFrames.empty() && !options_.exportEvery &&
           lowerExtension(options_.exports) != ".pvd";
}

std::string Exporter::write(Simulation& simulation, const Scene& scene) {
    std::string file = exportName(options_.exports, simulation.frames(), several(), last_);
    const std::string kind = lowerExtension(file);
    if (kind == ".vtp")
        writeVtp(file, simulation, scene, options_.exportCells);
    else
        writeFile(file, std::string_view(kind == ".ply" ? ply(simulation, scene) : csv(simulation)));
    if (lowerExtension(options_.exports) != ".pvd") return file;
    if (!index_) index_.emplace(options_.exports, options_.resume.empty() ? 0 : simulation.time());
    index_->add(simulation.time(), fs::path(file).filename().string());
    return file;
}

}  // namespace shoal::app
