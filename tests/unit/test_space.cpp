// The error in space: molecules of few vertices beside the beams that they stand for.
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "author/beam_fit.h"
#include "core/file.h"
#include "molecule/statics.h"
#include "reference/solve.h"
#include "unit/space_shapes.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr double poisson = 0.3;

struct SpaceShape {
    std::string name;
    Mesh mesh;
    std::string pin;
    BeamMaterial material;
};

std::vector<SpaceShape> spaceShapes() {
    const BeamMaterial leaf{1e7, 800, 2.5e-4}, flesh{1e5, 1050, 0};
    return {
        {"sheet", sheetMesh(), "z<0.2", leaf},
        {"rod", rodMesh(), "z<0.2", flesh},
        {"leaf", leafMesh(), "z<0.2", leaf},
        {"fish", loadMesh(std::string(SHOAL_SOURCE_DIR) + "/molecules/minnow.obj", false), "z>0.8", flesh}};
}

// Vertices at the free end: those beyond a place of the axis, so many that they are no line along it.
std::vector<size_t> endOf(const Molecule& molecule, const glm::dvec3& axis) {
    std::vector<std::pair<double, size_t>> order;
    for (size_t i = 0; i < molecule.vertices.size(); ++i)
        order.emplace_back(-glm::dot(molecule.vertices[i].position, axis), i);
    std::sort(order.begin(), order.end());
    std::vector<size_t> out;
    double last = order[0].first;
    for (const auto& [place, vertex] : order) {
        if (out.size() >= 2 && place > last + 1e-3) break;
        out.push_back(vertex);
        last = place;
    }
    return out;
}

// Turned by a torque of 1 N m about the axis, rad; and where, m along it.
std::pair<double, double> twistOf(const Molecule& molecule, const glm::dvec3& axis) {
    const std::vector<size_t> end = endOf(molecule, axis);
    glm::dvec3 middle(0);
    for (const size_t i : end)
        middle += molecule.vertices[i].position / double(end.size());
    double inertia = 0;
    const auto arm = [&](size_t i) { return glm::cross(axis, molecule.vertices[i].position - middle); };
    for (const size_t i : end)
        inertia += glm::dot(arm(i), arm(i));
    VertexVectors loads(molecule.vertices.size(), glm::dvec3(0));
    for (const size_t i : end)
        loads[i] = arm(i) / inertia;
    const VertexVectors moved = displacements(molecule, true, loads);
    double angle = 0;
    for (const size_t i : end)
        angle += glm::dot(arm(i), moved[i]) / inertia;
    return {angle, glm::dot(middle, axis)};
}

double bucklingOf(const Molecule& molecule, const glm::dvec3& axis) {
    const std::vector<size_t> end = endOf(molecule, axis);
    VertexVectors loads(molecule.vertices.size(), glm::dvec3(0));
    for (const size_t i : end)
        loads[i] = -axis / double(end.size());
    return bucklingFactor(molecule, loads);
}

// Relative errors; nothing where there is no figure to compare with.
struct SpaceRow {
    std::string shape, made;
    int asked = 0;
    std::vector<std::optional<double>> errors;  // in the order of the head
};

const std::string spaceFile = std::string(SHOAL_SOURCE_DIR) + "/docs/accuracy/space.csv";
const std::string spaceHead = "shape,made,vertices,sag,first,second,third,twist,buckling,free";

std::string asText(const SpaceRow& row) {
    std::string out = concat(row.shape, ",", row.made, ",", row.asked);
    for (const std::optional<double>& error : row.errors) {
        char number[32] = "";
        if (error) std::snprintf(number, sizeof number, "%.4f", *error);
        out += concat(",", number);
    }
    return out;
}

SpaceRow measure(const SpaceShape& shape, int vertices) {
    FromMesh options;
    options.vertices = vertices;
    if (shape.name == "fish") options.rings = vertices / 4;
    options.skin = false;
    options.pins.rules.push_back(parsePinRule(shape.pin));
    const Molecule molecule = made(shape.mesh, options).molecule;
    const MassSpread spread = spreadOfSheet(shape.mesh);
    const Beam beam = beamOf(shape.mesh, spread, shape.material);
    const std::optional<Clamp> clamp = clampOf(shape.mesh, pinnedOf(shape.mesh, options.pins), spread);
    REQUIRE(clamp);
    const ClampedFigures figures = clampedFigures(molecule, beam, spread, *clamp, 3);
    const Beam part = (clamp->turned ? beam.turned() : beam).from(clamp->place);
    const glm::dvec3 axis = clamp->turned ? -spread.axis : spread.axis;
    const auto [angle, place] = twistOf(molecule, axis);
    // [Timoshenko 1970]: G b h^3 / 3 of a thin strip, which is 4 E I G / E.
    double twist = 0;
    const double shear = shape.material.modulus / (2 * (1 + poisson));
    if (shape.material.thickness > 0)
        for (size_t i = 0; i < part.mass.size() && part.middle(i) < place; ++i)
            twist += part.step / (4 * part.bending[i] / (2 * (1 + poisson)));
    else if (shape.name == "rod")
        twist = (place - part.low) / (shear * std::numbers::pi / 2 * std::pow(0.01, 4));
    SpaceRow out{shape.name, "now", vertices, {figures.sag.error()}};
    for (const Likeness& frequency : figures.frequencies)
        out.errors.push_back(frequency.error());
    out.errors.push_back(twist > 0 ? std::optional(angle / twist - 1) : std::nullopt);
    out.errors.push_back(bucklingOf(molecule, axis) / bucklingLoad(part) - 1);
    out.errors.push_back(freeFigures(molecule, beam, spread, 1)[0].error());
    return out;
}

}  // namespace

