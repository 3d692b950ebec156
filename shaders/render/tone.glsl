// From light to what a screen shows. Set by C++, true or false: LINEAR_LIGHT.

// Samples are averaged by the resolve after being squeezed by their brightest channel, so that one sample of
// the sun does not outweigh its three dark neighbours and edges stay smooth [Karis 2013]. With LINEAR_LIGHT, where
// something is blended, light is stored as it is: blending is exact only then.
vec3 squeeze(vec3 radiance)
{
    return LINEAR_LIGHT ? radiance : radiance / (1.0 + max(radiance.r, max(radiance.g, radiance.b)));
}

vec3 unsqueeze(vec3 stored)
{
    return LINEAR_LIGHT ? stored : stored / max(1.0 - max(stored.r, max(stored.g, stored.b)), 1e-3);
}

// A fit of the ACES reference film curve [Narkowicz 2016]: deep shadows, and
// highlights that roll off instead of clipping.
vec3 toneMap(vec3 radiance)
{
    vec3 x = radiance * 0.5;  // exposure 1 suits sunlight of the default strength
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

// IEC 61966-2-1, whose power of 1 / 2.4 is a sum of roots here: off by at most 0.11 of 255, and 1 at 1.
vec3 encodeSrgb(vec3 linear)
{
    vec3 c = clamp(linear, 0.0, 1.0);
    vec3 root = sqrt(c);
    vec3 curve = 0.827698 * root + 0.302121 * sqrt(root) - 0.052253 * c - 0.077566;
    return mix(12.92 * c, curve, step(0.0031308, c));
}
