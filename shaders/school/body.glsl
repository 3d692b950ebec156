// The body of a molecule as it and others see it, in BODY_ELEMENTS 4-vectors:
//   xyz place, m from the schools' origin         w  1 + seed; 0: it does not live
//   xyz velocity, m/s                             w  x of the turning of its body, rad/s
//   xyz ahead, along its body; unit               w  y of it
//   xyz up, on its upper side; unit, across ahead w  z of it
// The body's axes are the moments by mass along z and y of the rest shape: what the body's bending leaves of them.
#include "state/packed.glsl"

uniform VALUES oldState;
uniform VALUES oldRecords;
uniform vec3 origin;  // m

#include "generated/body.glsl"
#include "physics/random.glsl"

vec3 unit(vec3 v, vec3 fallback)
{
    float size = length(v);
    return size > 1e-12 ? v / size : fallback;
}

void findBody(int molecule, out vec4 body[BODY_ELEMENTS])
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    vec4 record = valueOf(oldRecords, molecule);
    vec3 middle;
    vec3 along;
    vec3 upward;
    vec3 velocity;
    vec3 turning;
    vec3 rolling;
    addUp(first, middle, along, upward, velocity, turning, rolling);
    float label = abs(record.w);
    // a body without a length goes where it moves; one that stands still has a direction from its seed
    uint draw = hashSeed(uint(label), 0x5c0001u);
    float angle = 6.2831853 * uniformFrom(draw);
    vec3 forward = unit(length(along) > 1e-9 ? along : velocity, vec3(sin(angle), 0.0, cos(angle)));
    vec3 upper = length(upward) > 1e-9 ? upward : vec3(0.0, 1.0, 0.0);
    upper = unit(upper - forward * dot(upper, forward), unit(cross(forward, vec3(1.0, 0.0, 0.0)), vec3(0.0, 0.0, 1.0)));
    vec3 spin = vec3(0.0);
    if (length(along) > 1e-9) spin = cross(forward, turning) / length(along);
    if (length(upward) > 1e-9) spin += forward * (dot(cross(upper, rolling), forward) / length(upward));
#ifdef LIFE
    label = packedLife(oldState, first).y > 0.0 ? label : 0.0;
#endif
    body[0] = vec4((record.xyz - origin) + middle, label);
    body[1] = vec4(velocity, spin.x);
    body[2] = vec4(forward, spin.y);
    body[3] = vec4(upper, spin.z);
}
