#include "simulate/pick.h"

#include <cmath>
#include <limits>

namespace shoal {

namespace {

constexpr double missed = std::numeric_limits<double>::infinity();

// [Moeller 1997]; from both sides.
double meets(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(ray.along, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) return missed;
    const glm::dvec3 from = ray.from - a, q = glm::cross(from, ab);
    const double u = glm::dot(from, p) / determinant, v = glm::dot(ray.along, q) / determinant;
    const double distance = glm::dot(ac, q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : missed;
}

double meetsPoint(const Ray& ray, const glm::dvec3& point, double radius, double angle) {
    const glm::dvec3 to = point - ray.from;
    const double distance = glm::dot(to, ray.along);
    if (!(distance > 0)) return missed;
    const double off = glm::length(to - distance * ray.along);
    return off <= std::max(radius, distance * std::tan(angle)) ? distance : missed;
}

}  // namespace

std::optional<RayHit> firstHit(const Ray& ray, const Snapshot& state, const Molecule& shape, double radius,
                               double angle) {
    RayHit surface{-1, missed}, vertex{-1, missed};
    const auto keep = [](RayHit& best, int molecule, double distance) {
        if (distance < best.distance) best = {molecule, distance};
    };
    for (int m = 0; m < state.count; ++m) {
        if (!state.alive.empty() && !state.alive[size_t(m)]) continue;
        const glm::dvec3* positions = state.positions.data() + size_t(m) * size_t(state.vertexCount);
        for (const Triangle& t : shape.triangles)
            keep(surface, m, meets(ray, positions[t.a], positions[t.b], positions[t.c]));
        for (int v = 0; v < state.vertexCount; ++v)
            keep(vertex, m, meetsPoint(ray, positions[v], radius, angle));
    }
    if (surface.molecule >= 0) return surface;
    if (vertex.molecule >= 0) return vertex;
    return {};
}

MoleculeNumbers numbersOf(const GroupState& state, const Molecule& shape, double stiffness) {
    MoleculeNumbers out;
    double mass = 0;
    const glm::dvec3 anchor(state.anchors.front());
    for (size_t v = 0; v < shape.vertices.size(); ++v) {
        const double m = shape.vertices[v].mass;
        const glm::dvec3 velocity(state.velocities[v]);
        mass += m;
        out.middle += m * (anchor + glm::dvec3(state.positions[v]));
        out.velocity += m * velocity;
        out.kinetic += 0.5 * m * glm::dot(velocity, velocity);
    }
    out.middle /= mass;
    out.velocity /= mass;
    out.scale = state.looks.empty() ? 1 : double(state.looks.front().x);
    for (size_t s = 0; s < shape.springs.size(); ++s) {
        const Spring& spring = shape.springs[s];
        const double rest = out.scale * shape.restLength(spring);
        const double length = glm::distance(glm::dvec3(state.positions[size_t(spring.a)]),
                                            glm::dvec3(state.positions[size_t(spring.b)]));
        out.elastic += 0.5 * stiffness * spring.stiffness * (length - rest) * (length - rest);
        const double strain = rest > 0 ? (length - rest) / rest : 0;
        if (out.strained >= 0 && std::abs(strain) <= std::abs(out.strain)) continue;
        out.strain = strain;
        out.strained = int(s);
    }
    if (!state.lives.empty()) {
        out.life = glm::dvec2(state.lives.front());
        out.alive = out.life->x < out.life->y;
    }
    out.released = !state.released.empty() && state.released.front() != 0;
    return out;
}

}  // namespace shoal
