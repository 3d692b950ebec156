#include "gl/marbles.h"

#include <algorithm>
#include <cmath>

namespace shoal::test {

Simulation simulationOn(Path path, Plan plan, bool drawn) {
    return Simulation(testContext(), std::move(plan), {.drawn = drawn, .path = path});
}

Scene marbles(const std::vector<glm::dvec3>& positions, double radius, double mass) {
    std::vector<Item> items;
    for (const glm::dvec3& p : positions)
        items.push_back(at(p));
    Scene scene = sceneOf(point(mass), SolverKind::leapfrog, items);
    scene.groups[0].contact.emplace().radius = radius;
    setSteps(scene, 0.01, 1);
    return scene;
}

Simulation startedWith(const Scene& scene, const std::vector<glm::dvec3>& velocities, glm::vec2 material,
                       Path path) {
    Plan plan = compile(scene);
    for (glm::vec2& pair : plan.contact.pairs)
        pair = material;
    size_t next = 0;
    for (GroupPlan& group : plan.groups)
        for (glm::vec3& v : group.start.velocities)
            v = glm::vec3(velocities[next++]);
    return simulationOn(path, std::move(plan));
}

void Clusters::add(size_t mass, const glm::dvec3& place, const glm::dvec3& velocity, size_t cluster) {
    places_[mass].push_back(place);
    velocities_[mass].push_back(velocity);
    owners_[mass].push_back(cluster);
}

Scene Clusters::scene(double radius, double factor) const {
    Scene out;
    for (size_t mass = 0; mass < places_.size(); ++mass) {
        Scene part = marbles(places_[mass], radius, std::pow(factor, double(mass)));
        part.groups[0].name = concat("mass ", mass);
        if (mass == 0)
            out = part;
        else
            out.groups.push_back(part.groups[0]);
    }
    return out;
}

template <typename T>
static std::vector<T> joined(const std::vector<std::vector<T>>& parts) {
    std::vector<T> out;
    for (const std::vector<T>& part : parts)
        out.insert(out.end(), part.begin(), part.end());
    return out;
}

std::vector<glm::dvec3> Clusters::velocities() const {
    return joined(velocities_);
}

std::vector<size_t> Clusters::owners() const {
    return joined(owners_);
}

std::vector<reference::Sphere> spheresOf(const Plan& plan) {
    std::vector<reference::Sphere> out;
    int molecules = 0;
    for (const ContactGroup& contact : plan.contact.groups) {
        const GroupPlan& group = plan.groups[contact.group];
        for (int m = 0; m < group.count; ++m) {
            const size_t first = size_t(m) * size_t(group.vertexCount);
            const auto vertex = [&](int v) {
                reference::Sphere sphere;
                sphere.position = glm::dvec3(group.start.anchors[size_t(m)]) +
                                  glm::dvec3(group.start.positions[first + size_t(v)]);
                sphere.velocity = glm::dvec3(group.start.velocities[first + size_t(v)]);
                sphere.radius = contact.radius * double(group.constants.scales[size_t(m)]);
                sphere.weight = contact.shapes[size_t(v)].y > 0 ? 0 : double(contact.shapes[size_t(v)].x);
                sphere.molecule = molecules + m;
                return sphere;
            };
            for (int v = 0; v < group.vertexCount; ++v)
                out.push_back(vertex(v));
            for (const auto& [corners, parts] : contact.points) {
                reference::Sphere between = vertex(corners.x);
                between.position = glm::dvec3(0);
                for (int c = 0; c < 3; ++c)
                    between.position += vertex(corners[c]).position * double(parts[c]);
                between.position /= double(parts.x + parts.y + parts.z);
                out.push_back(between);
            }
        }
        molecules += group.count;
    }
    return out;
}

Pairs missing(const Pairs& all, const Pairs& some) {
    Pairs out;
    std::set_difference(some.begin(), some.end(), all.begin(), all.end(), std::back_inserter(out));
    return out;
}

Scene strewn(int count, const glm::dvec3& size, double radius, glm::dvec2 scale) {
    Scene scene = sceneOf(shippedMolecule("quad"), SolverKind::leapfrog);
    Group& group = scene.groups[0];
    group.count = count;
    group.place.kind = Placement::Kind::volume;
    group.place.items.clear();
    group.place.turn = Placement::Turn::any;
    group.place.box = {glm::dvec3(0), size};
    group.place.scale = scale;
    group.contact.emplace().radius = radius;
    setSteps(scene, 1e-5, 1);
    return scene;
}

std::vector<reference::Sphere> statesOf(const Simulation& simulation) {
    std::vector<reference::Sphere> out;
    int molecules = 0;
    for (size_t g = 0; g < simulation.plan().groups.size(); ++g) {
        const Snapshot snapshot = simulation.snapshot(g);
        const size_t vertices = size_t(simulation.plan().groups[g].vertexCount);
        for (size_t i = 0; i < snapshot.positions.size(); ++i) {
            reference::Sphere sphere;
            sphere.position = snapshot.positions[i];
            sphere.velocity = snapshot.velocities[i];
            sphere.weight = double(simulation.plan().contact.groups[g].shapes[i % vertices].x);
            sphere.molecule = molecules + int(i / vertices);
            out.push_back(sphere);
        }
        molecules += int(snapshot.positions.size() / vertices);
    }
    return out;
}

glm::dvec3 momentum(const std::vector<reference::Sphere>& spheres) {
    glm::dvec3 sum(0);
    for (const reference::Sphere& sphere : spheres)
        sum += sphere.velocity / sphere.weight;
    return sum;
}

Molecule tetrahedron(double edge, double mass) {
    Molecule out;
    out.name = "tetrahedron";
    for (const glm::dvec3& corner :
         {glm::dvec3(1, 1, 1), glm::dvec3(1, -1, -1), glm::dvec3(-1, 1, -1), glm::dvec3(-1, -1, 1)})
        out.vertices.push_back({.position = corner * (edge / std::sqrt(8.0)), .mass = mass / 4});
    for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b)
            out.springs.push_back({a, b, 1e6 * mass, 0, {}, {}});
    return out;
}

Body::Body(std::span<const reference::Sphere> spheres) : velocity(spheres.front().velocity) {
    double mass = 0;
    for (const reference::Sphere& sphere : spheres) {
        mass += 1 / sphere.weight;
        center += sphere.position / sphere.weight;
    }
    perMass = 1 / mass;
    center /= mass;
    glm::dmat3 inertia(0);
    for (const reference::Sphere& sphere : spheres) {
        const glm::dvec3 arm = sphere.position - center;
        inertia += (glm::dmat3(glm::dot(arm, arm)) - glm::outerProduct(arm, arm)) / sphere.weight;
    }
    if (spheres.size() > 1) perInertia = glm::inverse(inertia);
}

}  // namespace shoal::test
