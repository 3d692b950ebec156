// Gusts and curl noise by table. The textures repeat and are filtered; generated/fields.glsl declares those that there are.

// `variation` is a vector, m/s where the noise is 1.
vec3 gustFromTile(sampler3D tile, vec3 x, float time, vec3 mean, vec3 variation, vec3 row0, vec3 row1, vec3 row2,
                  float rate, float gone, uint cells, uint seed)
{
    vec3 place = gustPlace(x, time, row0, row1, row2, rate, gone, cells, seed);
    return mean + variation * textureLod(tile, place, 0.0).x;
}

// unit: of the tile's numbers, m/s; they are whole ones from 512 on, as parts of 1023.
vec3 curlNoiseFromTile(sampler3D tile, vec3 x, float time, float unit, float scale, float rate, float drift, float gone,
                       uint cells, uint seed)
{
    MomentPair moments = momentsOf(x, time, scale, rate, drift, gone, cells, seed);
    vec3 sum = moments.firstPart * textureLod(tile, moments.first, 0.0).xyz +
               moments.secondPart * textureLod(tile, moments.second, 0.0).xyz;
    return unit * (1023.0 * sum - 512.0 * (moments.firstPart + moments.secondPart));
}
