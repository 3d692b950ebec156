// How far sliders go. Within these limits what is edited can be saved, read again and run: nothing becomes
// too fast or too large for single precision, and nothing is lost by going to an end and coming back.
//
// The ranges grow with what the file says, so that its own numbers are always within them.
#pragma once

#include <vector>

#include "scene/emitter.h"
#include "scene/particle.h"

namespace shoal {

struct Limit {
    double least = 0, most = 1;
};

// Of the numbers of one group; the names are those of Emitter, Burst and Lifecycle.
struct LifeLimits {
    Limit rate{0, 1000};    // 1/s
    Limit time{0, 60};      // s: begin, end, bursts
    Limit every{0, 60};     // s: 0 stands for once
    Limit count{1, 10000};  // of a burst
    Limit perDeath{1, 64};
    Limit position{-1000, 1000};  // m, along each axis
    Limit radius{0.001, 5};       // m
    Limit hollow{0, 1};
    Limit spread{0, 3.14159265358979323846};  // rad
    Limit speed{0, 20};                       // m/s
    Limit inherit{-1, 2};
    Limit life{0.02, 30};       // s
    Limit afterContact{0, 10};  // s
    Limit scale{0.05, 4};
    Limit spin{0, 20};  // rad/s
    Limit grow{0, 5};   // s; shrink, too
    Limit capacity{1, 100000};
};

// Of a group as the file has it; `count` at the start.
LifeLimits limitsOf(const Lifecycle& life, int count);

// What depends on one another, each number being within its limit: an end after the beginning, least below
// most, room for those at the start, a box with an inside.
void settle(Lifecycle& life, int count);

// Of the looks of one group; the names are those of ParticleType.
struct LooksLimits {
    Limit mass{1e-6, 10};   // kg
    Limit size{0.0005, 1};  // m: nothing gets smaller than can be found again
    Limit growth{0, 4};
    Limit turn{-6.283185307179586, 6.283185307179586};    // rad
    Limit spin{-12.566370614359172, 12.566370614359172};  // rad/s
    Limit stretch{0, 0.5};                                // s
    Limit softness{0, 1};                                 // m
    Limit pixels{1, mostParticlePixels};
    Limit frameRate{0, 60};  // 1/s
    Limit spreadFrames{1, 60};
};
LooksLimits limitsOf(const ParticleType& type);

// What is 0 all its life would be seen no more.
void settle(ParticleType& type);

// Between its neighbours in age, so that the keyframes stay in order.
double ageBetween(const std::vector<ColorKey>& keys, size_t key, double age);
// A keyframe more, in the middle of the widest gap and of the colour that is there. Does nothing where there
// are mostColorKeys, or no gap.
void addColorKey(std::vector<ColorKey>& keys);

}  // namespace shoal
