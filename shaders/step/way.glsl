// The way of a vertex through a substep, followed from touch to touch.

// Returns a number, m^2, that is negative where a vertex and the surfaces may move by more than `free` towards one another
// in a step. In squares, because this is asked of every vertex in every substep.
float beyondReach(float free, vec3 velocity, float step)
{
    float squared = dot(velocity, velocity);
    if (collidersMove) squared = 2.0 * (squared + fastestSurface() * fastestSurface());
    return free * abs(free) - squared * (step * step);
}

void setWay(vec3 drifted, float step)
{
    waySquared = (dot(drifted, drifted) + fastestSurface() * fastestSurface()) * (2.0 * step * step);
}

// Returns the direction in which a vertex leaves the colliders that it is in: the mean of their normals or, where these
// cancel, a direction across the normal of the deepest, upwards.
vec3 wayOut(Survey s, vec3 gravity)
{
    Touch t = s.deepest;
    float together = length(s.outwards);
    vec3 up = gravity - t.normal * dot(gravity, t.normal);
    vec3 other = abs(t.normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 across = dot(up, up) > 1e-6 ? -normalize(up) : normalize(cross(t.normal, other));
    return together > 0.1 ? s.outwards / together : across;
}

// Returns a number that is negative where a vertex is inside a collider, or so near that it may have crossed one.
float margin(vec3 anchor, vec3 position, vec3 velocity, float step, float time)
{
    vec2 free = clearances(anchor, position, time);
    return areSwept ? min(free.x, beyondReach(free.y, velocity, step)) : free.x;
}

// Where a vertex is on its way through a substep.
struct Way {
    vec3 from;    // m
    float begin;  // s, since the frame's start
    ivec3 skip;   // numbers of the surfaces that count no more
    bool caught;  // deep inside a collider where it began
};

// Returns the next surface that the vertex touches on its way to c.position, where it arrives at the time `end`. Where
// it touches none, the distance is not negative. For a surface that is looked for along the way, the distance is that
// of c.position from its plane at the touch, and `way` moves on to that touch.
//
// One survey stands here for the way and for its end, because a rasteriser on a CPU runs this text at least once a frame.
// `met`: the survey of the end.
Touch nextTouch(vec3 anchor, Contact c, inout Way way, float end, bool first, out Survey met)
{
    Touch found = noTouch();
    float ago = -1.0;  // s
    // Within the ball that was searched, a vertex can touch only the listed colliders. A moving one may throw it out of
    // the ball.
    if (areTabled && max(distance(way.from, nearPlace), distance(c.position, nearPlace)) >= nearReach) nearKnown = false;
    if (!areSwept) met = survey(anchor, c.position, c.velocity, end, ivec3(way.skip.xy, -1));
    vec3 path = c.position - way.from;
    float span = end - way.begin;
    float most = max(length(path) + fastestSurface() * span, 1e-20);
    float s = 0.0;  // share of the way; 1: its end
    bool stopped = false;
    for (int n = 0; areSwept && n <= mostMarches; ++n) {
        bool ends = s >= 1.0 || n == mostMarches;
        ends = ends || (areTabled && turns > mostTurns);
        met = survey(anchor, ends ? c.position : way.from + path * s, c.velocity, ends ? end : way.begin + span * s,
                    ivec3(way.skip.xy, found.which));
        if (ends) break;
        way.caught = way.caught || (first && n == 0 && met.inmost < -caughtDepth);
        if (areTabled && way.caught) nearKnown = false;  // it may come out far away
        Touch near = met.swept;
        bool last = n == mostMarches - 1;
        float approach = dot(path - near.velocity * span, near.normal);
        float atEnd = near.distance + approach * (1.0 - s);
        if (way.caught) {
            s = 1.0;
        } else if (near.distance > touching && !last) {
            s += near.distance / most;
        } else if (atEnd >= 0.0) {
            way.skip = ivec3(near.which, way.skip.x, -1);  // along it, or away
        } else if (near.distance > 0.0 && !stopped && !last) {
            // on to the touch itself: at an edge the normal changes within micrometres
            s = min(s - near.distance / approach, 0.999999);
            stopped = true;
        } else {
            found = near;
            found.distance = atEnd;
            way.from += path * s;
            way.begin += span * s;
            ago = end - way.begin;
            s = 1.0;
        }
    }
    if (areSwept) found.velocity = met.asked;  // where the substep ends, as of a solid one
    if (met.entered > ago) found = met.solid;
    return found;
}
