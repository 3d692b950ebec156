#include "author/from_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <Eigen/Dense>

#include "author/coarse.h"
#include "author/springs.h"
#include "core/error.h"
#include "geometry/close_holes.h"
#include "geometry/doubled_walls.h"
#include "geometry/subdivide.h"
#include "molecule/molecule_file.h"
#include "molecule/skin.h"

namespace shoal {

namespace {

constexpr double pi = std::numbers::pi;

double rounded(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) return value;
    // divided by a power of ten, never multiplied by one that no double holds
    const int shift = digits - 1 - int(std::floor(std::log10(std::abs(value))));
    const double power = std::pow(10, std::abs(shift));
    return shift >= 0 ? std::round(value * power) / power : std::round(value / power) * power;
}

// To a millionth of the size: what the file shows is what is meant.
glm::dvec3 rounded(const glm::dvec3& value, double size) {
    if (!(size > 0) || !std::isfinite(size)) return value;
    const int shift = 6 - int(std::floor(std::log10(size)));
    const double power = std::pow(10, std::abs(shift));
    return shift >= 0 ? glm::round(value * power) / power : glm::round(value / power) * power;
}

// Vertices that no triangle has would stretch the box, and be taken for a part of the shape.
Mesh withoutStrays(Mesh mesh) {
    std::vector<int> number(mesh.positions.size(), -1);
    for (const glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            number[size_t(t[i])] = 0;
    if (std::find(number.begin(), number.end(), -1) == number.end()) return mesh;
    size_t count = 0;
    for (size_t v = 0; v < number.size(); ++v) {
        if (number[v] < 0) continue;
        mesh.positions[count] = mesh.positions[v];
        mesh.normals[count] = mesh.normals[v];
        if (!mesh.colors.empty()) mesh.colors[count] = mesh.colors[v];
        if (!mesh.uvs.empty()) mesh.uvs[count] = mesh.uvs[v];
        if (!mesh.bones.empty()) mesh.bones[count] = mesh.bones[v];
        number[v] = int(count++);
    }
    mesh.positions.resize(count);
    mesh.normals.resize(count);
    mesh.colors.resize(std::min(mesh.colors.size(), count));
    mesh.uvs.resize(std::min(mesh.uvs.size(), count));
    mesh.bones.resize(std::min(mesh.bones.size(), count));
    for (glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            t[i] = number[size_t(t[i])];
    completeMesh(mesh);
    return mesh;
}

// In metres, where it is wanted. A mesh that lies at map coordinates comes to the origin: what is single
// precision would not hold its shape there.
Mesh placed(const Mesh& source, const FromMesh& options) {
    Mesh mesh = withoutStrays(source);
    if (options.forward) turnForward(mesh, *options.forward);
    const glm::dvec3 extent = mesh.high - mesh.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0)) throw Error("all vertices of the mesh lie in one place");
    const double scale = options.size ? *options.size / longest : 1;
    const glm::dvec3 middle = 0.5 * (mesh.low + mesh.high);
    constexpr double farAway = 1000;  // sizes
    const bool tooFar = !options.centre && glm::length(middle) > farAway * longest;
    if (tooFar)
        mesh.notes.push_back(concat("the mesh lies ", glm::length(middle), " m from the origin, and is ",
                                    longest, " m long: its middle was put at the origin"));
    const glm::dvec3 origin = options.centre || tooFar ? middle : glm::dvec3(0);
    for (std::vector<glm::dvec3>* all : {&mesh.positions, &mesh.weldedPositions})
        for (glm::dvec3& p : *all)
            p = scale * (p - origin);
    mesh.low = scale * (mesh.low - origin);
    mesh.high = scale * (mesh.high - origin);
    const glm::dvec3 far = glm::max(glm::abs(mesh.low), glm::abs(mesh.high));
    if (std::max({far.x, far.y, far.z}) > 1e6)
        throw Error("the mesh reaches further than 1000 km from the origin: centre it, or give a size");
    return mesh;
}

// The distribution of a body's volume or a sheet's area, over the coarse vertices and in space.
struct Spread {
    std::vector<double> shares;  // of each coarse vertex; they add up to 1
    glm::dvec3 axis{0, 0, 1};    // unit, along which it is spread widest
    double gyration = 0;         // m, along the thinnest direction
};

class Gather {
  public:
    explicit Gather(size_t vertices) : shares_(vertices, 0) {}
    void add(const glm::dvec3& place, double amount, size_t vertex) {
        const Eigen::Vector3d p(place.x, place.y, place.z);
        total_ += amount;
        first_ += amount * p;
        second_ += amount * p * p.transpose();
        shares_[vertex] += amount;
    }
    Spread finish() {
        Spread out;
        const Eigen::Vector3d middle = first_ / total_;
        const Eigen::Matrix3d spread = second_ / total_ - middle * middle.transpose();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
        const Eigen::Vector3d axis = solver.eigenvectors().col(2);
        out.axis = {axis.x(), axis.y(), axis.z()};
        out.gyration = std::sqrt(std::max(0.0, solver.eigenvalues()(0)));
        // no vertex is so light that it would need short steps
        constexpr double least = 0.4;  // of the mean
        const double floor = least * total_ / double(shares_.size());
        double sum = 0;
        for (double& share : shares_)
            sum += share = std::max(share, floor);
        for (const double share : shares_)
            out.shares.push_back(share / sum);
        return out;
    }

