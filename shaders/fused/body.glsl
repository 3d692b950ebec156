// Impact of a molecule that is stiffer than the step, as a rigid body (RIGID_IMPACT). Needs fused/contact.glsl's copies
// of the vertices.
//
// Within a substep all deformations of such a molecule have died away, so that an impulse p at r from the centre of mass
// moves all of it: dV = p / M, dW = I^-1 (r x p). A vertex alone would give way with its own mass, and the springs, which
// the implicit solvers damp, would swallow the bounce.
//
// Sequential impulses [Guendelman 2003], [Catto 2005] over the vertices that touch: each asks for the
// normal velocity that it would have alone, restitution and all; what is pushed never pulls, and friction stays within
// mu of it (Coulomb). The way out of the surface is found likewise.

const int bodyRounds = 12;

struct Body {
    float perMass;   // 1/kg
    mat3 perInertia;
    vec3 centre;
    vec3 velocity, spin;    // changes so far
    vec3 shift, turn;
};

float pushed[VERTICES];   // N s, along the normal
vec3 rubbed[VERTICES];    // N s, across it
float lifted[VERTICES];   // kg m

vec3 spinOf(Body body, vec3 arm, vec3 impulse)
{
    return body.perInertia * cross(arm, impulse);
}

// Returns the inverse effective mass, 1/kg, of an impulse along the unit vector n at `arm`.
float yielding(Body body, vec3 arm, vec3 n)
{
    vec3 across = cross(arm, n);
    return body.perMass + dot(across, body.perInertia * across);
}

Body bodyAtRest()
{
    float mass = 0.0;
    vec3 centre = vec3(0.0);
    mat3 inertia = mat3(0.0);
    for (int k = 0; k < VERTICES; ++k) {
        mass += 1.0 / inverseMass[k];
        centre += startPlace[k] / inverseMass[k];
    }
    centre /= mass;
    for (int k = 0; k < VERTICES; ++k) {
        vec3 arm = startPlace[k] - centre;
        inertia += (mat3(dot(arm, arm)) - outerProduct(arm, arm)) * (1.0 / inverseMass[k]);
    }
    // a rod has none about its axis
    float most = max(max(inertia[0][0], inertia[1][1]), max(inertia[2][2], 1e-30));
    return Body(1.0 / mass, inverse(inertia + mat3(1e-5 * most)), centre, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
}

// Brings one vertex's normal and friction impulse to what the body's velocity, with all impulses so far, asks of it.
void push(inout Body body, vec3 arm, vec3 before, vec3 alone, vec4 struck, vec3 surface, inout float normal,
          inout vec3 tangent)
{
    vec3 n = struck.xyz;
    vec3 moving = before + body.velocity + cross(body.spin, arm);
    float asked = normal + dot(alone - moving, n) / yielding(body, arm, n);
    float change = max(asked, 0.0) - normal;
    normal += change;
    body.velocity += n * (change * body.perMass);
    body.spin += spinOf(body, arm, n * change);

    vec3 slip = before + body.velocity + cross(body.spin, arm) - surface;
    slip -= n * dot(slip, n);
    float speed = length(slip);
    vec3 along = slip / max(speed, 1e-20);
    vec3 wanted = tangent - along * (speed / yielding(body, arm, along));
    wanted *= min(1.0, struck.w * normal / max(length(wanted), 1e-20));
    vec3 rub = wanted - tangent;
    tangent = wanted;
    body.velocity += rub * body.perMass;
    body.spin += spinOf(body, arm, rub);
}

// Does for the body's displacement what push() does for its velocity; `way`: the displacement of the vertex
// alone.
void lift(inout Body body, vec3 arm, vec3 way, vec3 n, inout float height)
{
    vec3 left = way - body.shift - cross(body.turn, arm);
    float change = max(height + dot(left, n) / yielding(body, arm, n), 0.0) - height;
    height += change;
    vec3 across = left - n * dot(left, n);
    float size = length(across);
    vec3 along = across / max(size, 1e-20);
    vec3 impulse = n * change + along * (size / yielding(body, arm, along));
    body.shift += impulse * body.perMass;
    body.turn += spinOf(body, arm, impulse);
}

// Replaces the answers of the single vertices by one of the whole molecule.
void answerAsBody()
{
    bool held = false;
    bool any = false;
    for (int k = 0; k < VERTICES; ++k) {
        held = held || isHeld(pinned[k]);
        any = any || struck[k].w >= 0.0;
        pushed[k] = 0.0;
        rubbed[k] = vec3(0.0);
        lifted[k] = 0.0;
    }
    if (!any || held) return;
    Body body = bodyAtRest();
    for (int round = 0; round < bodyRounds; ++round) {
        for (int k = 0; k < VERTICES; ++k) {
            if (struck[k].w >= 0.0) {
                vec3 arm = startPlace[k] - body.centre;
                push(body, arm, driftedBy[k], touchVelocity[k], struck[k], struckSurface[k], pushed[k], rubbed[k]);
                lift(body, arm, touchPosition[k] - startPlace[k], struck[k].xyz, lifted[k]);
            }
        }
    }
    for (int k = 0; k < VERTICES; ++k) {
        vec3 arm = startPlace[k] - body.centre;
        touchVelocity[k] = driftedBy[k] + body.velocity + cross(body.spin, arm);
        touchPosition[k] = startPlace[k] + body.shift + cross(body.turn, arm);
    }
}
