// From a mesh to a molecule with its skin.
#include <algorithm>

#include "author/shapes.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "unit/space_shapes.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("5,000 triangles become 24 braced vertices and a skin", "[from-mesh]") {
    const Mesh mesh = club(50, 51);
    REQUIRE(mesh.triangles.size() == 5000);
    REQUIRE(examineSurface(mesh).closed());
    const MadeMolecule out = made(mesh);
    const Molecule& molecule = out.molecule;
    CHECK(molecule.vertices.size() <= 24);
    CHECK(molecule.vertices.size() >= 20);
    CHECK(out.solid);
    checkBraced(molecule);
    for (const Warning& warning : check(molecule))
        FAIL_CHECK(text(warning));

    CHECK(molecule.skin.triangles.size() == 5000);
    const double size = molecule.size();
    CHECK(out.skinError < 1e-6 * size);
    const double length = mesh.high.z - mesh.low.z;
    const SkinFigures bend = moved(molecule, [&](auto& p) { return bent(p, 30 * degree, length); });
    const SkinFigures twist = moved(molecule, [&](auto& p) { return twisted(p, 20 * degree, length); });
    UNSCOPED_INFO("bent: " << bend.distance / size << " of the size off, volume " << bend.volumeError);
    UNSCOPED_INFO("twisted: " << twist.distance / size << " of the size off, volume " << twist.volumeError);
    CHECK(bend.flipped == 0);
    CHECK(twist.flipped == 0);
    CHECK(bend.volumeError < 0.02);
    CHECK(twist.volumeError < 0.02);
    CHECK(bend.distance < 0.03 * size);
    CHECK(twist.distance < 0.03 * size);
}

TEST_CASE("mass, size and frequencies are as asked", "[from-mesh]") {
    const Mesh mesh = club(24, 25);
    FromMesh options;
    options.size = 0.12;
    MadeMolecule out = made(mesh, options);
    CHECK(std::max({out.extent.x, out.extent.y, out.extent.z}) == Approx(0.12));
    const ScaledMaterial& flesh = scaledMaterial("flesh");
    CHECK(analyse(out.molecule, false).totalMass == Approx(out.volume * flesh.density).epsilon(0.01));
    // a bar of this length, as wide as a club of this width
    const double widest = lowestFrequency(flesh.modulus, flesh.density, 0.12, 0.02);
    CHECK(out.lowestFrequency < widest);
    CHECK(out.lowestFrequency > 0.1 * widest);

    options.mass = 0.5;
    options.frequency = 7;
    options.damping = 0.2;
    options.centre = true;
    out = made(mesh, options);
    const Analysis analysis = analyse(out.molecule, false);
    CHECK(analysis.totalMass == Approx(0.5).epsilon(0.01));
    CHECK(analysis.lowestFrequency == Approx(2 * std::numbers::pi * 7).epsilon(0.01));
    // C = beta K with beta = 2 ratio / frequency
    const Spring& spring = out.molecule.springs.front();
    CHECK(spring.damping == Approx(0.4 / analysis.lowestFrequency * spring.stiffness).epsilon(0.01));
    const double slack = 0.02;
    glm::dvec3 low(1e9), high(-1e9);
    for (const SkinVertex& vertex : out.molecule.skin.vertices)
        low = glm::min(low, vertex.position), high = glm::max(high, vertex.position);
    CHECK(glm::length(low + high) < slack * 0.12);
    // softer and stiffer, in the order of the scale
    options = {};
    double last = 0;
    for (const char* name : {"jelly", "flesh", "rubber"}) {
        options.material = name;
        const double frequency = made(mesh, options).lowestFrequency;
        CHECK(frequency > last);
        last = frequency;
    }
}

// An arrow along an axis of the file, its fin up.
TEST_CASE("an axis of the mesh becomes the way ahead", "[from-mesh]") {
    for (const char* text : {"+X", "-x", "Y", "-Y", "z", "-Z"}) {
        const glm::dvec3 axis = parseAxis(text),
                         up = axis.y == 0 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -axis.y);
        Mesh mesh;
        mesh.positions = {axis, -0.1 * glm::cross(up, axis), 0.2 * up, 0.1 * glm::cross(up, axis),
                          -2.0 * axis};
        mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 1, 2}, {4, 2, 3}, {0, 1, 3}, {4, 3, 1}};
        completeMesh(mesh);
        const glm::dvec3 normal = mesh.normals[2];
        turnForward(mesh, axis);
        INFO(text);
        const glm::dvec3 expected[] = {{0, 0, 1}, {-0.1, 0, 0}, {0, 0.2, 0}, {0.1, 0, 0}, {0, 0, -2}};
        for (size_t i = 0; i < 5; ++i)
            CHECK(glm::distance(mesh.positions[i], expected[i]) < 1e-12);
        CHECK(glm::distance(mesh.low, glm::dvec3(-0.1, 0, -2)) < 1e-12);
        CHECK(glm::distance(mesh.high, glm::dvec3(0.1, 0.2, 1)) < 1e-12);
        CHECK(mesh.normals[2].y == Approx(glm::dot(normal, up)));
    }
    for (const char* wrong : {"", "+", "W", "+XY", "*X", "1,0,0"})
        CHECK_THROWS_AS(parseAxis(wrong), Error);
}