  private:
    std::vector<double> shares_;
    double total_ = 0;
    Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
};

size_t nearestTo(const std::vector<glm::dvec3>& places, const glm::dvec3& point) {
    size_t best = 0;
    for (size_t i = 1; i < places.size(); ++i)
        if (glm::distance(places[i], point) < glm::distance(places[best], point)) best = i;
    return best;
}

Spread spreadOfBody(const CoarseMesh& coarse, const Inside& inside) {
    Gather gather(coarse.positions.size());
    for (const glm::dvec3& sample : inside.samples())
        gather.add(sample, 1, nearestTo(coarse.positions, sample));
    return gather.finish();
}

Spread spreadOfSheet(const Mesh& mesh, const CoarseMesh& coarse) {
    Gather gather(coarse.positions.size());
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[size_t(t.x)], &b = mesh.positions[size_t(t.y)],
                         &c = mesh.positions[size_t(t.z)];
        const double third = glm::length(glm::cross(b - a, c - a)) / 6;
        for (int i = 0; i < 3; ++i) {
            const int welded = mesh.weld[size_t(t[i])];
            // where the exact second moments of a triangle lie: half way to the middle
            const glm::dvec3 place = 0.5 * mesh.positions[size_t(t[i])] + (a + b + c) / 6.0;
            gather.add(place, third, size_t(coarse.map[size_t(welded)]));
        }
    }
    return gather.finish();
}

// Moves what is flat up and down in turn, so that bending stretches springs to first order.
void fold(CoarseMesh& coarse, double height) {
    glm::dvec3 normal(0);
    std::vector<Pair> edges;
    for (const glm::ivec3& t : coarse.triangles) {
        const glm::dvec3& a = coarse.positions[size_t(t.x)];
        const glm::dvec3 area =
            glm::cross(coarse.positions[size_t(t.y)] - a, coarse.positions[size_t(t.z)] - a);
        normal += glm::dot(area, normal) < 0 ? -area : area;
        for (int i = 0; i < 3; ++i)
            edges.emplace_back(t[i], t[(i + 1) % 3]);
    }
    if (!(glm::length(normal) > 0)) return;  // all in one line: there is no side to fold to
    normal = glm::normalize(normal);
    // as many edges as can be from up to down: greedily, one vertex after another
    std::vector<int> side(coarse.positions.size(), 0);
    for (int round = 0; round < 8; ++round)
        for (size_t v = 0; v < side.size(); ++v) {
            int sum = 0;
            for (const Pair& edge : edges) {
                if (size_t(edge.first) == v) sum += side[size_t(edge.second)];
                if (size_t(edge.second) == v) sum += side[size_t(edge.first)];
            }
            side[v] = sum > 0 ? -1 : 1;
        }
    for (size_t v = 0; v < side.size(); ++v)
        coarse.positions[v] += 0.5 * height * side[v] * normal;
}

