#include "author/from_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "author/coarse.h"
#include "author/mass_spread.h"
#include "author/placed_mesh.h"
#include "author/springs.h"
#include "core/activity.h"
#include "core/error.h"
#include "geometry/close_holes.h"
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

struct TornSkin : Error {
    using Error::Error;
};

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
        const Activity activity("looking for what the mesh encloses");
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
        const SurfaceReport examined = examineSurface(out);
        if (holes == 0 || !examined.closed()) return {};
        made_.notes.push_back(concat(many(holes, "hole was", "holes were"), " closed, at the first at (",
                                     report.where.x, ", ", report.where.y, ", ", report.where.z,
                                     "), to make it a body; the skin keeps them"));
        report = examined;
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
        const Activity activity("simplifying the mesh");
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
        const MassSpread spread = inside_ ? spreadOfBody(coarse_, *inside_) : spreadOfSheet(shape_, coarse_);
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
            for (const glm::dvec3& vertexColor : mesh_.colors)
                color += glm::clamp(vertexColor, 0.0, 1.0) / double(mesh_.colors.size());
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
        const Activity activity("binding the skin");
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
