// Water around the eye or below it: what light loses and gains on its way (src/scene/water.h). Places are relative to
// the eye. Needs render/sky.glsl. The light's direction is that in the water.

uniform float fogDensity;       // 1/m, of the air above
uniform float eyeDepth;         // m below the calm surface; negative: above
uniform vec3 waterExtinction;   // 1/m
uniform vec3 waterScattering;   // radiance of endless water, seen along the level just below the surface
uniform sampler2D caustics;     // one tile, 1: as under a calm surface
uniform vec4 causticsAt;        // x strength, y tiles a metre, zw the eye's place in tiles
uniform float causticsDepth;    // m, at which the net is sharp

bool isHazy()
{
    return true;
}

float depthOf(vec3 place)
{
    return eyeDepth - place.y;
}

// Where the light that arrives at a place entered the water, in tiles.
vec2 entryOf(vec3 place, float depth)
{
    vec2 entry = place.xz + sunDirection.xz * (depth / max(sunDirection.y, 0.2));
    return causticsAt.zw + causticsAt.y * entry;
}

// Sunlight that arrives, of a surface's radiance. The net forms with depth, and blurs and fades below.
vec3 sunlightAt(vec3 place)
{
    float depth = depthOf(place);
    if (depth <= 0.0) return sunColor;
    vec2 uv = entryOf(place, depth);
    float relative = depth / causticsDepth;
    float blur = 0.6 * max(log2(max(relative, 1e-3)) - 1.3, 0.0);
    float net = texture(caustics, uv, blur).r;
    // A second net, turned and larger, breaks the tiles' repetition up.
    float wide = texture(caustics, mat2(0.35, 0.28, -0.28, 0.35) * uv + vec2(0.37, 0.11), 1.0 + blur).r;
    float strength = causticsAt.x * smoothstep(0.0, 0.6, relative) / (1.0 + 0.05 * relative);
    float light = 1.0 + strength * (net * (0.55 + 0.45 * wide) - 1.0);
    float way = depth / max(sunDirection.y, 0.2);
    return sunColor * exp(-waterExtinction * way) * max(light, 0.0);
}

// Returns the light that endless water sends along a direction to a place at some depth, from within `way`
// metres: scattering of light that is attenuated on its way down, and then on its way along. In closed form:
// with k the extinction and y the direction's rise, the integral of k exp(-k (depth - y s)) exp(-k s).
vec3 scatteredFrom(float depth, vec3 direction, float way)
{
    float slant = max(1.0 - direction.y, 0.02);
    float forward = max(dot(direction, sunDirection), 0.0);
    float square = forward * forward;
    float glow = 1.0 + 0.9 * square * square * forward;
    vec3 seen = waterScattering * exp(-waterExtinction * max(depth, 0.0)) / slant;
    return glow * seen * (1.0 - exp(-waterExtinction * (slant * way)));
}

// Light from all around onto a surface, divided by pi.
vec3 ambientAt(vec3 place, vec3 normal)
{
    float depth = depthOf(place);
    if (depth <= 0.0) return ambientLight(normal);
    vec3 lost = exp(-waterExtinction * depth);
    vec3 above = lost * (ambientAbove * 0.75 + waterScattering);
    vec3 below = lost * waterScattering * 0.45;
    return mix(below, above, 0.5 + 0.5 * normal.y);
}

// Returns the radiance that a mirror reflects from a direction: the bright round window above, the water's
// own light around and below it.
vec3 mirroredFrom(vec3 place, vec3 direction, float roughness)
{
    float depth = depthOf(place);
    if (depth <= 0.0) return mirroredInAir(direction, roughness);
    vec3 water = scatteredFrom(depth, vec3(direction.x, min(direction.y, 0.6), direction.z), 1e4);
    vec3 window = (skyGradient(vec3(0.0, 1.0, 0.0)) + 0.35 * sunColor) * exp(-waterExtinction * (depth / max(direction.y, 0.3)));
    return water + window * smoothstep(0.66 - 0.3 * roughness, 0.66 + 0.5 * roughness, direction.y);
}

// The way through water from the eye to a place: x where it begins, y its length, m.
vec2 waterWay(vec3 place)
{
    float total = length(place), depth = depthOf(place);
    if (eyeDepth <= 0.0 && depth <= 0.0) return vec2(total, 0.0);
    if (eyeDepth > 0.0 && depth > 0.0) return vec2(0.0, total);
    float wet = total * max(eyeDepth, depth) / (abs(eyeDepth) + abs(depth));
    return eyeDepth > 0.0 ? vec2(0.0, wet) : vec2(total - wet, wet);
}

// Share of the light from a place that reaches the eye.
vec3 hazeThrough(vec3 place)
{
    vec2 way = waterWay(place);
    return exp(-waterExtinction * way.y - fogDensity * (length(place) - way.y));
}

vec3 withHaze(vec3 radiance, vec3 place)
{
    vec2 way = waterWay(place);
    float total = max(length(place), 1e-4);
    vec3 direction = place / total;
    vec3 seen = radiance * exp(-waterExtinction * way.y) + scatteredFrom(eyeDepth, direction, way.y);
    return mix(hazeColor(direction), seen, exp(-fogDensity * (total - way.y)));
}

// Returns the colour that distant things fade into.
vec3 farColor(vec3 direction)
{
    if (eyeDepth <= 0.0 && direction.y >= 0.0) return hazeColor(direction);
    return scatteredFrom(eyeDepth, vec3(direction.x, min(direction.y, 0.5), direction.z), 1e4);
}