// SHOAL_UPDATE_SPACE=1 writes the rows anew, but those of how molecules were made before.
TEST_CASE("the error in space is what docs/accuracy/space.csv says", "[space]") {
    std::istringstream lines(readFile(spaceFile));
    std::vector<std::string> kept, said;
    for (std::string line; std::getline(lines, line);)
        (line.find(",now,") == std::string::npos ? kept : said).push_back(line);
    REQUIRE(kept.at(0) == spaceHead);
    std::vector<SpaceRow> rows;
    for (const SpaceShape& shape : spaceShapes())
        for (const int vertices : {12, 24, 48, 96, 192})
            rows.push_back(measure(shape, vertices));
    if (std::getenv("SHOAL_UPDATE_SPACE")) {
        for (const SpaceRow& row : rows)
            kept.push_back(asText(row));
        std::string text;
        for (const std::string& line : kept)
            text += line + "\n";
        writeFile(spaceFile, text);
        return;
    }
    REQUIRE(said.size() == rows.size());
    for (size_t i = 0; i < rows.size(); ++i) {
        INFO(said[i]);
        INFO(asText(rows[i]));
        std::istringstream cells(said[i]);
        std::string cell;
        for (int key = 0; key < 3; ++key)
            std::getline(cells, cell, ',');
        CHECK(std::stoi(cell) == rows[i].asked);
        for (const std::optional<double>& error : rows[i].errors) {
            std::getline(cells, cell, ',');
            REQUIRE(cell.empty() == !error);
            if (error) CHECK(std::stod(cell) == Approx(*error).margin(0.01).epsilon(0.02));
        }
        // The two figures that molecules are fitted to.
        const double most = rows[i].asked == 12 ? 0.09 : 0.05;
        CHECK(std::abs(*rows[i].errors[0]) < most);
        CHECK(std::abs(*rows[i].errors[1]) < most);
    }
}

namespace {

// The sag of the end of a bar under its own weight by its length, bent as far as it will: E I t'' =
// -q (L - s) cos t of the slope t, by shooting. `load`: q L^3 / E I.
double elasticaSag(double load) {
    constexpr int steps = 2000;
    constexpr double h = 1.0 / steps;
    double low = 0, high = load, sag = 0;  // of the curvature at the clamp
    for (int round = 0; round < 50; ++round) {
        double slope = 0, curvature = 0.5 * (low + high);
        const double start = curvature;
        sag = 0;
        for (int i = 0; i < steps; ++i) {
            const double middle = slope + 0.5 * h * curvature;
            sag += h * std::sin(middle);
            const double before = curvature;
            curvature -= h * load * (1 - (i + 0.5) * h) * std::cos(middle);
            slope += 0.5 * h * (before + curvature);
        }
        (curvature > 0 ? high : low) = start;
    }
    return sag;
}

}  // namespace

TEST_CASE("bent far, a strip lies where the elastica does", "[space]") {
    CHECK(elasticaSag(0.01) == Approx(0.01 / 8).epsilon(1e-3));
    FromMesh options;
    options.vertices = 96;
    options.skin = false;
    options.modulus = 8.57e8;
    options.thickness = 3e-4;
    options.pins.rules.push_back(parsePinRule("z<0.2"));
    const MadeMolecule out = made(sheetMesh(), options);
    reference::Problem problem;
    problem.molecule = &out.molecule;
    problem.gravity = {0, -9.81, 0};
    problem.drag.normal = problem.drag.tangent = 15;
    reference::State state;
    for (const Vertex& vertex : out.molecule.vertices) {
        state.position.push_back(vertex.position);
        state.velocity.emplace_back(0);
    }
    constexpr double duration = 3;
    state = reference::integrate(problem, state, duration, 2 * reference::firstSteps(problem, duration));
    double sag = 0, fastest = 0;
    const std::vector<size_t> end = endOf(out.molecule, {0, 0, 1});
    for (const size_t i : end)
        sag += (out.molecule.vertices[i].position.y - state.position[i].y) / double(end.size());
    for (const glm::dvec3& velocity : state.velocity)
        fastest = std::max(fastest, glm::length(velocity));
    CHECK(fastest < 1e-3);
    const double length = out.beam->reach, stiffness = 8.57e8 * 0.05 * std::pow(3e-4, 3) / 12;
    const double load = 800 * 3e-4 * 0.05 * 9.81 * std::pow(length, 3) / stiffness;
    UNSCOPED_INFO("a load of " << load << ": " << sag / length << " of its length, elastica "
                               << elasticaSag(load));
    CHECK(sag / length == Approx(elasticaSag(load)).epsilon(0.05));
}
