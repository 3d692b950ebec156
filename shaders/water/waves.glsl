// The waves of a surface of water: the same ones on every square tile of it (src/render/water_light.h).

const int waveCount = 14;  // src/render/water_light.h

uniform vec4 waves[waveCount];  // xy whole waves along a tile's sides; z steepness, a wave's share; w phase, turns

// The cosine of an angle in turns, off by 7e-5 at most.
float cosineOf(float turns)
{
    float u = abs(fract(turns) - 0.5) - 0.25;
    float square = u * u;
    return u * (6.28128 + square * (-41.0952 + square * 73.5848));
}

// Slope of the surface at a place in tiles, of steepness 1.
vec2 waveSlope(vec2 point)
{
    vec2 slope = vec2(0.0);
    for (int i = 0; i < waveCount; ++i)
        slope += waves[i].z * waves[i].xy * cosineOf(dot(waves[i].xy, point) + waves[i].w);
    return slope;
}

// As waveSlope(), with ripples of the same waves, smaller and turned, whose loop is shared.
vec2 rippledSlope(vec2 point)
{
    vec2 ripple = mat2(2.1, 1.3, -1.3, 2.1) * point;
    vec2 slope = vec2(0.0);
    for (int i = 0; i < waveCount; ++i) {
        vec4 wave = waves[i];
        slope += wave.z * wave.xy *
                 (cosineOf(dot(wave.xy, point) + wave.w) + 0.6 * cosineOf(dot(wave.xy, ripple) + wave.w));
    }
    return slope;
}
