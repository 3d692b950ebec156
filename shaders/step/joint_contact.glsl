// Contact of a vertex with several colliders, thin ones or moving ones. Needs `survey`, `clearances`, `materialOf`,
// `fastestSurface`, `collidersMove` and `alone` of generated/colliders.glsl.
//
// The way of the substep is taken as a straight line. Distances change no faster than the vertex and the surfaces move,
// so that a step along the line by what is free (conservative advancement, [Mirtich 1996]) passes through nothing.
// Where it touches, the surface counts as a plane from there on, and `respond` answers as for any other plane: a bounce
// keeps its height whatever the phase and the speed. What remains of the way is looked at again.
//
// Surfaces are answered in the order in which they are touched. Where two press at once and neither alone would do, the
// vertex keeps to both (the crease), where three do, it stays; so no order of the file matters.

const float touching = 1e-5;  // m: what is nearer touches
const float retouching = 1e-6;  // m: rounding may put a vertex this far back into a surface that has been answered
const float stillSquared = isConstraint ? 1e-8 : 1e-10;  // m^2/s^2: at rest, but for the rounding of positions over a substep
const int mostMarches = 48;   // steps along a way
const int mostTouches = alone ? 1 : 6;  // of a substep; a vertex that touches more of several stops there

#include "step/way.glsl"

// Moves the position onto two planes that press at once, and takes the velocity along both.
// `off`: distances of the position; `speeds`: of the velocity along the normals, beyond the surfaces' own.
void keepToBoth(inout Contact c, vec3 a, vec3 b, vec2 off, vec2 speeds)
{
    float cosine = dot(a, b);
    float across = 1.0 - cosine * cosine;
    if (across < 1e-4) return;
    c.position -= (a * (off.x - cosine * off.y) + b * (off.y - cosine * off.x)) / across;
    c.velocity -= (a * (speeds.x - cosine * speeds.y) + b * (speeds.y - cosine * speeds.x)) / across;
}

// Sets with verlet, where contact is a constraint on the position, the velocity that follows from the position.
void followPosition(inout Contact c, vec3 position, vec3 velocity, float step)
{
    if (isConstraint) c.velocity = velocity + (c.position - position) / step;
}

// Whether a velocity, when its part into one surface is taken out, still goes into the other, whichever comes first.
bool bothPress(vec3 toA, vec3 toB, vec3 a, vec3 b)
{
    return dot(toB - b * dot(toB, b), a) < 0.0 && dot(toA - a * dot(toA, a), b) < 0.0;
}

