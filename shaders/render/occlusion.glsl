// Reads the map of render/occlusion.frag, which has half the picture's size.

uniform sampler2D occlusion;  // x what is seen of the sky, y depth, m

// 1 for two depths of one surface, 0 for those of different ones.
float likeness(float a, float b)
{
    return max(1.0 - abs(a - b) / (0.03 * max(min(a, b), 1e-6)), 0.0);
}

// Returns how much of the sky a pixel of the picture sees, by those of the four texels around it that lie as deep.
float skySeen(ivec2 pixel, float depth)
{
    vec2 position = 0.5 * vec2(pixel);
    ivec2 first = ivec2(floor(position));
    vec2 share = position - vec2(first);
    ivec2 last = textureSize(occlusion, 0) - 1;
    vec2 sum = vec2(0.0);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            vec2 other = texelFetch(occlusion, min(first + ivec2(x, y), last), 0).xy;
            vec2 weights = mix(1.0 - share, share, vec2(x, y));
            sum += weights.x * weights.y * likeness(other.y, depth) * vec2(other.x, 1.0);
        }
    return sum.y > 1e-3 ? sum.x / sum.y : 1.0;
}
