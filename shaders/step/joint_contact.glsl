// Contact of a vertex with several colliders, thin ones or moving ones. Needs `survey`, `clearances`, `materialOf`,
// `fastestSurface` and `collidersMove` of generated/colliders.glsl.
//
// The way of the substep is taken as a straight line. Distances change no faster than the vertex and the surfaces move,
// so that a step along the line by what is free (conservative advancement, [Mirtich 1996]) passes through nothing.
// Where it touches, the surface counts as a plane from there on, and `respond` answers as for any other plane: a bounce
// keeps its height whatever the phase and the speed. What remains of the way is looked at again.
//
// Surfaces are answered in the order in which they are touched. Where two press at once and neither alone would do, the
// vertex keeps to both (the crease), where three do, it stays; so no order of the file matters.

const float touching = 1e-5;  // m: what is nearer touches
const float retouching = 1e-6;  // m: rounding brings back so much to a surface that was answered
#ifdef VERLET
const float stillSquared = 1e-8;  // m^2/s^2: at rest, but for the rounding of positions over a substep
#else
const float stillSquared = 1e-10;
#endif
const int mostMarches = 48;   // steps along a way
const int mostTouches = 6;    // of a substep; a vertex that touches more stops there

#ifdef SWEPT
// Negative where a vertex and the surfaces may move by more than `free` towards one another in a step. m^2: in squares,
// because this is asked of every vertex in every substep.
float beyondReach(float free, vec3 velocity, float step)
{
    float squared = dot(velocity, velocity);
    if (collidersMove) squared = 2.0 * (squared + fastestSurface() * fastestSurface());
    return free * abs(free) - squared * (step * step);
}

// The first swept surface on the way from `from` to `to`, between two times: its distance is that of `to` from its
// plane. `from` and `begin` move to where it touches.
Touch sweep(vec3 anchor, inout vec3 from, vec3 to, inout float begin, float end, inout ivec3 skip)
{
    vec3 way = to - from;
    float span = end - begin;
    float most = max(length(way) + fastestSurface() * span, 1e-20);
    Touch found = noTouch();
    float s = 0.0;
    bool there = false;
    for (int n = 0; n < mostMarches && s < 1.0; ++n) {
        Touch near = survey(anchor, from + way * s, vec3(0.0), begin + span * s, skip).swept;
        if (near.distance > touching && n < mostMarches - 1) {
            s += near.distance / most;
            continue;
        }
        float approach = dot(way - near.velocity * span, near.normal);
        float atEnd = near.distance + approach * (1.0 - s);
        if (atEnd < 0.0) {
            // on to the touch itself: at an edge the normal changes within micrometres
            if (near.distance > 0.0 && !there && n < mostMarches - 1) {
                s = min(s - near.distance / approach, 0.999999);
                there = true;
                continue;
            }
            found = near;
            found.distance = atEnd;
            from += way * s;
            begin += span * s;
            break;
        }
        skip = ivec3(near.which, skip.x, -1);  // along it, or away
    }
    return found;
}

