// Which surfaces are near a vertex: what generated/colliders.glsl fills in for contact with several colliders, thin
// ones or moving ones (step/joint_contact.glsl).
//
//   swept   colliders that a vertex could cross within a substep: looked for along its way
//   solid   planes and height fields, solid all the way down: looked for at the substep's end

struct Touch {
    vec3 normal;     // unit, towards the free side
    float distance;  // m, less the thickness; negative inside
    vec2 material;   // restitution, friction
    vec3 velocity;   // m/s, of the surface
    int which;       // number of the collider
};

struct Survey {
    Touch swept;      // the nearest of them
    float inmost;     // m, the least distance of them and of the fields that a short way does not cross
    Touch solid;      // of those that the vertex is in, the one it entered first
    float entered;    // s ago
    vec3 outwards;    // sum of the normals of all that it is in
    Touch deepest;    // of all that it is in
    vec3 asked;       // velocity of the swept one whose number is skip.z
};

// A trilinear distance may grow by up to sqrt(3) along the way.
float slower(float distance)
{
    return distance > 0.0 ? distance * 0.577 : distance;
}

// m^2, of the way that a vertex and the surfaces may have moved towards one another in the substep.
float waySquared = 1e30;

bool isShort(float cell)
{
    return waySquared < cell * cell;
}

Touch noTouch()
{
    return Touch(vec3(0.0, 1.0, 0.0), 1e30, vec2(0.0), vec3(0.0), -1);
}

Survey noSurvey()
{
    return Survey(noTouch(), 1e30, noTouch(), -1.0, vec3(0.0), noTouch(), vec3(0.0));
}

void meetAny(inout Survey s, Touch t)
{
    if (t.distance < 0.0) s.outwards += t.normal;
    if (t.distance < min(s.deepest.distance, 0.0)) s.deepest = t;
}

void meetSwept(inout Survey s, Touch t, ivec3 skip)
{
    meetAny(s, t);
    s.inmost = min(s.inmost, t.distance);
    if (t.which == skip.z) s.asked = t.velocity;
    if (t.distance < s.swept.distance && t.which != skip.x && t.which != skip.y) s.swept = t;
}

void meetSolid(inout Survey s, Touch t, vec3 velocity, ivec3 skip)
{
#ifdef NEAR_SOLIDS
    meetSwept(s, t, skip);  // contact between molecules asks for what is near (contact/grid/state_sphere.glsl)
    return;
#endif
    meetAny(s, t);
    float approach = dot(t.velocity - velocity, t.normal);
    float entered = -t.distance / max(approach, 1e-20);
    if (t.distance < 0.0 && entered > s.entered && t.which != skip.x && t.which != skip.y) {
        s.solid = t;
        s.entered = entered;
    }
}

// A distance field, on a way that is shorter than its cell: what is thin in a model is thickened to two cells, so that
// such a way ends inside.
void meetShort(inout Survey s, Touch t, vec3 velocity, ivec3 skip)
{
    s.inmost = min(s.inmost, t.distance);
    meetSolid(s, t, velocity, skip);
}

// The surface nearest to a vertex.
struct Nearest {
    Touch touch;
    bool atEnd;    // whether the end of the way suffices: a solid, or a field that a short way does not cross
    bool isSolid;
    float others;  // m, at least to all others
};

void firstNearest(out Nearest s, Touch t, bool atEnd, bool isSolid)
{
    s = Nearest(t, atEnd, isSolid, 1e30);
}

void meetNearest(inout Nearest s, Touch t, bool atEnd, bool isSolid)
{
    s.others = min(s.others, max(s.touch.distance, t.distance));
    if (t.distance < s.touch.distance) {
        s.touch = t;
        s.atEnd = atEnd;
        s.isSolid = isSolid;
    }
}
