// Gravity and Stokes drag towards the fluid velocity u, one linear part that is taken exactly:
//   dv/dt = g + gamma (u - v)  =>  v(h) = v + (u - v) decay + g phi,
//   decay = 1 - exp(-gamma h), phi = decay / gamma (h where gamma = 0), both from the CPU in double where h is one for all.
// Read as C++ through GLM by the tests.

// Returns decay of y = gamma h, without a difference that cancels; its relative error is below 4e-7.
float dragDecay(float y)
{
    float z = 0.5f * y;
    float q = z * z;
    float series = 2.0f * exp(-z) * z * (1.0f + q / 6.0f * (1.0f + q / 20.0f * (1.0f + q / 42.0f)));
    return abs(y) < 1.0f ? series : 1.0f - exp(-y);
}

// Returns phi, s. rate: gamma, 1/s; h: s.
float dragPhi(float rate, float h)
{
    return abs(rate * h) < 1e-6f ? h : dragDecay(rate * h) / rate;
}

// Returns (h - phi) / gamma, s^2, how far an acceleration now carries in h; by its series where h and phi are near.
float dragBend(float rate, float h)
{
    float y = rate * h;
    float series =
        h * h * (0.5f - y / 6.0f * (1.0f - y / 4.0f * (1.0f - y / 5.0f * (1.0f - y / 6.0f * (1.0f - y / 7.0f)))));
    return abs(y) < 0.5f ? series : (h - dragPhi(rate, h)) / rate;
}

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
