// Smooths the map of render/occlusion.frag: the mean of four by four texels, which have had each of its sixteen angles, of
// those that lie as deep.

#include "render/occlusion.glsl"

out vec4 fragment;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(occlusion, 0) - 1;
    float depth = texelFetch(occlusion, texel, 0).y;
    vec2 sum = vec2(0.0);
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            vec2 other = texelFetch(occlusion, clamp(texel + ivec2(x, y), ivec2(0), last), 0).xy;
            sum += likeness(other.y, depth) * vec2(other.x, 1.0);
        }
    fragment = vec4(sum.x / max(sum.y, 1e-3), depth, 0.0, 1.0);
}
