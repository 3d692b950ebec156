// Gusts and curl noise by table. The textures repeat and are filtered; generated/fields.glsl declares those that there are.

vec3 gustFromTile(sampler3D tile, vec3 x, float time, vec3 along, vec3 across, float speed, float strength,
                  float frontSpeed, vec2 size, float gone, uint cells, uint seed)
{
    vec3 place = gustPlace(x, time, along, across, frontSpeed, size, gone, cells, seed);
    return along * (speed * (1.0 + strength * textureLod(tile, place, 0.0).x));
}

vec3 curlNoiseFromTile(sampler3D tile, vec3 x, float time, float speed, float size, float period, float drift, float gone,
                       uint cells, uint seed)
{
    MomentPair moments = momentsOf(x, time, size, period, drift, gone, cells, seed);
    return speed * (moments.firstPart * textureLod(tile, moments.first, 0.0).xyz +
                    moments.secondPart * textureLod(tile, moments.second, 0.0).xyz);
}
