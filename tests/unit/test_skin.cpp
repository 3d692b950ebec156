// Skins: their key in a molecule file, how they move, and which vertices they depend on.
#include "core/random.h"
#include "molecule/molecule_file.h"
#include "molecule/skin.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;

namespace {

const char* const corners = R"("vertices": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]},
    {"position": [0, 1, 0]}, {"position": [0, 0, 1]}], "triangles": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])";

std::string file(const std::string& skin) {
    return concat(R"({"format": "shoal-molecule-1", "defaults": {"mass": 1}, )", corners,
                  ", \"skin\": ", skin, "}");
}
std::string refusal(const std::string& skin) {
    return messageOf([&] { parseMolecule(file(skin), "f"); });
}
void says(const std::string& message, const std::string& part, const std::string& path) {
    INFO(message);
    CHECK(message.starts_with("f:"));
    CHECK(message.find(part) != std::string::npos);
    CHECK(message.find("(at " + path + ")") != std::string::npos);
}

// Twelve vertices about the origin that span everything, a convex hull of no meaning, and a ball for a skin.
Molecule ball(double& radius) {
    Molecule out;
    Random random(7);
    for (int i = 0; i < 12; ++i)
        out.vertices.push_back(
            {.position = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, .mass = 1});
    radius = 0.8;
    SkinMesh mesh;
    constexpr int sides = 20, rows = 11;
    for (int row = 0; row < rows; ++row)
        for (int side = 0; side < sides; ++side) {
            const double a = 6.283185307179586 * side / sides, b = 3.141592653589793 * (row + 0.5) / rows;
            mesh.positions.push_back(
                radius * glm::dvec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b)));
            mesh.uvs.emplace_back(double(side) / sides, 0.25);
            const int here = row * sides + side, beside = row * sides + (side + 1) % sides;
            if (row == 0) continue;
            mesh.triangles.push_back({here - sides, here, beside});
            mesh.triangles.push_back({here - sides, beside, beside - sides});
        }
    out.skin = bindSkin(out, mesh);
    return out;
}

}  // namespace

TEST_CASE("a skin is read, placed by its weights, and written equal", "[skin]") {
    const std::string text =
        file(R"({"weights": [[0, 0.5, 1, 0.5], [1, 0.25, 2, 0.75], [3, 1], [0, -1, 1, 1, 2, 1]],
        "uvs": [[0, 0], [1, 0], [0.5, 1], [0, 0.25]], "offsets": [0, 0, 0, 0.5], "triangles": [[0, 1, 2], [1, 3, 2]]})");
    const Molecule m = parseMolecule(text, "f");
    REQUIRE(m.skin.vertices.size() == 4);
    CHECK(m.skin.vertices[0].position == glm::dvec3(0.5, 0, 0));
    CHECK(m.skin.vertices[1].position == glm::dvec3(0.25, 0.75, 0));
    CHECK(m.skin.vertices[2].position == glm::dvec3(0, 0, 1));
    CHECK(m.skin.vertices[3].uv == glm::dvec2(0, 0.25));
    // the mean normal of the three vertices, by hand: area vectors (0,0,-1), (0,-1,0), (-1,0,0), (1,1,1)
    const glm::dvec3 n0 = glm::normalize(glm::dvec3(-1, -1, -1)), n1(1, 0, 0), n2(0, 1, 0);
    const glm::dvec3 outward = glm::normalize(-n0 + n1 + n2);
    CHECK(glm::distance(m.skin.vertices[3].position, glm::dvec3(1, 1, 0) + 0.5 * outward) < 1e-12);
    CHECK(m.skin.triangles[1].b == 3);
    const std::string written = writeMolecule(m);
    const Molecule again = parseMolecule(written, "f");
    CHECK(writeMolecule(again) == written);
    CHECK(again.skin.vertices[3].position == m.skin.vertices[3].position);
    CHECK(again.skin.vertices[3].offset == 0.5);
    // without what is all zero
    CHECK(writeMolecule(
              parseMolecule(file(R"({"weights": [[0, 1], [1, 1], [2, 1]], "triangles": [[0, 1, 2]]})"), "f"))
              .find("uvs") == std::string::npos);
}

