#include "measure/report_scenes.h"

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "scene/field_kinds.h"

namespace shoal::measure {

namespace {

using glm::dvec3;

// As the prototype has it, with z up.
dvec3 yUp(double x, double y, double z) {
    return {x, z, -y};
}

class Builder {
  public:
    Builder(const char* name, double stiffness) : stiffness_(stiffness) { out_.name = name; }

    int vertex(const dvec3& position, bool pinned = false) {
        Vertex vertex;
        vertex.position = position;
        vertex.pinned = pinned;
        out_.vertices.push_back(vertex);
        return int(out_.vertices.size()) - 1;
    }
    void spring(int a, int b) {
        Spring spring;
        spring.a = a;
        spring.b = b;
        spring.stiffness = stiffness_;
        spring.damping = 0.05 * std::sqrt(stiffness_);
        out_.springs.push_back(spring);
    }
    Molecule centred() {
        dvec3 middle(0);
        for (const Vertex& vertex : out_.vertices)
            middle += vertex.position / double(out_.vertices.size());
        for (Vertex& vertex : out_.vertices)
            vertex.position -= middle;
        return std::move(out_);
    }

  private:
    Molecule out_;
    double stiffness_;
};

// The linear part of u, from its gradient with z up: rows of u, columns of x.
ShearField shear(const dvec3& velocity, const glm::dmat3& rowsZUp) {
    // u' = P u, x' = P x with P (x, y, z) = (x, z, -y), so that the gradient is P G P^T
    const glm::dmat3 turn(dvec3(1, 0, 0), dvec3(0, 0, -1), dvec3(0, 1, 0));  // columns: P of each axis
    ShearField out;
    out.velocity = turn * velocity;
    out.gradient = turn * glm::transpose(rowsZUp) * glm::transpose(turn);
    return out;
}

void add(Scene& scene, FieldShape shape) {
    scene.fields.emplace_back().shape = std::move(shape);
}

void oscillate(Scene& scene, const dvec3& velocity, double frequency, double phase) {
    OscillatingField out;
    out.velocity = velocity;
    out.frequency = frequency;
    out.phase = phase;
    add(scene, out);
}

void placeAt(Group& group, const dvec3& position) {
    group.place.kind = Placement::Kind::list;
    group.place.turn = Placement::Turn::none;
    Random random(1);
    for (int i = 0; i < group.count; ++i) {
        Placement::Item item;
        item.position = position;
        item.rotation = glm::angleAxis(0.7, glm::normalize(yUp(1, 2, 3)));
        if (i > 0)
            item.rotation = glm::angleAxis(random.uniform(0, 2 * std::numbers::pi), random.direction());
        group.place.items.push_back(item);
    }
}

void fall(Scene& scene) {
    scene.gravity = {0, -9.81, 0};
    Group& group = scene.groups[0];
    group.drag = {1, 1};
    group.velocity = yUp(0.5, 0, 0);
    group.spin = yUp(0.6, -0.9, 0.4);
    // u = (2 + 0.8 z, 0.5 x, 0.3 y)
    add(scene, shear({2, 0, 0}, {{0, 0, 0.8}, {0.5, 0, 0}, {0, 0.3, 0}}));
}

void gusts(Scene& scene) {
    scene.gravity = {0, -9.81, 0};
    Group& group = scene.groups[0];
    group.drag = {2, 2};
    group.held = true;
    // u = (4 + 2 sin 6 pi t + 0.5 z, 2 cos 2.6 pi t + 1.2 sin(14.6 pi t + 1) + 0.3 x, sin 10.2 pi t)
    add(scene, shear({4, 0, 0}, {{0, 0, 0.5}, {0.3, 0, 0}, {0, 0, 0}}));
    oscillate(scene, yUp(2, 0, 0), 3, 0);
    oscillate(scene, yUp(0, 2, 0), 1.3, std::numbers::pi / 2);
    oscillate(scene, yUp(0, 1.2, 0), 7.3, 1);
    oscillate(scene, yUp(0, 0, 1), 5.1, 0);
}

void spin(Scene& scene) {
    scene.groups[0].spin = yUp(12, 10, 12.5);
}

void impact(Scene& scene) {
    scene.gravity = {0, -9.81, 0};
    scene.groups[0].velocity = yUp(0.3, 0, -3);
    Collider& plane = scene.colliders.emplace_back();
    plane.restitution = 0.5;
    plane.friction = 0.3;
}

Molecule moleculeOf(const std::string& name, double stiffness) {
    if (name == "leaf") return foldedLeaf(stiffness);
    return name == "cross" ? bracedCross(stiffness) : slenderFish(stiffness);
}

Scene sceneOf(const std::string& molecule, const std::string& motion, double stiffness, int count) {
    Scene scene;
    scene.name = concat(molecule, ", ", motion, ", k = 1e", std::lround(std::log10(stiffness)));
    scene.frameRate = reportFrameRate;
    Group& group = scene.groups.emplace_back();
    group.name = molecule;
    group.molecule = moleculeOf(molecule, stiffness);
    group.count = count;
    group.held = false;
    placeAt(group, motion == "impact" ? yUp(0, 0, 2.2) : dvec3(0));
    if (motion == "fall") fall(scene);
    if (motion == "gusts") gusts(scene);
    if (motion == "spin") spin(scene);
    if (motion == "impact") impact(scene);
    return scene;
}

// Time for one impact and its rebound; a second one would make the motion chaotic.
double durationOf(const std::string& motion) {
    return motion == "impact" ? 0.4 : 1;
}

}  // namespace

Molecule foldedLeaf(double stiffness) {
    Builder out("leaf", stiffness);
    constexpr double x[] = {-0.5, 0.5, 0.5, -0.5}, y[] = {0, 0, 1, 1}, z[] = {0.12, -0.12, 0.12, -0.12};
    for (int i = 0; i < 4; ++i)
        out.vertex(yUp(x[i], y[i], z[i]), i < 2);
    for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b)
            out.spring(a, b);
    Molecule leaf = out.centred();
    leaf.triangles = {{0, 1, 2}, {0, 2, 3}};
    return leaf;
}

