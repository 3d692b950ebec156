// Ages a molecule by a frame. It dies of age, outside a box (where C++ sets CONFINED to true), or some time after it has
// touched a collider (TOUCH_COUNTS): its place becomes free, and with DEATHS its death is recorded: one bit a
// place, so that neighbours that die together leave the same bits in whatever order. In fragments the state itself tells
// (births/sums.pass.glsl). A place that is free stays so. Needs fused/state.glsl.

uniform vec4 livesAbove[2], livesBelow[2];  // m, corners of the box, each a point of the anchors' lattice and the rest

// `place`: m, relative to the anchor.
bool isOutside(vec3 place)
{
    vec3 above = ((anchor - livesAbove[0].xyz) - livesAbove[1].xyz) + place;
    vec3 below = ((anchor - livesBelow[0].xyz) - livesBelow[1].xyz) + place;
    return min(above.x, min(above.y, above.z)) < 0.0 || max(below.x, max(below.y, below.z)) > 0.0;
}

#ifdef TOUCH_COUNTS
uniform float afterContact;  // s

bool hasTouched() { return anyLane(touched); }
#else
const float afterContact = 0.0;

bool hasTouched() { return false; }
#endif

#ifdef LAYERED
void recordDeath(int molecule) {}
#else
layout(std430) buffer FreeBits { uint freeBits[]; };
uniform int firstWord;  // of the part

#ifdef DEATHS
layout(std430) buffer DiedBits { uint diedBits[]; };

void recordDied(int word, uint bit) { atomicOr(diedBits[word], bit); }
#else
void recordDied(int word, uint bit) {}
#endif

void recordDeath(int molecule)
{
    if (!isFirstLane()) return;
    int word = firstWord + (molecule >> 5);
    uint bit = 1u << (uint(molecule) & 31u);
    atomicOr(freeBits[word], bit);
    recordDied(word, bit);
}
#endif

void growOlder(int molecule)
{
    // What all lanes of a molecule have to call comes first.
    bool shortened = hasTouched();
    vec3 place = CONFINED ? firstPlace() : vec3(0.0);
    if (!taken()) return;
    age += frameDuration;
    if (shortened) span = min(span, age + afterContact);
    if (age >= span || (CONFINED && isOutside(place))) {
        age = clamp(age - span, 0.0, frameDuration);  // how long ago
        span = 0.0;
        recordDeath(molecule);
    }
}