TEST_CASE("what has no meaning in a skin is refused with its place", "[skin]") {
    const std::string three = R"("weights": [[0, 1], [1, 1], [2, 1]])", one = R"("triangles": [[0, 1, 2]])";
    says(refusal("{}"), "missing key \"weights\"", "$.skin");
    says(refusal("{" + three + "}"), "missing key \"triangles\"", "$.skin");
    says(refusal("{" + three + R"(, "triangles": []})"), "at least one triangle", "$.skin.triangles");
    says(refusal("{" + three + R"(, "triangles": [[0, 1, 3]]})"), "a vertex of the skin, 0 to 2, found 3",
         "$.skin.triangles[0][2]");
    says(refusal("{" + three + R"(, "triangles": [[0, 1, 1]]})"), "three different", "$.skin.triangles[0]");
    says(refusal("{" + three + R"(, "triangles": [[0, 1]]})"), "3 numbers, found 2", "$.skin.triangles[0]");
    says(refusal(R"({"weights": [[0, 0.9]], )" + one + "}"), "add up to 1, found 0.9", "$.skin.weights[0]");
    says(refusal(R"({"weights": [[0, 0.5, 0, 0.5]], )" + one + "}"), "two weights", "$.skin.weights[0]");
    says(refusal(R"({"weights": [[4, 1]], )" + one + "}"), "a vertex of the molecule, 0 to 3, found 4",
         "$.skin.weights[0][0]");
    says(refusal(R"({"weights": [[0.5, 1]], )" + one + "}"), "found 0.5", "$.skin.weights[0][0]");
    says(refusal(R"({"weights": [[0]], )" + one + "}"), "pairs of a vertex and its weight",
         "$.skin.weights[0]");
    says(refusal(R"({"weights": [0], )" + one + "}"), "an array of numbers, found a number",
         "$.skin.weights[0]");
    says(refusal(R"({"weights": [["0", 1]], )" + one + "}"), "a number, found a string",
         "$.skin.weights[0][0]");
    says(refusal(R"({"weights": [[0, 1e9, 1, -1e9]], )" + one + "}"), "to 1e+06", "$.skin.weights[0][1]");
    says(refusal("{" + three + ", " + one + R"(, "uvs": [[0, 0]]})"), "each of the skin's 3", "$.skin.uvs");
    says(refusal("{" + three + ", " + one + R"(, "uvs": [[0], [0], [0]]})"), "2 numbers", "$.skin.uvs[0]");
    says(refusal("{" + three + ", " + one + R"(, "offsets": [0, "a", 0]})"), "a number", "$.skin.offsets[1]");
    says(refusal("{" + three + ", " + one + R"(, "wieghts": []})"), "unknown key", "$.skin.wieghts");
    const std::string flat =
        R"({"format": "shoal-molecule-1", "vertices": [{"position": [0, 0, 0], "mass": 1}],
        "skin": {"weights": [[0, 1], [0, 1], [0, 1]], "offsets": [0, 0, 1], "triangles": [[0, 1, 2]]}})";
    says(messageOf([&] { parseMolecule(flat, "f"); }), "which has no triangles", "$.skin.offsets[2]");
}

TEST_CASE("a skin follows every affine motion exactly, and so do its normals", "[skin]") {
    double radius = 0;
    const Molecule m = ball(radius);
    const std::vector<SkinFrame> frames = skinFrames(m);
    const std::vector<glm::dvec3> normals = skinNormals(m.skin);
    const glm::dmat3 shear(1.2, 0.3, -0.1, 0.2, 0.9, 0.4, -0.5, 0.1, 1.1);
    const glm::dvec3 shift(3, -2, 1);
    std::vector<glm::dvec3> moved;
    for (const Vertex& vertex : m.vertices)
        moved.push_back(shear * vertex.position + shift);
    const std::vector<glm::dvec3> skin = skinPositions(m, moved);
    const glm::dmat3 cofactor = glm::transpose(glm::inverse(shear)) * glm::determinant(shear);
    for (size_t i = 0; i < skin.size(); ++i) {
        const SkinVertex& vertex = m.skin.vertices[i];
        CHECK(vertex.weights.size() <= size_t(Skin::mostWeights));
        CHECK(vertex.offset == 0);
        CHECK(glm::length(vertex.position) == Approx(radius).epsilon(1e-5));
        CHECK(glm::distance(skin[i], shear * vertex.position + shift) < 1e-6);
        glm::dvec3 along(0), across(0);
        for (size_t k = 0; k < vertex.weights.size(); ++k) {
            along += frames[i].along[k] * moved[size_t(vertex.weights[k].vertex)];
            across += frames[i].across[k] * moved[size_t(vertex.weights[k].vertex)];
        }
        CHECK(glm::distance(glm::normalize(glm::cross(along, across)),
                            glm::normalize(cofactor * normals[i])) < 1e-5);
    }
}

TEST_CASE("a skin stays in place when its molecule gets other vertices", "[skin]") {
    double radius = 0;
    Molecule m = ball(radius);
    const Skin before = m.skin;
    m.vertices.erase(m.vertices.begin() + 3);
    rebindSkin(m);
    REQUIRE(m.skin.vertices.size() == before.vertices.size());
    for (size_t i = 0; i < before.vertices.size(); ++i) {
        CHECK(glm::distance(m.skin.vertices[i].position, before.vertices[i].position) < 1e-5);
        for (const SkinWeight& weight : m.skin.vertices[i].weights)
            CHECK(size_t(weight.vertex) < m.vertices.size());
    }
}

