// Contact of a vertex with a collider: restitution and Coulomb friction whose result does not depend on the
// step. Replaces Latta's (4) and (5): normal part (v.n) n, and friction bounded by the normal impulse instead
// of a factor (1 - mu) per step. Read as C++ through GLM by the tests.

struct Contact {
    vec3 position;
    vec3 velocity;
};

// Describes the solver's last drift.
//   step       h of the substep, s
//   kickDrift  how long the velocity that the step's acceleration added has moved the position: h for euler, h/2
//              for leapfrog
//   lag        how far the stored velocity lags behind the position: h/2 for euler (its positions lie on the
//              exact parabola of the velocity half a step later), 0 for leapfrog
//   acceleration  of this vertex, by gravity and forces, springs and contacts, m/s^2
//   beyond     where the solver has a history of its ways: how far this vertex's way differs from that of a constant
//              acceleration between its velocities, m
struct Drift {
    float step;
    float kickDrift;
    float lag;
    vec3 acceleration;
#ifdef HISTORY
    vec3 beyond;
#endif
};

// Returns how much the acceleration has added to the way of a vertex that began the substep at the surface's velocity, m. v: m/s,
// relative to the surface.
vec3 wayGained(vec3 v, Drift drift)
{
#ifdef HISTORY
    return v * (0.5 * drift.step) + drift.beyond;
#else
    return v * drift.kickDrift;
#endif
}

// A vertex within this of a surface, in m, may rest where it is: float's rounding a metre from the anchor.
const float restingSlack = 1e-6f;

// A vertex that was deeper than this, in m, when its drift began is caught: it did not come from outside.
const float caughtDepth = 0.005f;
// m/s: at most so fast a caught vertex is taken out, and leaves.
const float pushSpeed = 1.0f;

// The vertex at x with velocity v lies `distance` from the surface (negative: inside); n is the unit normal.
//
// The speed at the moment of impact follows from energy, v_i^2 = v_n^2 - 2 |g_n| depth, and the time since
// from the depth, so that a bounce keeps its height whatever the phase of the impact within the step. The
// vertex flies back from the surface for that time; if it is brought down again within it, it rests. What brings it down
// is all that presses it on: beside gravity the springs, or what lies on a molecule would make its feet bounce for ever.
// Friction changes the velocity by at most mu times the normal change, never past a stop, and takes back the
// part of the drift that the lost velocity had made: a vertex that sticks does not creep.
//
// Without branches: what does not apply is chosen away at the end, because a rasteriser on a CPU runs every branch of
// its lanes anyway, and then pays for the bookkeeping of the branches as well.
// `inside`: whether the vertex was deep inside when its drift began, where that is known.
Contact respond(bool inside, vec3 x, vec3 v, float distance, vec3 n, float restitution, float friction, Drift drift)
{
    float depth = max(-distance, 0.0f);
    float vn = dot(v, n);
    vec3 surface = x + n * depth;

    float gn = dot(drift.acceleration, n);
    float synchronised = vn + gn * drift.lag;
    float impact = sqrt(max(synchronised * synchronised + 2.0f * gn * depth, 0.0f));
    float since = min(depth / max(0.5f * (impact - synchronised), 1e-20f), drift.step);
    float rebound = restitution * impact;
    // faster than half a step can bring it down again: it bounces; otherwise it rests
    bool bounces = rebound > 0.5f * abs(gn) * drift.step && rebound + 0.5f * gn * since > 0.0f;
    float newNormal = bounces ? rebound + gn * (since - drift.lag) : 0.0f;
    float height = bounces ? (rebound + 0.5f * gn * since) * since : 0.0f;
    float frictionTime = bounces ? since : drift.kickDrift;

    vec3 tangential = v - n * vn;
    float speed = sqrt(dot(tangential, tangential));
    // the impulse acts over the whole resting step, or at the impact
    float normalChange = bounces ? rebound + impact : -vn;
    float lost = min(friction * normalChange, speed);
    vec3 lostVelocity = tangential * (lost / max(speed, 1e-30f));
    vec3 position = surface + n * height - lostVelocity * frictionTime;
    vec3 velocity = tangential - lostVelocity + n * newNormal;

    // A vertex that started its drift on the surface, at rest, goes back exactly: anything else would add up
    // a rounding a step. The slack stays well below the drift itself, or what rests above the surface would
    // seem to bounce.
#ifdef HISTORY
    float started = distance - dot(wayGained(v, drift), n);
#else
    float started = distance - vn * drift.kickDrift;
#endif
    float slack = min(restingSlack, -0.02f * vn * drift.kickDrift);
    bool rests = !bounces && lost >= speed && abs(started) < slack;
    position = rests ? x - wayGained(v, drift) : position;
    velocity = rests ? vec3(0.0f) : velocity;

    bool leaves = vn >= 0.0f;  // already on its way out
    position = leaves ? surface : position;
    velocity = leaves ? v : velocity;

    // A vertex deeper than it can have come within the step leaves the short way, but slowly and without a kick.
    bool caught = inside || depth > caughtDepth + 2.0f * abs(vn) * drift.step;
    float way = min(depth, (pushSpeed - min(vn, 0.0f)) * drift.step);
    position = caught ? x + n * way : position;
    velocity = caught ? v + n * (clamp(vn, 0.0f, pushSpeed) - vn) : velocity;

    bool outside = distance >= 0.0f;
    return Contact(outside ? x : position, outside ? v : velocity);
}