// A vertex that is caught is taken out the short way, at a speed of at most pushSpeed, and keeps no speed inwards nor a
// larger one outwards: nothing is shot out. Where it is in several, the short way is that of all together; where they
// push against one another, across, and up.
Contact comesOut(vec3 anchor, Contact c, vec3 gravity, Drift drift, float time)
{
    Survey s = survey(anchor, c.position, c.velocity, time, ivec3(-1));
    Touch t = s.deepest;
    if (t.distance >= 0.0) return c;
    float together = length(s.outwards);
    vec3 up = gravity - t.normal * dot(gravity, t.normal);
    vec3 other = abs(t.normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 across = dot(up, up) > 1e-6 ? -normalize(up) : normalize(cross(t.normal, other));
    vec3 n = together > 0.1 ? s.outwards / together : across;
    vec3 relative = c.velocity - t.velocity;
    float vn = dot(relative, n);
#ifdef VERLET
    float way = min(-t.distance, max(pushSpeed - vn, 0.0) * drift.step);
#else
    float way = min(-t.distance, (pushSpeed - min(vn, 0.0)) * drift.step);
#endif
    return Contact(c.position + n * way, c.velocity + n * (clamp(vn, 0.0, pushSpeed) - vn));
}
#endif

// Negative where a vertex is inside a collider, or so near that it may have crossed one.
float margin(vec3 anchor, vec3 position, vec3 velocity, float step, float time)
{
    vec2 free = clearances(anchor, position, time);
#ifdef SWEPT
    return min(free.x, beyondReach(free.y, velocity, step));
#else
    return free.x;
#endif
}

// The next surface that the vertex touches on its way from `from` to c.position; none: its distance is not
// negative.
Touch nextTouch(vec3 anchor, Contact c, inout vec3 from, inout float begin, float end, inout ivec3 skip)
{
    Touch found = noTouch();
    float ago = -1.0;  // s
#ifdef SWEPT
    found = sweep(anchor, from, c.position, begin, end, skip);
    if (found.distance < 0.0) ago = end - begin;
#endif
    Survey at = survey(anchor, c.position, c.velocity, end, ivec3(skip.xy, found.which));
    found.velocity = at.asked;  // where the substep ends, as of a solid one
    if (at.entered > ago) found = at.solid;
    return found;
}

// Two planes that press at once: takes the position onto both and the velocity along both.
// `off`: distances of the position; `speeds`: of the velocity along the normals, beyond the surfaces' own.
void keepToBoth(inout Contact c, vec3 a, vec3 b, vec2 off, vec2 speeds)
{
    float cosine = dot(a, b);
    float across = 1.0 - cosine * cosine;
    if (across < 1e-4) return;
    c.position -= (a * (off.x - cosine * off.y) + b * (off.y - cosine * off.x)) / across;
    c.velocity -= (a * (speeds.x - cosine * speeds.y) + b * (speeds.y - cosine * speeds.x)) / across;
}

// With verlet contact is a constraint on the position: the velocity is what that leaves.
void followPosition(inout Contact c, vec3 position, vec3 velocity, float step)
{
#ifdef VERLET
    c.velocity = velocity + (c.position - position) / step;
#endif
}

// Whether neither surface alone takes the velocity out of the other.
bool bothPress(vec3 toA, vec3 toB, vec3 a, vec3 b)
{
    return dot(toB - b * dot(toB, b), a) < 0.0 && dot(toA - a * dot(toA, a), b) < 0.0;
}

// drifted: the velocity that the position has drifted by. time: of the substep's end, s since the frame's start.
Contact collideAll(vec3 anchor, vec3 position, vec3 velocity, vec3 drifted, vec3 gravity, Drift drift, float time)
{
    Contact c = Contact(position, velocity);
#ifdef RIGID_IMPACT
    struckLast = vec4(0.0, 0.0, 0.0, -1.0);
#endif
    vec3 from = position - drifted * drift.step;
    float begin = time - drift.step;
#ifdef SWEPT
    waySquared = (dot(drifted, drifted) + fastestSurface() * fastestSurface()) * (2.0 * drift.step * drift.step);
    if (clearances(anchor, from, begin).y < -caughtDepth) return comesOut(anchor, c, gravity, drift, time);
#endif
    ivec3 skip = ivec3(-1);
    Touch before = noTouch();
    float beforeOff = 0.0;  // of the plane of `before`
    bool beforeRests = false;
    bool crease = false;
    int secondLast = -2;
    for (int n = 0; n < mostTouches; ++n) {
        Touch t = nextTouch(anchor, c, from, begin, time, skip);
        if (t.distance >= 0.0) break;
        if (t.which == secondLast && t.distance > -retouching) {
            skip = ivec3(t.which, before.which, -1);
            continue;
        }
        if (crease || n == mostTouches - 1) {
            // the third that presses, or the last of many
            vec3 back = position - (velocity - t.velocity) * drift.kickDrift;
            vec2 backs = vec2(dot(back, before.normal) - beforeOff, dot(back - c.position, t.normal) + t.distance);
            bool fits = crease && min(backs.x, backs.y) > -touching;
            c = Contact(fits ? back : from, t.velocity);
            if (!fits) followPosition(c, position, velocity, drift.step);
            break;
        }
        float off = dot(c.position, t.normal) - t.distance;
        vec2 material = materialOf(t);
        Contact r = answer(c.position, c.velocity - t.velocity, t.distance, t.normal, gravity, material.x, material.y,
                            drift);
#ifdef RIGID_IMPACT
        struckLast = vec4(t.normal, material.y);
        struckVelocity = t.velocity;
#endif
#ifdef VERLET
        bool rests = true;  // nothing bounces
#else
        bool rests = dot(r.velocity, t.normal) < 1e-5;
#endif
        r.velocity += t.velocity;
        if (n > 0) {
            vec2 offs = vec2(dot(r.position, before.normal) - beforeOff, dot(r.position, t.normal) - off);
            vec2 speeds = vec2(dot(r.velocity - before.velocity, before.normal),
                               dot(r.velocity - t.velocity, t.normal));
            crease = rests && beforeRests &&
                     bothPress(velocity - before.velocity, velocity - t.velocity, before.normal, t.normal);
            if (crease) {
                keepToBoth(r, before.normal, t.normal, offs, speeds);
                followPosition(r, position, velocity, drift.step);
                // at rest in it: back to where the substep began, exactly, or roundings would add up
                vec3 back = position - (velocity - t.velocity) * drift.kickDrift;
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
        skip = ivec3(t.which, crease ? before.which : -1, -1);
        secondLast = before.which;
        before = t;
        beforeOff = off;
        beforeRests = rests;
    }
    return c;
}