// The muscles bend it as the wave says: with all of them at a phase, no fibre of its middle changes its
// length, and left and right pull in turn.
TEST_CASE("the shape of a fish lies along +Z and has the muscles of a wave", "[from-mesh]") {
    const Shape& shape = shapeNamed("fish");
    const Mesh mesh = shapeMesh(shape, shape.divisions);
    const glm::dvec3 extent = mesh.high - mesh.low;
    CHECK(extent.z == Approx(1));
    CHECK(std::max(extent.x, extent.y) < 0.5);
    const MadeMolecule made = makeMolecule(mesh, ofShape(shape, mesh, {}));
    CHECK(made.beat > 0.5);
    CHECK(made.beat < made.lowestFrequency);
    int left = 0, right = 0;
    for (const Spring& spring : made.molecule.springs) {
        const double reach = bendReach(made.molecule, spring);
        CHECK(spring.actuation.has_value() == (std::abs(reach) > 1e-6 * 0.2));
        if (!spring.actuation) continue;
        CHECK(spring.actuation->frequency == made.beat);
        CHECK(spring.actuation->amplitude < 0.5);
        (reach < 0 ? left : right) += 1;
    }
    CHECK(left > 20);
    CHECK(left == right);
    for (const Shape& other : shapes()) {
        if (other.swims) continue;
        const Mesh plain = shapeMesh(other, 1);
        for (const Spring& spring : makeMolecule(plain, ofShape(other, plain, {})).molecule.springs)
            CHECK_FALSE(spring.actuation);
    }
}

TEST_CASE("a skin of fewer triangles is as large as the mesh", "[from-mesh]") {
    FromMesh options;
    options.skinTriangles = 400;
    const MadeMolecule out = made(club(50, 51), options);
    const Skin& skin = out.molecule.skin;
    CHECK(skin.triangles.size() <= 400);
    CHECK(skin.triangles.size() > 350);
    CHECK(out.skinError < 1e-6);
    Mesh mesh;
    for (const SkinVertex& vertex : skin.vertices)
        mesh.positions.push_back(vertex.position);
    mesh.triangles = trianglesOf(skin);
    completeMesh(mesh);
    const SurfaceReport report = examineSurface(mesh);
    CHECK(report.closed());
    CHECK(report.volume == Approx(out.volume).epsilon(0.03));
    options.skinTriangles = 2;
    CHECK(refused(mesh, options) == "skin-triangles: expected at least 4, found 2");
}

TEST_CASE("a made molecule is written and read back equal", "[from-mesh]") {
    FromMesh options;
    options.pins.rules.push_back(parsePinRule("z<0.1"));
    const Molecule molecule = made(club(16, 17), options).molecule;
    const std::string text = writeMolecule(molecule);
    const Molecule again = parseMolecule(text, "again.json");
    CHECK(writeMolecule(again) == text);
    REQUIRE(again.vertices.size() == molecule.vertices.size());
    REQUIRE(again.springs.size() == molecule.springs.size());
    for (size_t i = 0; i < molecule.vertices.size(); ++i) {
        CHECK(again.vertices[i].position == molecule.vertices[i].position);
        CHECK(again.vertices[i].mass == molecule.vertices[i].mass);
        CHECK(again.vertices[i].pinned == molecule.vertices[i].pinned);
    }
    REQUIRE(again.skin.vertices.size() == molecule.skin.vertices.size());
    bool same = true;
    for (size_t i = 0; i < molecule.skin.vertices.size(); ++i)
        same = same && again.skin.vertices[i].position == molecule.skin.vertices[i].position &&
               again.skin.vertices[i].uv == molecule.skin.vertices[i].uv &&
               again.skin.vertices[i].offset == molecule.skin.vertices[i].offset;
    CHECK(same);
}

