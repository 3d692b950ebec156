// How much of the sky each place still sees past what stands near it in the picture [McGuire 2012]: samples on a spiral
// around the pixel, turned by sixteen angles in turn, which render/occlusion_smooth.frag smooths again.
// Output: x what is seen of the sky, in [0, 1]; y the depth, m.

uniform sampler2D sceneDepth;  // 1 - nearest / depth
uniform float nearest;         // m
uniform vec2 tangents;         // of half the field of view
uniform vec2 reach;            // x by the picture's height, y m at the most

out vec4 fragment;

const int samples = 12;  // each a quarter of a turn on

// In the eye's directions, m.
vec3 placeAt(ivec2 texel)
{
    ivec2 size = textureSize(sceneDepth, 0);
    ivec2 inside = clamp(texel, ivec2(0), size - 1);
    float depth = nearest / max(1.0 - texelFetch(sceneDepth, inside, 0).r, 1e-7);
    return depth * vec3((2.0 * (vec2(inside) + 0.5) / vec2(size) - 1.0) * tangents, -1.0);
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
    ivec2 texel = clamp(2 * ivec2(gl_FragCoord.xy), min(ivec2(1), size - 1), max(size - 2, ivec2(0)));
    vec3 place = placeAt(texel);
    float depth = -place.z;
    fragment = vec4(1.0, min(depth, 6e4), 0.0, 1.0);
    if (texelFetch(sceneDepth, texel, 0).r >= 1.0) return;
    float height = 2.0 * tangents.y * depth;  // m, of the picture there
    float radius = min(reach.x * height, reach.y);
    float pixels = radius / height * float(size.y);
    if (pixels < 2.0) return;
    vec3 across = flatter(placeAt(texel + ivec2(1, 0)) - place, place - placeAt(texel - ivec2(1, 0)));
    vec3 up = flatter(placeAt(texel + ivec2(0, 1)) - place, place - placeAt(texel - ivec2(0, 1)));
    vec3 normal = cross(across, up);
    float area = length(normal);
    if (area == 0.0) return;  // a picture of one or two texels
    normal /= area;
    // Ordered dithering: the turns of every two by two texels are a quarter apart.
    ivec2 low = ivec2(gl_FragCoord.xy) & 1;
    ivec2 high = ivec2(gl_FragCoord.xy) >> 1 & 1;
    int order = 8 * (low.x ^ low.y) + 4 * low.y + 2 * (high.x ^ high.y) + high.y;
    float turn = 6.2831853 / 16.0 * (float(order) + 2.0);
    vec2 arm = vec2(cos(turn), sin(turn));
    float hidden = 0.0;
    for (int i = 0; i < samples; ++i) {
        float share = (float(i) + 0.5) / float(samples);
        vec3 way = placeAt(texel + ivec2(share * pixels * arm)) - place;
        arm = vec2(-arm.y, arm.x);
        float squared = dot(way, way);
        float near = max(1.0 - squared / (radius * radius), 0.0);
        float above = max(dot(way, normal) - 0.002 * depth, 0.0);
        hidden += near * near * above / (squared + 1e-3 * radius * radius);
    }
    fragment.x = max(1.0 - 2.0 * radius * hidden / float(samples), 0.0);
}
