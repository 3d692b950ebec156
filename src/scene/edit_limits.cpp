#include "scene/edit_limits.h"

#include <algorithm>
#include <cmath>

#include "scene/json/scene_file.h"

namespace shoal {

namespace {

constexpr double leastAgeGap = 0.01;

// Room around what the file says.
void hold(Limit& limit, double value) {
    if (!std::isfinite(value)) return;
    limit.least = std::min(limit.least, value);
    limit.most = std::max(limit.most, 4 * value);
}

void hold(Limit& limit, const glm::dvec3& value) {
    for (int i = 0; i < 3; ++i) {
        limit.least = std::min(limit.least, 4 * value[i]);
        limit.most = std::max(limit.most, 4 * value[i]);
    }
}

void hold(Limit& limit, const glm::dvec2& span) {
    hold(limit, span.x);
    hold(limit, span.y);
}

void hold(LifeLimits& limits, const Emitter& emitter) {
    hold(limits.rate, emitter.rate);
    hold(limits.time, emitter.begin);
    hold(limits.time, emitter.end);
    hold(limits.perDeath, emitter.perDeath);
    hold(limits.radius, emitter.radius > 0 ? emitter.radius : limits.radius.most / 4);
    hold(limits.speed, emitter.speed);
    hold(limits.inherit, emitter.inherit);
    for (const glm::dvec3& place :
         {emitter.position, emitter.lineFrom, emitter.lineTo, emitter.box.low, emitter.box.high})
        hold(limits.position, place);
    for (const Burst& burst : emitter.bursts) {
        hold(limits.time, burst.time);
        hold(limits.every, burst.every);
        hold(limits.count, burst.count);
    }
}

void order(glm::dvec2& span) {
    if (span.x > span.y) span.x = span.y;
}

}  // namespace

LifeLimits limitsOf(const Lifecycle& life, int count) {
    LifeLimits out;
    for (const Emitter& emitter : life.emitters)
        hold(out, emitter);
    if (life.life.y < longestLife) hold(out.life, life.life);
    if (life.afterContact) hold(out.afterContact, *life.afterContact);
    if (life.within) {
        hold(out.position, life.within->low);
        hold(out.position, life.within->high);
    }
    hold(out.scale, life.scale);
    hold(out.grow, life.grow);
    hold(out.grow, life.shrink);
    hold(out.spin, life.spin);
    hold(out.capacity, life.capacity);
    out.capacity = {double(std::max(1, count)), std::min(out.capacity.most, double(maxGroupCount))};
    out.count.most = std::min(out.count.most, double(maxGroupCount));
    out.perDeath.most = std::min(out.perDeath.most, 1024.0);
    return out;
}

LooksLimits limitsOf(const ParticleType& type) {
    LooksLimits out;
    hold(out.mass, type.mass);
    hold(out.size, type.size);
    hold(out.growth, type.growth);
    for (const double turn : {type.turn.x, type.turn.y})
        hold(out.turn, std::abs(turn));
    for (const double spin : {type.spin.x, type.spin.y})
        hold(out.spin, std::abs(spin));
    hold(out.stretch, type.stretch);
    hold(out.softness, type.softness);
    if (type.image) hold(out.frameRate, type.image->frameRate);
    hold(out.spreadFrames, type.spreadFrames);
    out.mass.most = std::min(out.mass.most, mostParticleMass);
    out.size.most = std::min(out.size.most, mostParticleSize);
    for (Limit* limit : {&out.turn, &out.spin}) {
        limit->most = std::min(limit->most, mostParticleTurn);
        limit->least = -limit->most;
    }
    out.frameRate.most = std::min(out.frameRate.most, mostFrameRate);
    out.spreadFrames.most = std::min(out.spreadFrames.most, double(mostSpreadFrames));
    return out;
}

void settle(ParticleType& type) {
    order(type.size);
    order(type.turn);
    order(type.spin);
    if (type.growth == glm::dvec2(0)) type.growth.x = 0.01;
}

void settle(Lifecycle& life, int count) {
    for (Emitter& emitter : life.emitters) {
        emitter.end = std::max(emitter.end, emitter.begin + 0.01);
        order(emitter.speed);
        emitter.box.high = glm::max(emitter.box.high, emitter.box.low);
    }
    order(life.life);
    order(life.scale);
    if (life.within) life.within->high = glm::max(life.within->high, life.within->low + 0.01);
    life.capacity = std::max(life.capacity, std::max(1, count));
}

double ageBetween(const std::vector<ColorKey>& keys, size_t key, double age) {
    const double least = key == 0 ? 0 : keys[key - 1].age + leastAgeGap;
    const double most = key + 1 == keys.size() ? 1 : keys[key + 1].age - leastAgeGap;
    return least < most ? std::clamp(age, least, most) : keys[key].age;
}

void addColorKey(std::vector<ColorKey>& keys) {
    if (keys.size() >= mostColorKeys) return;
    if (keys.back().age < 1 - leastAgeGap && keys.size() == 1) {
        ColorKey last = keys.back();
        last.age = 1;
        keys.push_back(last);
        return;
    }
    size_t widest = 0;
    double gap = 0;
    for (size_t i = 0; i + 1 < keys.size(); ++i) {
        const double own = keys[i + 1].age - keys[i].age;
        if (own > gap) gap = own, widest = i;
    }
    if (gap <= 2 * leastAgeGap) return;
    const ColorKey &a = keys[widest], &b = keys[widest + 1];
    keys.insert(keys.begin() + std::ptrdiff_t(widest) + 1,
                {0.5 * (a.age + b.age), 0.5 * (a.color + b.color), 0.5 * (a.opacity + b.opacity)});
}

}  // namespace shoal