TEST_CASE("rings lie across the longest side and bend sideways", "[from-mesh]") {
    FromMesh options;
    options.rings = 6;
    const MadeMolecule out = made(club(24, 25), options);
    const Molecule& molecule = out.molecule;
    REQUIRE(molecule.vertices.size() == 24);
    checkBraced(molecule);
    for (int ring = 0; ring < 6; ++ring) {
        const auto at = [&](int side) { return molecule.vertices[size_t(4 * ring + side)].position; };
        for (int side = 1; side < 4; ++side)
            CHECK(at(side).z == Approx(at(0).z));
        CHECK(at(0).x > at(2).x);  // right, top, left, bottom
        CHECK(at(1).y > at(3).y);
        if (ring > 0) CHECK(at(0).z < molecule.vertices[size_t(4 * ring - 4)].position.z);
    }
    // muscles: along each flank
    const auto sprung = [&](int a, int b) {
        return std::any_of(molecule.springs.begin(), molecule.springs.end(),
                           [&](const Spring& s) { return std::minmax(s.a, s.b) == std::minmax(a, b); });
    };
    for (int ring = 0; ring + 1 < 6; ++ring)
        for (const int side : {0, 2})
            CHECK(sprung(4 * ring + side, 4 * ring + side + 4));
    for (const Warning& warning : check(molecule))
        FAIL_CHECK(text(warning));
    const double length = 1.2;
    const SkinFigures bend = moved(molecule, [&](auto& p) { return bent(p, 30 * degree, length); });
    CHECK(bend.flipped == 0);
    CHECK(bend.volumeError < 0.02);
}

TEST_CASE("a lattice fills the volume with tetrahedra", "[from-mesh]") {
    FromMesh options;
    options.springs = FromMesh::Springs::lattice;
    options.vertices = 60;
    const MadeMolecule out = made(club(24, 25), options);
    CHECK(out.molecule.vertices.size() <= 60);
    CHECK(out.molecule.vertices.size() >= 30);
    checkBraced(out.molecule);
    // the boundary of the lattice is closed and faces outwards
    Mesh hull;
    for (const Vertex& vertex : out.molecule.vertices)
        hull.positions.push_back(vertex.position);
    for (const Triangle& t : out.molecule.triangles)
        hull.triangles.push_back({t.a, t.b, t.c});
    completeMesh(hull);
    const SurfaceReport report = examineSurface(hull);
    CHECK(report.unsound() == 0);
    CHECK(report.volume == Approx(out.volume).epsilon(0.4));
    // every edge of the lattice is one of two lengths
    std::vector<double> lengths;
    for (const Spring& spring : out.molecule.springs)
        lengths.push_back(out.molecule.restLength(spring));
    const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
    CHECK(*most / *least == Approx(2 / std::sqrt(3.0)).epsilon(1e-3));
    const std::string why = refused(strip(8), options);
    CHECK(why.find("lattice") != std::string::npos);
    CHECK(why.find("border edges") != std::string::npos);
}

TEST_CASE("a flat sheet is folded, and its skin stays flat", "[from-mesh]") {
    FromMesh options;
    options.vertices = 16;
    const MadeMolecule out = made(strip(12), options);
    CHECK_FALSE(out.solid);
    CHECK(out.material == "leaf");
    checkBraced(out.molecule);
    CHECK(out.molecule.vertices.size() <= 16);
    for (const Warning& warning : check(out.molecule))
        FAIL_CHECK(text(warning));
    double height = 0, off = 0;
    for (const Vertex& vertex : out.molecule.vertices)
        height = std::max(height, std::abs(vertex.position.z));
    for (const SkinVertex& vertex : out.molecule.skin.vertices)
        off = std::max(off, std::abs(vertex.position.z));
    CHECK(height > 0.005);
    CHECK(off < 1e-6);
    const ScaledMaterial& leaf = scaledMaterial("leaf");
    CHECK(analyse(out.molecule, false).totalMass ==
          Approx(0.1 * 0.2 * leaf.thickness * leaf.density).epsilon(0.01));
    CHECK(std::any_of(out.notes.begin(), out.notes.end(),
                      [](const std::string& note) { return note.find("folded") != std::string::npos; }));
}