Molecule bracedCross(double stiffness) {
    Builder out("cross", stiffness);
    for (int layer = 0; layer < 2; ++layer) {
        out.vertex(yUp(0, 0, layer), true);
        for (const glm::dvec2 arm : {glm::dvec2(0.5, 0), {0, 0.5}, {-0.5, 0}, {0, -0.5}})
            out.vertex(yUp(arm.x, arm.y, layer));
    }
    constexpr int above = 5;
    out.spring(0, above);
    for (int arm = 1; arm <= 4; ++arm) {
        const int next = arm % 4 + 1;
        for (const int layer : {0, above}) {
            out.spring(layer, layer + arm);
            out.spring(layer + arm, layer + next);
        }
        out.spring(arm, above + arm);
        out.spring(0, above + arm);
        out.spring(arm, above);
    }
    return out.centred();
}

Molecule slenderFish(double stiffness) {
    Builder out("fish", stiffness);
    constexpr double rx[] = {0.08, 0.16, 0.2, 0.16, 0.08, 0.05}, rz[] = {0.12, 0.28, 0.35, 0.28, 0.16, 0.3};
    constexpr int rings = 6;
    for (int ring = 0; ring < rings; ++ring) {
        const double y = 0.4 * ring;
        out.vertex(yUp(rx[ring], y, 0), ring == 0);
        out.vertex(yUp(0, y, rz[ring]));
        out.vertex(yUp(-rx[ring], y, 0), ring == 0);
        out.vertex(yUp(0, y, -rz[ring]));
    }
    for (int first = 0; first < 4 * rings; first += 4) {
        for (int i = 0; i < 4; ++i)
            out.spring(first + i, first + (i + 1) % 4);
        out.spring(first, first + 2);
        out.spring(first + 1, first + 3);
        if (first == 0) continue;
        for (int i = 0; i < 4; ++i)
            for (const int turn : {0, 1, 3})
                out.spring(first - 4 + i, first + (i + turn) % 4);
    }
    return out.centred();
}

std::vector<ReportScene> reportScenes(int count) {
    std::vector<ReportScene> out;
    for (const std::string molecule : reportMolecules) {
        for (const std::string motion : reportMotions) {
            for (const double k : reportStiffnesses) {
                ReportScene& scene = out.emplace_back();
                scene.id = concat(molecule, "-", motion, "-1e", int(std::lround(std::log10(k))));
                scene.molecule = molecule;
                scene.motion = motion;
                scene.stiffness = k;
                scene.duration = durationOf(motion);
                scene.scene = sceneOf(molecule, motion, k, count);
            }
        }
    }
    return out;
}

}  // namespace shoal::measure
