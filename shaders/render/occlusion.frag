// How much of the sky each place still sees past what stands near it in the picture [McGuire 2012]: samples on a spiral
// around the pixel, turned by sixteen angles in turn, which render/occlusion_smooth.frag smooths again.
// Output: render/occlusion.glsl.

#include "render/occlusion.glsl"

uniform sampler2D sceneDepth;  // 1 - nearest / depth
uniform float nearest;         // m
uniform vec2 tangents;         // of half the field of view
uniform vec2 reach;            // x by the picture's height, y m at the most

out float fragment;

const int samples = 12;  // each a quarter of a turn on

// In the eye's directions, m. `texel`: whole numbers.
vec3 placeAt(vec2 texel)
{
    vec2 size = vec2(textureSize(sceneDepth, 0));
    vec2 uv = (clamp(texel, vec2(0.0), size - 1.0) + 0.5) / size;
    float depth = nearest / max(1.0 - textureLod(sceneDepth, uv, 0.0).r, 1e-7);
    return depth * vec3((2.0 * uv - 1.0) * tangents, -1.0);
}

// Returns the one of two steps to a neighbour that changes depth less, and so stays on the surface.
vec3 flatter(vec3 a, vec3 b)
{
    return abs(a.z) < abs(b.z) ? a : b;
}

void main()
{
    ivec2 size = textureSize(sceneDepth, 0);
    // with a neighbour at either side
    vec2 texel = vec2(clamp(2 * ivec2(gl_FragCoord.xy), min(ivec2(1), size - 1), max(size - 2, ivec2(0))));
    vec3 place = placeAt(texel);
    float depth = -place.z;
    float height = 2.0 * tangents.y * depth;  // m, of the picture there
    float radius = min(reach.x * height, reach.y);
    float pixels = radius / height * float(size.y);
    vec3 across = flatter(placeAt(texel + vec2(1.0, 0.0)) - place, place - placeAt(texel - vec2(1.0, 0.0)));
    vec3 up = flatter(placeAt(texel + vec2(0.0, 1.0)) - place, place - placeAt(texel - vec2(0.0, 1.0)));
    vec3 normal = cross(across, up);
    float area = length(normal);
    normal /= area;
    // Ordered dithering: the turns of every two by two texels are a quarter apart.
    ivec2 low = ivec2(gl_FragCoord.xy) & 1;
    ivec2 high = ivec2(gl_FragCoord.xy) >> 1 & 1;
    int order = 8 * (low.x ^ low.y) + 4 * low.y + 2 * (high.x ^ high.y) + high.y;
    float turn = 6.2831853 / 16.0 * (float(order) + 2.0);
    vec2 arm = pixels * vec2(cos(turn), sin(turn));
    float hidden = 0.0;
    // None behind all, far away, and in a picture of one or two texels.
    int count = depth < 0.99e7 * nearest && pixels >= 2.0 && area > 0.0 ? samples : 0;
    for (int i = 0; i < count; ++i) {
        float share = (float(i) + 0.5) / float(samples);
        vec3 way = placeAt(texel + trunc(share * arm)) - place;
        arm = vec2(-arm.y, arm.x);
        float squared = dot(way, way);
        float near = max(1.0 - squared / (radius * radius), 0.0);
        float above = max(dot(way, normal) - 0.002 * depth, 0.0);
        hidden += near * near * above / (squared + 1e-3 * radius * radius);
    }
    float seen = max(1.0 - 2.0 * radius * hidden / float(samples), 0.0);
    fragment = texelOf(seen, min(depth, 6e4));
}