// Contact as a constraint on the position [Jakobsen 2001], [Latta 2004, section 3.4.3], for verlet: the vertex is moved
// out of the surface, and its velocity is what that leaves of the substep's way, v + moved / h = (x' - x_before) / h.
// Nothing bounces. Friction takes back the way along the surface, by at most mu times the depth (Coulomb: a depth of h^2 g
// is a pressure of g); what is caught leaves at no more than pushSpeed.
Contact constrain(bool inside, vec3 x, vec3 v, float distance, vec3 n, float friction, float step)
{
    float vn = dot(v, n);
    float moved = min(max(-distance, 0.0f), max(pushSpeed - vn, 0.0f) * step);
    vec3 tangential = v - n * vn;
    float speed = sqrt(dot(tangential, tangential));
    float lost = min(friction * moved / step, speed);
    vec3 change = n * (moved / step) - tangential * (lost / max(speed, 1e-30f));

    // A vertex that began the substep at rest on the surface goes back exactly, as in respond.
    float started = distance - vn * step;
    bool rests = lost >= speed && abs(started) < min(restingSlack, -0.02f * vn * step);
    bool outside = distance >= 0.0f;
    // A caught vertex keeps a speed outwards, and none inwards.
    vec3 left = inside ? v + n * (clamp(vn, 0.0f, pushSpeed) - vn) : v + change;
    vec3 place = inside ? x + n * moved : x + change * step;
    rests = rests && !inside;
    return Contact(outside ? x : (rests ? x - v * step : place), outside ? v : (rests ? vec3(0.0f) : left));
}

// Returns the velocity that contact has made of v, without the kick that the solver still owes it, all in m/s. Contact
// acts on v + kick: otherwise friction would cancel only half of what the springs do in a step, and a vertex that it
// holds would creep.
vec3 withoutKick(vec3 answered, vec3 v, vec3 kick)
{
    return answered != v + kick ? answered - kick : v;
}

// Returns the rest, m/s^2, of the acceleration of a vertex at rest on a surface of normal n: none while the surface holds it,
// by a friction within mu of the pressure (Coulomb). Negative friction: it rests on nothing.
vec3 heldBy(vec3 n, float friction, vec3 acceleration)
{
    float pressure = -dot(acceleration, n);
    vec3 along = acceleration + n * pressure;
    float most = friction * pressure;
    bool holds = friction >= 0.0f && pressure >= 0.0f && dot(along, along) <= most * most;
    return holds ? vec3(0.0f) : acceleration;
}

// Whether contact is a constraint on the position.
#ifdef VERLET
const bool isConstraint = true;
#else
const bool isConstraint = false;
#endif

// Contact as the solver takes it; `inside` as for respond.
Contact answer(bool inside, vec3 x, vec3 v, float distance, vec3 n, float restitution, float friction, Drift drift)
{
    if (isConstraint) return constrain(inside, x, v, distance, n, friction, drift.step);
    return respond(inside, x, v, distance, n, restitution, friction, drift);
}

// Height field cell: bilinear height from the four corner heights, fractions f in [0, 1].
float bilinear(float h00, float h10, float h01, float h11, vec2 f)
{
    return mix(mix(h00, h10, f.x), mix(h01, h11, f.x), f.y);
}
