// The waves of a surface of water: the same ones on every square tile of it (src/render/water_light.h).

const int waveCount = 14;  // src/render/water_light.h

uniform vec4 waves[waveCount];  // xy whole waves along a tile's sides; z steepness, a wave's share; w phase, rad

// Slope of the surface at a place in tiles, of steepness 1.
vec2 waveSlope(vec2 point)
{
    vec2 slope = vec2(0.0);
    for (int i = 0; i < waveCount; ++i)
        slope += waves[i].z * waves[i].xy * cos(6.2831853 * dot(waves[i].xy, point) + waves[i].w);
    return slope;
}
