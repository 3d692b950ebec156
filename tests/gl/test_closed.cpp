// Spheres that close a molecule: limp sheets that meet with their edges do not pass through one another.
#include <set>

#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;
using glm::dvec3;

namespace {

constexpr int pairs = 16;

// Springs along its edges alone, so that it folds at each of them.
Molecule limpSheet() {
    Molecule out = sheet(3, 3, false);
    std::set<std::pair<int, int>> edges;
    for (const Triangle& t : out.triangles)
        for (const auto& [a, b] : {std::minmax(t.a, t.b), std::minmax(t.b, t.c), std::minmax(t.c, t.a)})
            edges.emplace(a, b);
    std::erase_if(out.springs,
                  [&](const Spring& spring) { return !edges.count(std::minmax(spring.a, spring.b)); });
    for (Spring& spring : out.springs)
        spring.actuation.reset();
    for (Vertex& vertex : out.vertices)
        vertex.position = {vertex.position.x - 0.5, 0, vertex.position.z - 0.5};
    return out;
}

// Lying sheets fly at upright ones, edge on edge, at 5 m/s, each pair from elsewhere.
Scene sheetsThatMeet(bool closed) {
    const glm::dquat upright = glm::angleAxis(glm::radians(90.0), dvec3(0, 0, 1));
    std::vector<Item> here, there;
    for (int m = 0; m < pairs; ++m) {
        const dvec3 middle(4 * (m % 4), 4 * (m / 4), 0);
        here.push_back(at(middle));
        there.push_back(at(middle + dvec3(0.03 * m - 0.24, 0.4 - 0.05 * m, 1.1 + 0.0013 * m), upright));
    }
    Scene scene = sceneOf(limpSheet(), SolverKind::leapfrog, here);
    scene.groups.push_back(sceneOf(limpSheet(), SolverKind::leapfrog, there).groups[0]);
    for (size_t g = 0; g < 2; ++g) {
        Group& group = scene.groups[g];
        group.name = g == 0 ? "lying" : "upright";
        group.velocity = {0, 0, g == 0 ? 2.5 : -2.5};
        group.restitution = 0;
        group.contact.emplace().radius = 0.06;
        group.contact->triangles = true;
        group.contact->closed = closed;
    }
    scene.gravity = {};
    scene.contact.fastest = 5;
    setSteps(scene, 1 / 60.0, 4);
    return scene;
}

// Whether the line from p to q crosses the triangle.
bool crosses(const dvec3& p, const dvec3& q, const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 normal = glm::cross(b - a, c - a);
    const double before = glm::dot(p - a, normal), behind = glm::dot(q - a, normal);
    if ((before > 0) == (behind > 0)) return false;
    const dvec3 x = p + (q - p) * (before / (before - behind));
    const auto side = [&](const dvec3& s, const dvec3& e) {
        return glm::dot(glm::cross(e - s, x - s), normal) > 0;
    };
    return side(a, b) && side(b, c) && side(c, a);
}

// How many pairs have an edge of one in a triangle of the other.
int crossed(const std::vector<dvec3>& here, const std::vector<dvec3>& there) {
    const Molecule molecule = limpSheet();
    const size_t vertices = molecule.vertices.size();
    int out = 0;
    for (size_t m = 0; m < pairs; ++m) {
        bool any = false;
        const auto look = [&](const std::vector<dvec3>& edges, const std::vector<dvec3>& triangles) {
            const auto of = [&](const std::vector<dvec3>& all, int v) {
                return all[m * vertices + size_t(v)];
            };
            for (const Spring& spring : molecule.springs)
                for (const Triangle& t : molecule.triangles)
                    any |= crosses(of(edges, spring.a), of(edges, spring.b), of(triangles, t.a),
                                   of(triangles, t.b), of(triangles, t.c));
        };
        look(here, there);
        look(there, here);
        out += any;
    }
    return out;
}

}  // namespace

TEST_CASE("limp sheets that are closed do not cross where they meet at 5 m/s", "[molecule contact]") {
    const Path path = GENERATE(Path::fused, Path::fragments);
    if (path == Path::fused && !testContext().info().computeShaders) return;
    const bool closed = GENERATE(false, true);
    if (path == Path::fragments && !closed) return;  // what the test would see otherwise, once
    const Scene scene = sheetsThatMeet(closed);
    Simulation simulation(testContext(), compile(scene), {.drawn = false, .path = path});
    int most = 0;
    for (int frame = 0; frame < 30; ++frame) {
        run(simulation, 1);
        most = std::max(most, crossed(simulation.snapshot(0).positions, simulation.snapshot(1).positions));
    }
    CAPTURE(name(path), closed, most);
    if (closed)
        CHECK(most == 0);
    else
        CHECK(most > 0);
}
