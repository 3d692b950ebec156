// How far sliders go: never to where a scene could not be read again.
#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "scene/edit_limits.h"
#include "support/catch.h"

using namespace shoal;

static Lifecycle bearing() {
    Lifecycle life;
    life.capacity = 500;
    life.life = {1, 2};
    Emitter& emitter = life.emitters.emplace_back();
    emitter.rate = 100;
    emitter.speed = {1, 2};
    return life;
}

TEST_CASE("what a file says is within the limits of its sliders", "[editLimits]") {
    Lifecycle life = bearing();
    Emitter& emitter = life.emitters[0];
    emitter.rate = 1e6;
    emitter.speed = {90, 100};
    emitter.position = {-5000, 3, 4000};
    emitter.radius = 1e-5;
    emitter.inherit = -7;
    emitter.bursts.push_back({500, 1 << 20, 300});
    life.life = {0.001, 900};
    life.scale = {0.01, 60};
    life.capacity = 3000000;
    const LifeLimits limits = limitsOf(life, 20);
    const auto within = [](const Limit& limit, double value) {
        return limit.least <= value && value <= limit.most;
    };
    CHECK(within(limits.rate, emitter.rate));
    CHECK(within(limits.speed, emitter.speed.y));
    for (int i = 0; i < 3; ++i)
        CHECK(within(limits.position, emitter.position[i]));
    CHECK(within(limits.radius, emitter.radius));
    CHECK(within(limits.inherit, emitter.inherit));
    CHECK(within(limits.time, 500));
    CHECK(within(limits.every, 300));
    CHECK(within(limits.count, 1 << 20));
    CHECK(within(limits.life, life.life.x));
    CHECK(within(limits.life, life.life.y));
    CHECK(within(limits.scale, life.scale.y));
    CHECK(within(limits.capacity, life.capacity));
    CHECK(limits.capacity.least == 20);
    // more than the file has, and less; what cannot be 0 is not
    CHECK(limits.rate.least == 0);
    CHECK(limits.rate.most > emitter.rate);
    CHECK(limits.life.least > 0);
    CHECK(limits.radius.least > 0);
    CHECK(limitsOf(bearing(), 0).capacity.least == 1);
}

TEST_CASE("an emitter that never ends leaves its time a finite range", "[editLimits]") {
    const LifeLimits limits = limitsOf(bearing(), 0);
    CHECK(std::isfinite(limits.time.most));
    Lifecycle forEver = bearing();
    forEver.life = glm::dvec2(longestLife);
    CHECK(limitsOf(forEver, 0).life.most < 1e6);
}

TEST_CASE("numbers that depend on one another are settled", "[editLimits]") {
    Lifecycle life = bearing();
    life.emitters[0].begin = 5;
    life.emitters[0].end = 3;
    life.emitters[0].speed = {4, 2};
    life.life = {9, 3};
    life.within = Box{glm::dvec3(2), glm::dvec3(1)};
    life.capacity = 3;
    settle(life, 10);
    CHECK(life.emitters[0].end > 5);
    CHECK(life.emitters[0].speed.x <= life.emitters[0].speed.y);
    CHECK(life.life.x <= life.life.y);
    CHECK(life.within->high.y > life.within->low.y);
    CHECK(life.capacity == 10);
}

TEST_CASE("colour keyframes stay in order however they are dragged", "[editLimits]") {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        std::vector<ColorKey> keys(1);
        for (int i = 0; i < 400; ++i) {
            const double dice = random.uniform();
            const size_t key = size_t(random.uniform() * double(keys.size()));
            if (dice < 0.1)
                addColorKey(keys);
            else if (dice < 0.15 && keys.size() > 1)
                keys.erase(keys.begin() + std::ptrdiff_t(key));
            else if (keys.size() > 1)
                keys[key].age = ageBetween(keys, key, random.uniform(-0.2, 1.2));
            REQUIRE(keys.size() <= mostColorKeys);
            for (size_t k = 0; k < keys.size(); ++k) {
                REQUIRE(keys[k].age >= 0);
                REQUIRE(keys[k].age <= 1);
                if (k > 0) REQUIRE(keys[k].age >= keys[k - 1].age + 0.0099);
            }
        }
    }
}

TEST_CASE("a new colour keyframe changes nothing that is seen", "[editLimits]") {
    std::vector<ColorKey> keys(2);
    keys[0].color = {1, 0, 0};
    keys[1] = {0.8, {0, 1, 0}, 0};
    addColorKey(keys);
    REQUIRE(keys.size() == 3);
    CHECK(keys[1].age == Approx(0.4));
    CHECK(keys[1].color.x == Approx(0.5));
    CHECK(keys[1].opacity == Approx(0.5));
    std::vector<ColorKey> one(1);
    addColorKey(one);
    REQUIRE(one.size() == 2);
    CHECK(one[1].age == 1);
    CHECK(one[1].color == one[0].color);
}

TEST_CASE("looks within the limits of their sliders can be read, and can be seen", "[editLimits]") {
    ParticleType type;
    type.size = {1e-7, 50};
    type.spin = {-100, 3};
    type.turn = {0, 1e6};
    type.mass = 1e12;
    const LooksLimits limits = limitsOf(type);
    CHECK(limits.size.least <= 1e-7);
    CHECK(limits.size.least >= leastParticleSize);
    CHECK(limits.size.most > 50);
    CHECK(limits.spin.least <= -100);
    CHECK(limits.turn.most == mostParticleTurn);
    CHECK(limits.mass.most == mostParticleMass);
    CHECK(limitsOf(ParticleType()).size.least > 0);
    type.growth = glm::dvec2(0);
    type.size = {2, 1};
    type.spin = {1, -1};
    settle(type);
    CHECK(std::max(type.growth.x, type.growth.y) > 0);
    CHECK(type.size.x <= type.size.y);
    CHECK(type.spin.x <= type.spin.y);
}
