// Steers one member of a school: the others, enemies, walls and its own habits give one acceleration, from which the
// motion of its body follows.
#include "school/grid.glsl"
#include "physics/school.glsl"
#include "physics/random.glsl"

#pragma reads bodies starts places velocities

uniform int firstBody;  // of the group

uniform ivec4 grids[1 + TARGETS];     // first slot, slots, first key, keys; of its own, then of its targets
uniform vec4 gridRules[1 + TARGETS];  // 1 / cell; radius, m; strength, m/s^2, below 0 where they are fled from

uniform vec4 others;     // separation radius, separation, alignment, cohesion
uniform vec4 speeds;     // slowest, cruise, fastest, m/s; most acceleration, m/s^2
uniform vec4 habits;     // tangent of the steepest course; most turn, rad/s; reaction, s; wander, m/s^2
uniform vec4 muscles;    // most curvature, 1/m; speed at which they run at their own frequency; fins; keel, 1/s
uniform bool hasBody;    // which bends; else a point
uniform float blindCosine;
uniform float drag;      // 1/s, along the body
uniform vec4 depth;      // lowest and highest y from the origin, m; strength, 1/s^2
uniform vec4 homeLow;    // xyz of the box, or the middle of the ball; w strength, 1/s^2
uniform vec4 homeHigh;   // xyz of the box; w radius of the ball, 0: a box
uniform vec3 origin;     // m
uniform float time;      // s, less whole periods of what wanders
uniform float duration;  // s, of the frame

#ifdef WALLS
#include "generated/colliders.glsl"
#include "step/wall.glsl"

uniform vec3 wallAnchor;  // m, what places are relative to here: the schools' origin, or the world's where that is near
uniform vec2 walls;  // m, in which they are turned from; s, how far ahead

float wallDistance(vec3 place)
{
    return clearance(wallAnchor, place, 0.5 * duration);
}

// Returns an acceleration away from the nearest surface, the stronger the nearer that is to the member or to the place
// ahead of it.
vec3 fromWalls(vec3 place, vec3 velocity)
{
    vec3 ahead = place + velocity * walls.y;
    float distance = min(wallDistance(ahead), wallDistance(place));
    vec3 a = vec3(0.0);
    bool near = distance < walls.x;
    while (near) {
        float nudge = 0.1 * walls.x;
        vec3 slope = wallSlope(wallAnchor, ahead, 0.5 * duration, nudge, wallDistance(ahead));
        float steep = length(slope);
        if (steep > 0.01 * nudge && steep < 1e20)
            a = slope * (speeds.w * clamp(2.0 - 2.0 * distance / walls.x, 0.0, 1.0) / steep);
        near = false;
    }
    return a;
}
#endif

#include "school/others.glsl"

// `slot`: its own, in its grid; `earlier`: how it steered before. Sets what fused/steering.glsl reads.
void steer(int body, int slot, vec4 earlier, out vec4 steering[STEERING_ELEMENTS])
{
    vec4 place = bodiesAt(body, 0);
    vec4 moves = bodiesAt(body, 1);
    vec4 ahead = bodiesAt(body, 2);
    vec4 above = bodiesAt(body, 3);
    vec3 velocity = moves.xyz;
    vec3 forward = ahead.xyz;
    vec3 upper = above.xyz;
    vec3 spin = vec3(moves.w, ahead.w, above.w);
    float speed = dot(velocity, forward);

    vec3 urgent = meetTargets(place.xyz);
    urgent += homeLow.w * (homeHigh.w > 0.0 ? backIntoBall(place.xyz, homeLow.xyz, homeHigh.w)
                                            : backInto(place.xyz, homeLow.xyz, homeHigh.xyz));
#ifdef WALLS
    urgent = inTurn(fromWalls(place.xyz + origin, velocity), urgent, speeds.w);
#endif

    Others seen = lookAround(place.xyz, forward, slot);
    float perOther = 1.0 / max(seen.count, 1.0);
    vec3 liked = seen.apart * others.y;
    if (seen.count > 0.0) {
        // Their mean velocity turns a member, but its own speed follows their mean speed: others that swim in all
        // directions do not stop it.
        vec4 theirs = seen.velocity * perOther;
        vec3 aligned = theirs.xyz - forward * (dot(theirs.xyz, forward) + speed - theirs.w);
        liked += aligned * others.z + seen.place * (perOther * others.w);
    }
    liked.y += depth.z * (clamp(place.y, depth.x, depth.y) - place.y);
    uint seed = uint(place.w);
    float a = uniformFrom(hashSeed(seed, 0x5c0002u));
    float b = uniformFrom(hashSeed(seed, 0x5c0003u));
    float c = uniformFrom(hashSeed(seed, 0x5c0004u));
    vec3 left = cross(upper, forward);
    liked += (left * wanderOf(time, a, b, c) + upper * (0.4 * wanderOf(time, b, c, a)) +
              forward * (0.5 * wanderOf(time, c, a, b))) * habits.w;

    float reaction = habits.z;
    vec3 steered = inTurn(urgent, liked, speeds.w);
    steered = mix(earlier.xyz, steered, 1.0 - exp(-duration / reaction));

    // Steering along the body changes its speed, steering across it turns it.
    vec3 wanted = forward * max(speed, speeds.x) + steered * reaction;
    vec3 course = courseOf(wanted, forward, habits.x);
    vec3 turning = atMost(turnBetween(forward, course) / reaction, habits.y);
    float wantedSpeed = clamp(speeds.y + dot(steered, forward) * (2.0 * reaction), speeds.x, speeds.z);
    // un-damping along the body, for what the tail does not give
    float push = clamp((wantedSpeed - speed) / reaction + drag * wantedSpeed, -speeds.w, speeds.w) * muscles.z;
    vec3 aside = velocity - forward * speed;
    vec3 pushed = forward * push - aside * muscles.w;

    float curvature = 0.0;
    vec3 answer = vec3(0.0);
    if (hasBody) {
        curvature = clamp(dot(turning, upper) / max(speed, 0.5 * speeds.y), -muscles.x, muscles.x);
        // upright, and leaning into its turns
        vec3 lean = vec3(0.0, 1.0, 0.0) + (steered - forward * dot(steered, forward)) * 0.1;
        lean -= forward * dot(lean, forward);
        turning += forward * clamp(6.0 * atan(dot(cross(upper, lean), forward), dot(upper, lean)), -8.0, 8.0);
        answer = (turning - spin) * min(20.0, 0.5 / duration);
    } else {
        // a point turns by being pushed aside
        pushed += cross(turning, velocity);
    }
    float rate = muscles.y > 0.0 ? max(wantedSpeed, 0.3 * speeds.y) / muscles.y : 1.0;
    steering[0] = vec4(pushed, curvature);
    steering[1] = vec4(answer, rate);
    steering[2] = vec4(steered, mod(earlier.w + rate * duration, CLOCK_PERIOD));
}