// Sag and frequency of a strip of 0.2 m, of which the pins hold the first part, by the closed forms of Euler
// and Bernoulli.
TEST_CASE("a strip sags and swings as a beam of its material, with few vertices and with many",
          "[from-mesh]") {
    for (const int vertices : {12, 48, 192})
        for (const double share : {0.05, 0.2}) {
            FromMesh options;
            options.vertices = vertices;
            options.modulus = 4e7;
            options.thickness = 3e-4;
            options.density = 900;
            options.skin = false;
            options.pins.rules.push_back(parsePinRule(concat("z<", share)));
            const MadeMolecule out = made(sheetMesh(), options);
            CAPTURE(vertices, share);
            const double most = vertices == 12 ? 0.07 : 0.05;
            REQUIRE(out.beam);
            REQUIRE(out.beam->clamped);
            const double length = 0.2 * (1 - share), stiffness = 4e7 * 0.05 * std::pow(3e-4, 3) / 12;
            const double line = 900 * 3e-4 * 0.05;  // kg/m
            CHECK(out.beam->reach == Approx(length).epsilon(1e-6));
            CHECK(out.molecule.mass() == Approx(0.2 * line).epsilon(1e-3));
            const Likeness &sag = out.beam->clamped->sag, &first = out.beam->clamped->frequencies.at(0);
            CHECK(sag.beam == Approx(line * 9.81 * std::pow(length, 4) / (8 * stiffness)).epsilon(0.01));
            CHECK(sag.molecule == Approx(sag.beam).epsilon(most));
            const double unit = std::sqrt(stiffness / line) / (2 * std::numbers::pi);
            CHECK(first.beam == Approx(3.516 * unit / (length * length)).epsilon(0.01));
            CHECK(first.molecule == Approx(first.beam).epsilon(most));
            CHECK(out.beam->free.beam == Approx(22.373 * unit / (0.2 * 0.2)).epsilon(0.01));
            CHECK(out.beam->free.molecule == Approx(out.beam->free.beam).epsilon(0.05));
            // What is told is what the molecule does.
            const std::vector<Mode> modes = modesOf(out.molecule, true, 2);
            CHECK(std::min(std::abs(hertz(modes[0].frequency) - first.molecule),
                           std::abs(hertz(modes[1].frequency) - first.molecule)) < 1e-3 * first.molecule);
        }
}

TEST_CASE("triangles that face both ways come out facing alike", "[from-mesh]") {
    Mesh mesh = strip(12);
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        std::swap(mesh.triangles[t].x, mesh.triangles[t].y);
    const MadeMolecule out = made(mesh);
    for (const Warning& warning : check(out.molecule))
        FAIL_CHECK(text(warning));
    CHECK(out.molecule.triangles.size() > 10);
}

TEST_CASE("pins survive by rule, by name and by paint", "[from-mesh]") {
    Mesh mesh = club(24, 25);
    mesh.parts = {{"handle", "wood", 0, 60}};
    mesh.colors.assign(mesh.positions.size(), glm::dvec3(1));
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        if (mesh.positions[i].z > 0.35) mesh.colors[i] = {0.9, 0.1, 0.05};
    const auto pinnedBeyond = [&](const FromMesh& options, auto&& where) {
        const Molecule molecule = made(mesh, options).molecule;
        int pinned = 0;
        for (const Vertex& vertex : molecule.vertices) {
            pinned += vertex.pinned ? 1 : 0;
            if (vertex.pinned) CHECK(where(vertex.position));
        }
        return pinned;
    };
    FromMesh rule;
    rule.pins.rules = {parsePinRule("z<0.2")};
    CHECK(pinnedBeyond(rule, [](const glm::dvec3& p) { return p.z < -0.2; }) >= 2);
    FromMesh metres;
    metres.pins.rules = {parsePinRule("z>0.3m")};
    CHECK(pinnedBeyond(metres, [](const glm::dvec3& p) { return p.z > 0.2; }) >= 2);
    FromMesh paint;
    paint.pins.paints = {"red"};
    CHECK(pinnedBeyond(paint, [](const glm::dvec3& p) { return p.z > 0.2; }) >= 2);
    FromMesh name;
    name.pins.names = {"wood"};
    CHECK(pinnedBeyond(name, [](const glm::dvec3&) { return true; }) >= 1);

    FromMesh wrong;
    wrong.pins.names = {"iron"};
    CHECK(refused(mesh, wrong).find("it has club, handle, wood") != std::string::npos);
    wrong = {};
    wrong.pins.paints = {"blue"};
    CHECK(refused(mesh, wrong) == "no vertex of the mesh is painted blue");
    wrong = {};
    wrong.pins.rules = {parsePinRule("y>2m")};
    CHECK(refused(mesh, wrong) == "no vertex of the mesh meets y>2m");
    for (const char* text : {"", "y", "y<", "q<1", "y=1", "y<1cm", "y<nan", "y<0.1m "})
        CHECK(messageOf([&] { parsePinRule(text); }).find("expected a rule such as") != std::string::npos);
    for (const char* text : {"", "rad", "1,2,0", "1,0", "1,0,0,0"})
        CHECK(messageOf([&] { parsePaint(text); }).find("expected a colour") != std::string::npos);
}
