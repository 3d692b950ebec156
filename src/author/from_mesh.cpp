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
        body_ = body;
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
        material_ = scaledMaterial(made_.material);
        material_.modulus = options_.modulus.value_or(material_.modulus);
        material_.density = options_.density.value_or(material_.density);
        material_.thickness = options_.thickness.value_or(material_.thickness);
        if (options_.thickness && made_.solid)
            throw Error("a body is as thick as it is, and this mesh is one: leave out the thickness");
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

    bool ofSurface() const {
        return options_.springs == FromMesh::Springs::automatic ||
               options_.springs == FromMesh::Springs::surface;
    }
    // A body that is long and thin, with vertices to spare for it.
    bool slender() const {
        constexpr double least = 4;   // times as long as wide
        constexpr size_t fewest = 3;  // rings
        glm::dvec3 sorted = made_.extent;
        std::sort(&sorted.x, &sorted.x + 3);
        return inside_ && ofSurface() && sorted.z > least * sorted.y &&
               size_t(wantedVertices()) >= 4 * fewest;
    }

    // A sheet of a few large triangles could hardly bend.
    void refine() {
        const size_t few = mesh_.weldedPositions.size(), wanted = size_t(wantedVertices());
        if (made_.solid || options_.rings || !ofSurface() || 2 * few > wanted) return;
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
        const bool fewer = shape_.weldedPositions.size() > size_t(vertices);
        rings_ = options_.rings.value_or(fewer && slender() && holdsRings(shape_) ? vertices / 4 : 0);
        std::optional<CoarseMesh> rows;
        constexpr double plane = 1e-3;
        if (fewer && !inside_ && ofSurface() && flatness(shape_.weldedPositions) < plane)
            rows = rowsOf(shape_, vertices);
        regular_ = rings_ > 0 || rows;
        if (rings_ > 0) {
            coarse_ = ringsOf(mesh_, rings_);
        } else if (options_.springs == Springs::lattice || options_.springs == Springs::cage) {
            Lattice lattice = options_.springs == Springs::cage ? cageAround(shape_, inside_.get(), vertices)
                                                                : latticeIn(shape_, *inside_, vertices);
            coarse_ = std::move(lattice.surface);
            cells_ = std::move(lattice.cells);
        } else {
            coarse_ = rows ? std::move(*rows) : simplify(shape_, vertices);
        }
        if (coarse_.positions.size() < 3) throw Error("the mesh has no shape that three vertices could hold");
        mapToCoarse(mesh_, coarse_);
        if (made_.solid || !cells_.empty()) return;
        // Without it every bend of a flat sheet would be free.
        constexpr double leastFlatness = 0.05, height = 0.8;
        if (coarse_.positions.size() < 4 || flatness(coarse_.positions) >= leastFlatness) return;
        fold(coarse_, height * std::sqrt(made_.area / double(coarse_.positions.size())));
        made_.notes.push_back(concat("the sheet is flat: its vertices were folded up and down by ", height,
                                     " of their distance, so that it resists bending; the skin stays flat"));
    }

    void makeVertices() {
        const MassSpread spread = inside_ ? spreadOfBody(coarse_, *inside_) : spreadOfSheet(shape_, coarse_);
        const double volume = inside_ ? made_.volume : made_.area * material_.thickness;
        const double mass = options_.mass.value_or(material_.density * volume);
        material_.density = mass / volume;
        length_ = extentAlong(mesh_, spread.axis);
        // A plate has the modulus E / (1 - nu^2) and a section as thick as the sheet. A bent shape bends as a
        // whole.
        const double plate = material_.thickness / std::sqrt(12 * (1 - 0.09));
        // The plate's radius is the least: a bulky shape, too, may have its mass in one plane.
        gyration_ = inside_ || bulky() ? std::max(spread.gyration, plate) : plate;
        spread_ = spread;
        std::vector<bool> pinned = choosePins(mesh_, coarse_, options_.pins);
        clamp_ = clampOf(mesh_, pinnedOf(mesh_, options_.pins), spread_);
        // What is clamped is held up to there, and no further.
        if (clamp_)
            for (size_t i = 0; i < pinned.size(); ++i)
                pinned[i] = fromClamp(coarse_.positions[i]) < 1e-6 * length_;
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
        chooseLooks(mesh_, molecule().material);
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
        if (rings_ > 0) {
            pairs = springsOfRings(rings_);
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
        const Bracing bracing = brace(molecule(), inside_.get(), !regular_);
        addSprings(bracing.added, made_.repairs);
        if (made_.repairs > 0)
            made_.notes.push_back(concat(made_.repairs, made_.repairs == 1 ? " spring was" : " springs were",
                                         " added where motions had little or no stiffness"));
        if (bracing.left > 0)
            made_.notes.push_back(
                concat(bracing.left, " motions stay without stiffness: no pair of vertices resists them"));
    }

    // As the beam that the mesh is; else all springs by one factor, so that the lowest frequency is as asked
    // or that of a bar.
    void scaleStiffness() {
        if (!options_.frequency && !standsForBeam())
            made_.notes.push_back(
                "it is no beam: its lowest frequency is that of a bar of its length and thickness");
        if (!made_.beam) {
            const double target = options_.frequency.value_or(
                lowestFrequency(material_.modulus, material_.density, length_, gyration_));
            const Analysis unit = analyse(molecule(), false);
            if (!(unit.lowestFrequency > 0)) throw Error("the springs leave nothing that could swing");
            for (Spring& spring : molecule().springs)
                spring.stiffness *= std::pow(2 * pi * target / unit.lowestFrequency, 2);
        }
        for (Spring& spring : molecule().springs)
            spring.stiffness = rounded(spring.stiffness, 4);
        const Analysis analysis = analyse(molecule(), false);
        // C = beta K: the ratio of a mode grows with its frequency. Beyond half of critical it would cost
        // steps, and show nothing.
        constexpr double mostRatio = 0.5;
        made_.dampingRatio = options_.damping.value_or(
            std::min(material_.damping, mostRatio * analysis.lowestFrequency / analysis.highestFrequency));
        for (Spring& spring : molecule().springs)
            spring.damping = rounded(2 * made_.dampingRatio / analysis.lowestFrequency * spring.stiffness, 4);
        made_.lowestFrequency = hertz(analysis.lowestFrequency);
    }

    bool standsForBeam() {
        const std::vector<Spring> before = molecule().springs;
        try {
            if (fitToBeam()) return true;
        } catch (const Error&) {  // some motion has no stiffness
        }
        molecule().springs = before;
        made_.beam.reset();
        return false;
    }

    bool fitToBeam() {
        const BeamMaterial material{material_.modulus, material_.density, inside_ ? 0 : material_.thickness};
        const Beam beam = beamOf(inside_ ? body_ : shape_, spread_, material);
        constexpr double slender = 4;  // length by thickness
        const double thickness = std::sqrt(12) * gyration_, mass = molecule().mass();
        double sum = 0;
        for (const double slice : beam.mass)
            sum += slice;
        // The masses of a mesh whose triangles face both ways are not its own.
        if (!beam.whole() || length_ < slender * thickness || std::abs(sum - mass) > 0.05 * mass)
            return false;
        shapeStiffness(molecule(), beam, spread_);
        if (!(freeFigures(molecule(), beam, spread_, 1).front().molecule > 0)) return false;
        fitFree(molecule(), beam, spread_);
        StandsFor& out = made_.beam.emplace();
        out.material = material;
        out.free = freeFigures(molecule(), beam, spread_, 1).front();
        if (!clamp_) return true;
        while (analyse(molecule(), true).rigidModes > 0)
            pinNextRow();
        // Each factor changes a little of what the other is for.
        constexpr int fewest = 3, rounds = 12;
        constexpr double near = 0.01;
        for (int round = 0; round < rounds; ++round) {
            fitClamped(molecule(), beam, spread_, *clamp_);
            out.free = freeFigures(molecule(), beam, spread_, 1).front();
            if (round + 1 == rounds || (round + 1 >= fewest && std::abs(out.free.error()) < near)) break;
            fitFree(molecule(), beam, spread_);
        }
        out.clamped = clampedFigures(molecule(), beam, spread_, *clamp_, 1);
        out.reach = (clamp_->turned ? -beam.low : beam.high()) - clamp_->place;
        return true;
    }

    // m, from the pinned end of what is clamped.
    double fromClamp(const glm::dvec3& place) const {
        const double along = glm::dot(place, spread_.axis);
        return (clamp_->turned ? -along : along) - clamp_->place;
    }

    void pinNextRow() {  // what is clamped must not turn about a line of vertices
        double nearest = 1e300;
        for (const Vertex& vertex : molecule().vertices)
            if (!vertex.pinned) nearest = std::min(nearest, fromClamp(vertex.position));
        for (Vertex& vertex : molecule().vertices)
            vertex.pinned = vertex.pinned || fromClamp(vertex.position) < nearest + 1e-3 * length_;
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
    ScaledMaterial material_{};  // as asked
    CoarseMesh coarse_;
    std::vector<std::array<int, 4>> cells_;
    Mesh body_;  // shape_ without holes
    MassSpread spread_;
    std::optional<Clamp> clamp_;  // by the pins
    double length_ = 0, gyration_ = 0;
    int rings_ = 0;
    bool regular_ = false;  // in rings or rows
    MadeMolecule made_;
};

}  // namespace

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