TEST_CASE("where vertices lie in a plane, a skin keeps its distance along the normal", "[skin]") {
    Molecule m;
    for (int i = 0; i < 9; ++i)
        m.vertices.push_back({.position = {i % 3, i / 3, 0}, .mass = 1});
    for (const int a : {0, 1, 3, 4}) {
        m.triangles.push_back({a, a + 1, a + 4});
        m.triangles.push_back({a, a + 4, a + 3});
    }
    SkinMesh mesh;
    mesh.positions = {{0.2, 0.3, 0.1}, {1.7, 0.4, 0.2}, {0.9, 1.8, -0.1}};
    mesh.uvs.resize(3);
    mesh.triangles = {{0, 1, 2}};
    m.skin = bindSkin(m, mesh);
    for (size_t i = 0; i < 3; ++i) {
        CHECK(glm::distance(m.skin.vertices[i].position, mesh.positions[i]) < 1e-6);
        CHECK(m.skin.vertices[i].offset == Approx(mesh.positions[i].z));
    }
    // turned about y by a right angle: what was above lies along x
    std::vector<glm::dvec3> turned;
    for (const Vertex& vertex : m.vertices)
        turned.emplace_back(0, vertex.position.y, -vertex.position.x);
    const std::vector<glm::dvec3> skin = skinPositions(m, turned);
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 p = mesh.positions[i];
        CHECK(glm::distance(skin[i], glm::dvec3(p.z, p.y, -p.x)) < 1e-6);
    }
}

TEST_CASE("a skin hangs on far vertices where the near ones lie in a plane or close together", "[skin]") {
    const auto boundAt = [](const Molecule& molecule, const glm::dvec3& point) {
        SkinMesh mesh;
        mesh.positions = {point, point + glm::dvec3(0.01, 0, 0), point + glm::dvec3(0, 0.01, 0)};
        mesh.uvs.assign(3, glm::dvec2(0));
        mesh.triangles = {{0, 1, 2}};
        Molecule out = molecule;
        out.skin = bindSkin(molecule, mesh);
        CHECK(glm::distance(out.skin.vertices[0].position, point) < 1e-6 * molecule.size());
        for (const SkinWeight& weight : out.skin.vertices[0].weights)
            CHECK(std::abs(weight.weight) < 3.5);
        return out;
    };
    Molecule rod;  // nine vertices in its foot, four in its head, and normals that lean outwards
    for (const double y : {-1.0, 0.0, 1.0})
        for (const double x : {-1.0, 0.0, 1.0})
            rod.vertices.push_back({.position = {x, y, 0}, .mass = 1});
    for (const double y : {-1.0, 1.0})
        for (const double x : {-1.0, 1.0})
            rod.vertices.push_back({.position = {x, y, 9}, .mass = 1});
    rod.triangles = {{0, 2, 9}, {2, 8, 10}, {8, 6, 11}, {6, 0, 12}, {9, 10, 12}, {9, 12, 11}, {0, 1, 3}};
    for (const double z : {0.5, 2.0, 4.0})
        CHECK(boundAt(rod, {1, 0.3, z}).skin.vertices[0].offset == 0);

    Molecule parts;  // a small cluster, and three vertices that lie far from it
    Random random(3);
    for (int i = 0; i < 12; ++i)
        parts.vertices.push_back({.position = 0.1 * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1),
                                                               random.uniform(-1, 1)),
                                  .mass = 1});
    for (const glm::dvec3& far : {glm::dvec3(9, 0, 0), {9, 4, 0}, {9, 0, 4}})
        parts.vertices.push_back({.position = far, .mass = 1});
    boundAt(parts, {3, 0.5, 0.5});
    boundAt(parts, {1, 0, 0.2});
}

TEST_CASE("vertices of a skin in one place share a normal unless they form an edge", "[skin]") {
    Skin skin;
    const auto add = [&](const glm::dvec3& p) {
        skin.vertices.push_back({.position = p, .uv = {}, .weights = {{0, 1}}, .offset = 0});
    };
    // a ridge: two squares that meet at x = 0 with vertices of their own
    const auto ridge = [&](double slope) {
        skin = {};
        for (const double x : {-1.0, 0.0, 0.0, 1.0})
            for (const double y : {0.0, 1.0})
                add({x, y, -slope * std::abs(x)});
        skin.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 6, 7}, {4, 7, 5}};
        return skinNormals(skin);
    };
    std::vector<glm::dvec3> normals = ridge(0.2);
    CHECK(glm::distance(normals[2], glm::dvec3(0, 0, 1)) < 1e-9);
    CHECK(glm::distance(normals[4], glm::dvec3(0, 0, 1)) < 1e-9);
    normals = ridge(1);
    CHECK(glm::distance(normals[2], glm::normalize(glm::dvec3(-1, 0, 1))) < 1e-9);
    CHECK(glm::distance(normals[4], glm::normalize(glm::dvec3(1, 0, 1))) < 1e-9);
}