struct TornSkin : Error {
    using Error::Error;
};

// Returns what a molecule is made of, of which the skin keeps all.
Mesh withoutDoubledWalls(Mesh mesh) {
    const std::vector<char> doubled = doubledWalls(mesh);
    std::vector<glm::ivec3> kept;
    for (size_t t = 0; t < doubled.size(); ++t)
        if (!doubled[t]) kept.push_back(mesh.triangles[t]);
    if (kept.size() == mesh.triangles.size()) return mesh;
    mesh.triangles = std::move(kept);
    mesh.objects.clear();
    mesh.parts.clear();
    return mesh;
}

// One run of makeMolecule, step by step.
class Maker {
  public:
    // `mesh`: placed; `shape`: the same without what is there twice.
    Maker(const Mesh& mesh, const Mesh& shape, const FromMesh& options)
        : options_(options), mesh_(mesh), shape_(shape) {}

    MadeMolecule run() {
        made_.notes = mesh_.notes;
        if (shape_.triangles.size() < mesh_.triangles.size())
            made_.notes.push_back(
                concat(mesh_.triangles.size() - shape_.triangles.size(), " of ", mesh_.triangles.size(),
                       " triangles lie on others or within the shape: only the skin has them"));
        examine();
        refine();
        makeCoarse();
        makeVertices();
        makeSprings();
        scaleStiffness();
        if (options_.swims) made_.beat = addMuscles(molecule(), made_.lowestFrequency);
        if (options_.skin) addSkin();
        return std::move(made_);
    }

  private:
    Molecule& molecule() { return made_.molecule; }

    void examine() {
        SurfaceReport report = examineSurface(shape_);
        if (report.triangles <= report.degenerate) throw Error("every triangle of the mesh has no area");
        made_.area = report.area;
        Mesh closed;
        if (report.borders > 0 && report.borders == report.unsound()) closed = withoutHoles(report);
        const Mesh& body = closed.triangles.empty() ? shape_ : closed;
        made_.solid = report.closed();
        made_.volume = made_.solid ? std::abs(report.volume) : 0;
        made_.extent = mesh_.high - mesh_.low;
        if (options_.springs == FromMesh::Springs::lattice && !made_.solid)
            throw Error("a lattice of tetrahedra fills a volume, and this mesh has none: ", whyOpen(report));
        if (made_.solid) inside_ = std::make_unique<Inside>(body);
        constexpr size_t leastSamples = 100;  // fewer tell nothing of how a mass is spread
        if (inside_ && inside_->samples().size() < leastSamples) {
            inside_.reset();
            made_.solid = false;
            made_.volume = 0;
            if (options_.springs == FromMesh::Springs::lattice)
                throw Error("a lattice of tetrahedra fills a volume, and this mesh is too thin for any");
            made_.area *= 0.5;  // it has two sides
            made_.notes.push_back("the mesh is so thin for its size that it is taken for a sheet");
        }
        // Parts that face inwards and outwards cancel out in the sum over triangles, never in the samples.
        if (inside_ && made_.volume < 0.1 * inside_->volume()) made_.volume = inside_->volume();
        if (!made_.solid && !report.closed())
            made_.notes.push_back("the mesh is a sheet, not a body: " + whyOpen(report));
        const double longest = std::max({made_.extent.x, made_.extent.y, made_.extent.z});
        if (!options_.size && (longest > 20 || longest < 1e-3))
            made_.notes.push_back(concat("the file's lengths were taken as metres, which makes it ", longest,
                                         " m long: --size gives another"));
        const char* usual = made_.solid || bulky() ? "flesh" : "leaf";
        made_.material = !options_.material.empty() ? options_.material : usual;
        material_ = &scaledMaterial(made_.material);
    }