// drifted: the velocity that the position has drifted by. gravity: with the scene's forces, against which is up. time: of the
// substep's end, s since the frame's start.
Contact collideAll(vec3 anchor, vec3 position, vec3 velocity, vec3 drifted, vec3 gravity, Drift drift, float time)
{
    Contact c = Contact(position, velocity);
    struckLast = vec4(0.0, 0.0, 0.0, -1.0);
    Way way = Way(position - drifted * drift.step, time - drift.step, ivec3(-1), false);
    if (areSwept) setWay(drifted, drift.step);
    if (areTabled) gatherNear(anchor, way.from, 3.0 * length(drifted) * drift.step + 1e-3);
    Survey met;
    Touch before = noTouch();
    float beforeOff = 0.0;  // of the plane of `before`
    bool beforeRests = false;
    bool crease = false;
    int secondLast = -2;
    for (int n = 0; n < mostTouches; ++n) {
        Touch t = nextTouch(anchor, c, way, time, n == 0, met);
        if (areSwept && way.caught) {
            t = met.deepest;
            if (!alone) t.normal = wayOut(met, gravity);
        }
        if (t.distance >= 0.0) break;
        if (t.which == secondLast && t.distance > -retouching) {
            way.skip = ivec3(t.which, before.which, -1);
            continue;
        }
        if (!alone && (crease || n == mostTouches - 1)) {
            // the third surface that presses, or the last that is answered
            vec3 back = position - wayGained(velocity - t.velocity, drift);
            vec2 backs = vec2(dot(back, before.normal) - beforeOff, dot(back - c.position, t.normal) + t.distance);
            bool fits = crease && min(backs.x, backs.y) > -touching;
            c = Contact(fits ? back : way.from, t.velocity);
            if (!fits) followPosition(c, position, velocity, drift.step);
            break;
        }
        float off = dot(c.position, t.normal) - t.distance;
        vec2 material = materialOf(t);
        Contact r = answer(way.caught, c.position, c.velocity - t.velocity, t.distance, t.normal, material.x, material.y,
                           drift);
        struckLast = vec4(t.normal, way.caught ? -1.0 : material.y);
        struckVelocity = t.velocity;
        bool rests = isConstraint || dot(r.velocity, t.normal) < 1e-5;  // on a constraint nothing bounces
        r.velocity += t.velocity;
        if (!alone && n > 0) {
            vec2 offs = vec2(dot(r.position, before.normal) - beforeOff, dot(r.position, t.normal) - off);
            vec2 speeds = vec2(dot(r.velocity - before.velocity, before.normal),
                               dot(r.velocity - t.velocity, t.normal));
            crease = rests && beforeRests &&
                     bothPress(velocity - before.velocity, velocity - t.velocity, before.normal, t.normal);
            if (crease) {
                keepToBoth(r, before.normal, t.normal, offs, speeds);
                followPosition(r, position, velocity, drift.step);
                // At rest in the crease, the vertex goes back exactly to where the substep began, or roundings would
                // add up.
                vec3 back = position - wayGained(velocity - t.velocity, drift);
                vec2 backs = vec2(dot(back, before.normal) - beforeOff, dot(back, t.normal) - off);
                vec3 left = r.velocity - t.velocity;
                if (dot(left, left) < stillSquared && all(lessThan(abs(backs), vec2(touching)))) {
                    r = Contact(back, t.velocity);
                }
            } else if (offs.x < -touching) {
                keepToBoth(r, before.normal, t.normal, vec2(offs.x, 0.0), vec2(min(speeds.x, 0.0), 0.0));
                followPosition(r, position, velocity, drift.step);
            }
        }
        c = r;
        if (way.caught) break;
        way.skip = ivec3(t.which, crease ? before.which : -1, -1);
        secondLast = before.which;
        before = t;
        beforeOff = off;
        beforeRests = rests;
    }
    return c;
}

// The surface that a vertex at rest rests on, if that stands still: xyz the surface's normal, w its friction; w negative: none.
vec4 footing(vec3 anchor, vec3 position, float time)
{
    Touch t = nearest(anchor, position, time).touch;
    bool rests = abs(t.distance) < 1.1 * touching && t.velocity == vec3(0.0);
    return vec4(t.normal, rests ? materialOf(t).y : -1.0);
}

// Answers a vertex, as collideAll does, where its nearest surface at the substep's end is all that matters:
// one look for finding, response and the way out. Returns whether that is so; if not, its way has to be followed.
bool answerNearest(vec3 anchor, inout Contact c, vec3 drifted, Drift drift)
{
    setWay(drifted, drift.step);
    Nearest s = nearest(anchor, c.position, 0.0);
    Touch t = s.touch;
    vec2 material = materialOf(t);
    bool passes = s.atEnd || beyondReach(t.distance, drifted, drift.step) >= 0.0;
    bool touches = t.distance < 0.0;
    // a field's distances change up to sqrt(3) times as fast as the place
    float before = (t.distance + caughtDepth) * abs(t.distance + caughtDepth);
    bool caught = !s.isSolid && before < -1.5 * waySquared;
    bool came = s.isSolid || before > 1.5 * waySquared;
    Contact r = answer(caught, c.position, c.velocity, t.distance, t.normal, material.x, material.y, drift);
    bool answered = touches ? s.atEnd && (came || caught) : passes;
    if (!alone) {
        // The answer holds only if no other surface is near the way to its place.
        vec3 moved = r.position - c.position;
        float reach = max(touches ? dot(moved, moved) : 0.0, 0.5 * waySquared);
        float free = max(s.others - 2.0 * touching, 0.0);
        answered = answered && free * free >= 1.21 * reach;
    }
    if (touches && answered) c = r;
    return answered;
}
