// Scenes of points that are born and die, made in code.
#pragma once

#include <vector>

#include "gl/numerics.h"

namespace shoal::test {

// Birth and death need the fused path.
inline bool canSpawn() {
    return testPath() != Path::pingPong;
}

// One group of points without anything else, none of them at the start.
inline Scene emitting(const Emitter& emitter, int capacity,
                      const glm::dvec2& life = glm::dvec2(longestLife)) {
    Scene scene = sceneOf(point(1), SolverKind::leapfrog, {});
    Group& group = scene.groups[0];
    group.count = 0;
    Lifecycle& cycle = group.life.emplace();
    cycle.capacity = capacity;
    cycle.life = life;
    cycle.emitters.push_back(emitter);
    return scene;
}

inline Emitter steady(double rate) {
    Emitter emitter;
    emitter.rate = rate;
    return emitter;
}

inline Emitter burst(int count, double time = 0) {
    Emitter emitter;
    emitter.bursts.push_back({time, count, 0});
    return emitter;
}

// Emits at each death in a group.
inline Emitter fromDeaths(const std::string& group, int each, double inherit) {
    Emitter emitter;
    emitter.from = Emitter::From::death;
    emitter.group = group;
    emitter.perDeath = each;
    emitter.inherit = inherit;
    return emitter;
}

inline Scene flowing(Allocator allocator, double rate, const glm::dvec2& life, int capacity) {
    Emitter emitter = steady(rate);
    emitter.speed = {1, 2};
    emitter.spread = 0.5;
    Scene scene = emitting(emitter, capacity, life);
    scene.groups[0].life->allocator = allocator;
    return scene;
}

// A living member of a group of points, in world coordinates.
struct Living {
    size_t place = 0;
    glm::dvec3 position{0}, velocity{0};
    double age = 0, span = 0;  // s
};

inline std::vector<Living> livingOf(const GroupState& state) {
    std::vector<Living> out;
    for (size_t i = 0; i < state.lives.size(); ++i)
        if (state.lives[i].x < state.lives[i].y)
            out.push_back({i, glm::dvec3(state.anchors[i]) + glm::dvec3(state.positions[i]),
                           glm::dvec3(state.velocities[i]), double(state.lives[i].x),
                           double(state.lives[i].y)});
    return out;
}

inline std::vector<Living> livingOf(const Simulation& simulation, size_t group = 0) {
    return livingOf(simulation.save().groups[group]);
}

}  // namespace shoal::test