    // With small holes closed, where that makes it a body, of which `report` tells then; else empty.
    Mesh withoutHoles(SurfaceReport& report) {
        constexpr double small = 0.05;  // of the area
        Mesh out = shape_;
        const int holes = closeHoles(out, small * report.area);
        const SurfaceReport now = examineSurface(out);
        if (holes == 0 || !now.closed()) return {};
        made_.notes.push_back(concat(many(holes, "hole was", "holes were"), " closed, at the first at (",
                                     report.where.x, ", ", report.where.y, ", ", report.where.z,
                                     "), to make it a body; the skin keeps them"));
        report = now;
        return out;
    }

    int wantedVertices() const {
        const bool cage = options_.springs == FromMesh::Springs::cage;
        return options_.vertices.value_or(cage ? cageVertices : usualMadeVertices);
    }

    // A sheet of a few large triangles could hardly bend.
    void refine() {
        const bool ofSurface = options_.springs == FromMesh::Springs::automatic ||
                               options_.springs == FromMesh::Springs::surface;
        const size_t few = mesh_.weldedPositions.size(), wanted = size_t(wantedVertices());
        if (made_.solid || options_.rings || !ofSurface || 2 * few > wanted) return;
        constexpr size_t skinVertices = 4;  // for each that is simulated, so that the skin bends smoothly
        subdivide(mesh_, skinVertices * wanted, size_t(maxSkinTriangles));
        shape_ = withoutDoubledWalls(mesh_);
        made_.notes.push_back(concat(
            "the sheet has ", few, " vertices, too few to bend: its longest edges were halved until it had ",
            mesh_.weldedPositions.size()));
    }

    void makeCoarse() {
        using Springs = FromMesh::Springs;
        const int vertices = wantedVertices();
        if (options_.rings) {
            coarse_ = ringsOf(mesh_, *options_.rings);
        } else if (options_.springs == Springs::lattice || options_.springs == Springs::cage) {
            Lattice lattice = options_.springs == Springs::cage ? cageAround(shape_, inside_.get(), vertices)
                                                                : latticeIn(shape_, *inside_, vertices);
            coarse_ = std::move(lattice.surface);
            cells_ = std::move(lattice.cells);
        } else {
            coarse_ = simplify(shape_, vertices);
        }
        if (coarse_.positions.size() < 3) throw Error("the mesh has no shape that three vertices could hold");
        mapToCoarse(mesh_, coarse_);
        if (made_.solid || !cells_.empty()) return;
        // Without it every bend of a flat sheet would be free.
        constexpr double leastFlatness = 0.05, height = 0.12;
        if (coarse_.positions.size() < 4 || flatness(coarse_.positions) >= leastFlatness) return;
        const double size = std::max({made_.extent.x, made_.extent.y, made_.extent.z});
        fold(coarse_, height * size);
        made_.notes.push_back(concat("the sheet is flat: its vertices were folded up and down by ", height,
                                     " of its size, so that it resists bending; the skin stays flat"));
    }

