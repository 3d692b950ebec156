#include "bench/baseline_scalar.h"

#include <algorithm>
#include <cmath>

namespace shoal::bench {

using glm::vec3;

namespace {

vec3 springForce(const ScalarVertex& a, const ScalarVertex& b, const ScalarSpring& spring) {
    const vec3 d = a.position - b.position;
    const float squared = glm::dot(d, d);
    if (squared < 1e-24f) return vec3(0);
    const float inverse = 1 / std::sqrt(squared);
    const vec3 n = d * inverse;
    const float stretch = squared * inverse - spring.restLength;
    return n * -(spring.stiffness * stretch + spring.damping * glm::dot(n, a.velocity - b.velocity));
}

// shaders/physics/collide.glsl with euler's drift: step h, kickDrift h, lag h/2.
void respond(ScalarVertex& vertex, float distance, const BaselineStep& step) {
    vec3& x = vertex.position;
    vec3& v = vertex.velocity;
    const vec3 n = step.planeNormal;
    const float depth = -distance, vn = glm::dot(v, n);
    const vec3 surface = x + n * depth;
    if (vn >= 0) {
        x = surface;
        return;
    }
    const float gn = glm::dot(step.gravity, n), lag = 0.5f * step.h;
    const float synchronised = vn + gn * lag;
    const float impact = std::sqrt(std::max(synchronised * synchronised + 2 * gn * depth, 0.0f));
    const float since = std::min(depth / std::max(0.5f * (impact - synchronised), 1e-20f), step.h);
    const float rebound = step.restitution * impact;
    const bool bounces = rebound > 0.5f * std::abs(gn) * step.h && rebound + 0.5f * gn * since > 0;
    const float newNormal = bounces ? rebound + gn * (since - lag) : 0;
    const float height = bounces ? (rebound + 0.5f * gn * since) * since : 0;
    const float frictionTime = bounces ? since : step.h;

    const vec3 tangential = v - n * vn;
    const float speed = std::sqrt(glm::dot(tangential, tangential));
    const float normalChange = bounces ? rebound + impact : -vn;
    const float lost = std::min(step.friction * normalChange, speed);
    const float started = distance - vn * step.h;
    const float slack = std::min(1e-6f, -0.02f * vn * step.h);
    if (!bounces && lost >= speed && std::abs(started) < slack) {
        x -= v * step.h;
        v = vec3(0);
        return;
    }
    const vec3 lostVelocity = speed > 0 ? tangential * (lost / speed) : vec3(0);
    x = surface + n * height - lostVelocity * frictionTime;
    v = tangential - lostVelocity + n * newNormal;
}

// shaders/physics/anchor.glsl
void moveAnchor(std::span<ScalarVertex> vertices, vec3& anchor) {
    const vec3 p = vertices[0].position;
    if (std::abs(p.x) <= 1 && std::abs(p.y) <= 1 && std::abs(p.z) <= 1) return;
    const vec3 shift = glm::floor(p * 16.0f + 0.5f) * 0.0625f;
    anchor += shift;
    for (ScalarVertex& vertex : vertices)
        vertex.position -= shift;
}

}  // namespace

void frameScalar(ScalarMolecules& molecules, int first, int last, const BaselineStep& step,
                 std::span<vec3> force) {
    std::vector<ScalarSpring> springs = molecules.springs;
    for (ScalarSpring& spring : springs) {
        spring.stiffness *= step.stiffness;
        spring.damping *= step.damping;
    }
    const size_t count = size_t(molecules.vertexCount);
    for (int m = first; m < last; ++m) {
        const std::span<ScalarVertex> vertices(molecules.vertices.data() + size_t(m) * count, count);
        vec3& anchor = molecules.anchors[size_t(m)];
        moveAnchor(vertices, anchor);
        const float offset = glm::dot(anchor - step.planePoint, step.planeNormal) - step.thickness;
        for (int substep = 0; substep < step.substeps; ++substep) {
            std::fill(force.begin(), force.end(), vec3(0));
            for (const ScalarSpring& spring : springs) {
                const vec3 f = springForce(vertices[size_t(spring.a)], vertices[size_t(spring.b)], spring);
                force[size_t(spring.a)] += f;
                force[size_t(spring.b)] -= f;
            }
            for (size_t i = 0; i < count; ++i) {
                vec3& v = vertices[i].velocity;
                v += force[i] * (molecules.inverseMass[i] * step.h);
                v += (step.wind - v) * step.decay + step.gravity * step.phi;
                vertices[i].position += v * step.h;
                const float distance = glm::dot(vertices[i].position, step.planeNormal) + offset;
                if (distance < 0) respond(vertices[i], distance, step);
            }
        }
    }
}

}  // namespace shoal::bench
