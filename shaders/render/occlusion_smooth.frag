// Smooths the map of render/occlusion.frag: the mean of four by four texels, which have had each of its sixteen angles, of
// those that lie as deep.

#include "render/occlusion.glsl"

in vec2 screen;

out float fragment;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float depth = texture(occlusion, screen).x;
    vec4 sum = vec4(0.0), weights = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        vec4 texels = texelsAround(texel + 2 * ivec2(i & 1, i >> 1) - 1);
        vec4 alike = likeness(texels, depth);
        weights += alike;
        sum += alike * seenFrom(texels);
    }
    float seen = dot(sum, vec4(1.0)) / (max(dot(weights, vec4(1.0)), 1e-3) * float(seenBits));
    fragment = texelOf(seen, depth);
}