    void makeVertices() {
        const Spread spread = inside_ ? spreadOfBody(coarse_, *inside_) : spreadOfSheet(shape_, coarse_);
        const double density = options_.density.value_or(material_->density);
        const double mass =
            options_.mass.value_or(density * (inside_ ? made_.volume : made_.area * material_->thickness));
        density_ = inside_ ? mass / made_.volume : mass / (made_.area * material_->thickness);
        length_ = extentAlong(spread.axis);
        // A plate has the modulus E / (1 - nu^2) and a section as thick as the sheet. A bent shape bends as a
        // whole.
        const double plate = material_->thickness / std::sqrt(12 * (1 - 0.09));
        // The plate's radius is the least: a bulky shape, too, may have its mass in one plane.
        gyration_ = inside_ || bulky() ? std::max(spread.gyration, plate) : plate;
        const std::vector<bool> pinned = choosePins(mesh_, coarse_, options_.pins);
        const double size = std::max({made_.extent.x, made_.extent.y, made_.extent.z});
        for (size_t i = 0; i < coarse_.positions.size(); ++i) {
            Vertex vertex;
            vertex.position = rounded(coarse_.positions[i], size);
            vertex.mass = std::clamp(rounded(mass * spread.shares[i], 4), 1e-12, 1e12);
            vertex.pinned = pinned[i];
            if (!mesh_.uvs.empty()) vertex.uv = glm::round(uvAt(i) * 1e6) / 1e6;
            molecule().vertices.push_back(vertex);
        }
        for (const glm::ivec3& t : coarse_.triangles)
            molecule().triangles.push_back({t.x, t.y, t.z});
        molecule().name = options_.name;
        chooseLooks();
    }

    // The means over vertices and over the triangles of parts: what a molecule has for all of them.
    void chooseLooks() {
        Material& looks = molecule().material;
        glm::dvec3 color(1);
        if (!mesh_.colors.empty()) {
            color = glm::dvec3(0);
            for (const glm::dvec3& one : mesh_.colors)
                color += glm::clamp(one, 0.0, 1.0) / double(mesh_.colors.size());
        }
        glm::dvec3 factor(0);
        double roughness = 0, metallic = 0;
        int known = 0;
        for (const Mesh::Part& part : mesh_.parts) {
            if (part.look < 0) continue;
            const SurfaceMaterial& material = mesh_.materials[size_t(part.look)];
            factor += double(part.triangleCount) * glm::dvec3(material.color);
            roughness += part.triangleCount * material.roughness;
            metallic += part.triangleCount * material.metallic;
            known += part.triangleCount;
        }
        const auto rounded3 = [](double value) { return std::round(value * 1e3) / 1e3; };
        const bool said = !mesh_.colors.empty() || (known > 0 && factor != glm::dvec3(known));
        if (known > 0) color *= factor / double(known);
        if (said) looks.color = glm::round(color * 1e3) / 1e3;
        if (known == 0) return;
        if (roughness != known * SurfaceMaterial().roughness) looks.roughness = rounded3(roughness / known);
        looks.metallic = rounded3(metallic / known);
    }

    double extentAlong(const glm::dvec3& axis) const {
        double low = 1e300, high = -1e300;
        for (const glm::dvec3& p : mesh_.weldedPositions) {
            low = std::min(low, glm::dot(p, axis));
            high = std::max(high, glm::dot(p, axis));
        }
        return high - low;
    }

    // A surface that encloses nothing and still has three extents, a shell, or is held by cells.
    bool bulky() const {
        return options_.springs == FromMesh::Springs::cage || flatness(mesh_.weldedPositions) > 0.2;
    }

    glm::dvec2 uvAt(size_t coarse) const {
        for (size_t v = 0; v < mesh_.weld.size(); ++v)
            if (mesh_.weld[v] == coarse_.source[coarse]) return mesh_.uvs[v];
        return glm::dvec2(0);
    }

    void addSprings(const std::vector<Pair>& pairs, int& count) {
        for (const Pair& pair : pairs) {
            Spring spring{pair.first, pair.second, 0, 0, {}, {}};
            const double length = molecule().restLength(spring);
            if (!(length > 1e-9)) continue;
            spring.stiffness = 1;  // all alike: short ones do not set the step
            molecule().springs.push_back(spring);
            ++count;
        }
    }

