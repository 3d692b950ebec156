// The direction away from the nearest collider. Needs generated/colliders.glsl.

// Returns the gradient of the distance there times `nudge`, m, by differences over it; distance: m, at the place itself.
vec3 wallSlope(vec3 anchor, vec3 place, float time, float nudge, float distance)
{
    return vec3(clearance(anchor, place + vec3(nudge, 0.0, 0.0), time),
                clearance(anchor, place + vec3(0.0, nudge, 0.0), time),
                clearance(anchor, place + vec3(0.0, 0.0, nudge), time)) - distance;
}
