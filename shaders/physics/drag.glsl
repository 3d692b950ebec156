// Gravity and Stokes drag towards the fluid velocity u, one linear part that is taken exactly:
//   dv/dt = g + gamma (u - v)  =>  v(h) = v + (u - v) decay + g phi,
//   decay = 1 - exp(-gamma h), phi = decay / gamma (h where gamma = 0), both from the CPU in double.
// Read as C++ through GLM by the tests.

vec3 dragAndGravity(vec3 v, vec3 u, vec3 gravity, float decay, float phi)
{
    return v + ((u - v) * decay + gravity * phi);
}

// Two rates: across the surface (along its normal n) and along it; each part exactly with its own rate.
// n = 0 (no surface) takes the rate along. Equal rates give dragAndGravity to rounding.
vec3 directionalDragAndGravity(vec3 v, vec3 u, vec3 gravity, vec3 n, vec2 decay, vec2 phi)
{
    vec3 slip = u - v;
    vec3 slipAcross = n * dot(slip, n);
    vec3 gravityAcross = n * dot(gravity, n);
    return v + ((slipAcross * decay.x + (slip - slipAcross) * decay.y) +
                (gravityAcross * phi.x + (gravity - gravityAcross) * phi.y));
}