    void makeSprings() {
        SpringPairs pairs;
        if (options_.rings) {
            pairs = springsOfRings(*options_.rings);
        } else if (cells_.empty()) {
            pairs = springsOf(coarse_, inside_.get());
        } else {
            for (const std::array<int, 4>& cell : cells_)
                for (size_t i = 0; i < 4; ++i)
                    for (size_t j = i + 1; j < 4; ++j)
                        pairs.add(pairs.edges, cell[i], cell[j]);
        }
        addSprings(pairs.edges, made_.edges);
        addSprings(pairs.shears, made_.shears);
        addSprings(pairs.bends, made_.bends);
        addSprings(pairs.braces, made_.braces);
        const Bracing bracing = brace(molecule(), inside_.get());
        addSprings(bracing.added, made_.repairs);
        if (made_.repairs > 0)
            made_.notes.push_back(concat(made_.repairs, made_.repairs == 1 ? " spring was" : " springs were",
                                         " added where motions had little or no stiffness"));
        if (bracing.left > 0)
            made_.notes.push_back(
                concat(bracing.left, " motions stay without stiffness: no pair of vertices resists them"));
    }

    // All springs by one factor, so that the lowest frequency is the material's; damping likewise.
    void scaleStiffness() {
        const double target =
            options_.frequency.value_or(lowestFrequency(material_->modulus, density_, length_, gyration_));
        const Analysis unit = analyse(molecule(), false);
        if (!(unit.lowestFrequency > 0)) throw Error("the springs leave nothing that could swing");
        // C = beta K: the ratio of a mode grows with its frequency. Beyond half of critical it would cost
        // steps, and show nothing.
        constexpr double mostRatio = 0.5;
        made_.dampingRatio = options_.damping.value_or(
            std::min(material_->damping, mostRatio * unit.lowestFrequency / unit.highestFrequency));
        const double wanted = 2 * pi * target;
        const double factor = wanted * wanted / (unit.lowestFrequency * unit.lowestFrequency);
        for (Spring& spring : molecule().springs) {
            spring.stiffness = rounded(factor * spring.stiffness, 4);
            spring.damping = rounded(2 * made_.dampingRatio / wanted * spring.stiffness, 4);
        }
        made_.lowestFrequency = analyse(molecule(), false).lowestFrequency / (2 * pi);
    }

    void addSkin() {
        if (options_.images) {
            made_.image = gatherColors(mesh_, made_.notes);
            if (made_.image) molecule().material.color = glm::dvec3(1);
        }
        const SkinMesh mesh = skinMeshOf(mesh_, options_.skinTriangles);
        if (options_.springs == FromMesh::Springs::cage) {
            molecule().skin = bindToCells(molecule(), mesh, cells_);
            placeSkin(molecule());
        } else {
            molecule().skin = bindSkin(molecule(), mesh);
        }
        double& lever = made_.skinLever;
        for (size_t i = 0; i < mesh.positions.size(); ++i) {
            const SkinVertex& vertex = molecule().skin.vertices[i];
            made_.skinError = std::max(made_.skinError, glm::distance(mesh.positions[i], vertex.position));
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vertex& simulated : molecule().vertices)
                nearest = std::min(nearest, glm::distance(vertex.position, simulated.position));
            made_.skinReach = std::max(made_.skinReach, nearest);
            for (const SkinWeight& weight : vertex.weights)
                lever = std::max(lever, std::abs(weight.weight));
        }
        constexpr double mostError = 1e-3, mostLever = 10;
        const double off = made_.skinError / molecule().size();
        if (off > mostError || lever > mostLever)
            throw TornSkin("the skin would tear: with ", molecule().vertices.size(),
                           " simulated vertices it ",
                           off > mostError ? concat("would hang ", off, " of the size off the mesh")
                                           : concat("would move ", lever, " times as far as one of them"),
                           ". Ask for more vertices, for rings, or for no skin");
    }

    const FromMesh& options_;
    Mesh mesh_;   // all of it
    Mesh shape_;  // without what is there twice
    std::unique_ptr<Inside> inside_;
    const ScaledMaterial* material_ = nullptr;
    CoarseMesh coarse_;
    std::vector<std::array<int, 4>> cells_;
    double density_ = 0, length_ = 0, gyration_ = 0;
    MadeMolecule made_;
};

}  // namespace

