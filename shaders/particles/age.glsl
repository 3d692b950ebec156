// Ages a molecule by a frame. It dies of age, outside a box (CONFINED), or some time after it has touched a
// collider (TOUCH_COUNTS): its place becomes free, and with DEATHS its death is recorded: one bit a
// place, so that neighbours that die together leave the same bits in whatever order. In fragments the state itself tells
// (births/bits.pass.glsl). A place that is free stays so. Needs fused/state.glsl.
#ifndef LAYERED
layout(std430) buffer FreeBits { uint freeBits[]; };
#ifdef DEATHS
layout(std430) buffer DiedBits { uint diedBits[]; };
#endif
#endif
#ifdef CONFINED
uniform vec4 livesAbove[2], livesBelow[2];  // m, corners of the box, each a point of the anchors' lattice and the rest
#endif
#ifdef TOUCH_COUNTS
uniform float afterContact;  // s
#endif

void growOlder(int molecule)
{
#ifdef TOUCH_COUNTS
    bool anyTouched = anyLane(touched);
#endif
#ifdef CONFINED
    vec3 place = firstPlace();
#endif
    if (!taken()) return;
    age += frameDuration;
#ifdef TOUCH_COUNTS
    if (anyTouched) span = min(span, age + afterContact);
#endif
    bool dies = age >= span;
#ifdef CONFINED
    vec3 above = ((anchor - livesAbove[0].xyz) - livesAbove[1].xyz) + place;
    vec3 below = ((anchor - livesBelow[0].xyz) - livesBelow[1].xyz) + place;
    dies = dies || min(above.x, min(above.y, above.z)) < 0.0 || max(below.x, max(below.y, below.z)) > 0.0;
#endif
    if (dies) {
        age = clamp(age - span, 0.0, frameDuration);  // how long ago
        span = 0.0;
#ifndef LAYERED
        if (isFirstLane()) {
            uint bit = 1u << (uint(molecule) & 31u);
            atomicOr(freeBits[molecule >> 5], bit);
#ifdef DEATHS
            atomicOr(diedBits[molecule >> 5], bit);
#endif
        }
#endif
    }
}
