// From light to what a screen shows.

// Samples are averaged by the resolve after being squeezed by their brightest channel, so that one sample of
// the sun does not outweigh its three dark neighbours and edges stay smooth (Karis 2013, "Tone mapping").
vec3 squeeze(vec3 radiance)
{
    return radiance / (1.0 + max(radiance.r, max(radiance.g, radiance.b)));
}

vec3 unsqueeze(vec3 squeezed)
{
    return squeezed / max(1.0 - max(squeezed.r, max(squeezed.g, squeezed.b)), 1e-3);
}

// Hable's filmic curve (2010, "Uncharted 2: HDR lighting"): a soft toe that keeps shadows deep and a long
// shoulder that keeps colour in bright leaves.
vec3 filmicCurve(vec3 x)
{
    return (x * (0.22 * x + 0.03) + 0.002) / (x * (0.22 * x + 0.3) + 0.06) - 0.002 / 0.06;
}

vec3 toneMap(vec3 radiance)
{
    const float white = 6.0;  // radiance that becomes 1
    return filmicCurve(radiance * 1.6) / filmicCurve(vec3(white * 1.6));
}

// IEC 61966-2-1.
vec3 encodeSrgb(vec3 linear)
{
    vec3 c = clamp(linear, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