void checkOptions(const FromMesh& o) {
    const auto above = [](const char* what, const std::optional<double>& value, double most,
                          const char* unit) {
        if (value && !(*value > 0 && *value <= most))
            throw Error(what, ": expected a number above 0, at most ", most, unit, ", found ", *value);
    };
    above("size", o.size, 1e5, " m");
    above("mass", o.mass, 1e9, " kg");
    above("density", o.density, 1e5, " kg/m^3");
    above("frequency", o.frequency, 1e5, " Hz");
    if (o.damping && !(*o.damping >= 0 && *o.damping <= 2))
        throw Error("damping: expected a ratio from 0 to 2, found ", *o.damping);
    if (!o.material.empty()) {
        try {
            scaledMaterial(o.material);
        } catch (const Error& error) {
            throw Error("material: ", error.message());
        }
    }
    if (o.mass && o.density) throw Error("mass: expected either a mass or a density, found both");
    const int64_t asked = o.rings ? 4 * int64_t(*o.rings) : o.vertices.value_or(usualMadeVertices);
    if (o.skinTriangles && *o.skinTriangles < 4)
        throw Error("skin-triangles: expected at least 4, found ", *o.skinTriangles);
    if (o.skinTriangles && !o.skin)
        throw Error("skin-triangles: expected either triangles of the skin or no skin, found both");
    if (o.rings && *o.rings < 2) throw Error("rings: expected at least 2, found ", *o.rings);
    if (!o.rings && asked < leastMadeVertices)
        throw Error("vertices: expected at least ", leastMadeVertices, ", found ", asked);
    if (asked > mostMadeVertices)
        throw Error(o.rings ? "rings" : "vertices", ": a molecule of ", asked,
                    " vertices takes too long to make: at most ", mostMadeVertices,
                    o.rings ? concat(", which are ", mostMadeVertices / 4, " rings") : "");
    if (o.rings && (o.springs == FromMesh::Springs::lattice || o.springs == FromMesh::Springs::cage))
        throw Error("rings: expected either rings or a ",
                    o.springs == FromMesh::Springs::cage ? "cage" : "lattice", ", found both");
}

MadeMolecule makeMolecule(const Mesh& mesh, const FromMesh& options) {
    checkOptions(options);
    if (mesh.triangles.empty()) throw Error("the mesh ", noTriangles);
    const Mesh all = placed(mesh, options), shape = withoutDoubledWalls(all);
    if (options.springs != FromMesh::Springs::automatic || options.rings || !options.skin)
        return Maker(all, shape, options).run();
    // Beyond these limits, parts of the skin that hang over the ends of the simulated surface swing about or
    // hang on another part's vertices, and parts far from all simulated vertices do not bend. The reach is a
    // share of the size.
    constexpr double mostLever = 2, mostReach = 0.25;
    std::string why;
    std::optional<MadeMolecule> plain;
    try {
        plain = Maker(all, shape, options).run();
        const double reach = plain->skinReach / glm::length(plain->extent);
        if (plain->skinLever <= mostLever && reach <= mostReach) return std::move(*plain);
        why = concat("with ", plain->molecule.vertices.size(), " vertices along the surface ",
                     plain->skinLever > mostLever
                         ? concat("the skin would move ", std::round(10 * plain->skinLever) / 10,
                                  " times as far as one of them")
                         : concat("some of the skin would be ", std::round(100 * reach) / 100,
                                  " of its size away from all of them"));
    } catch (const TornSkin& torn) {
        why = torn.message();
    }
    FromMesh inCage = options;
    inCage.springs = FromMesh::Springs::cage;
    try {
        MadeMolecule made = Maker(all, shape, inCage).run();
        made.notes.push_back(concat(why, ": a cage of cells around the mesh holds it instead"));
        return made;
    } catch (const Error& error) {
        if (!plain) throw Error(concat(why, "; and ", error.message()));
    }
    plain->notes.push_back(why);
    return std::move(*plain);
}

}  // namespace shoal
