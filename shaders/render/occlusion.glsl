// The map of render/occlusion.frag, which has half the picture's size. A texel holds the depth, m, in a float whose ten last
// bits are instead what is seen of the sky, so that four texels are read at once where the driver GATHERS.

uniform sampler2D occlusion;

const uint seenBits = 1023u;

float texelOf(float seen, float depth)
{
    return uintBitsToFloat((floatBitsToUint(depth) & ~seenBits) | uint(seen * float(seenBits) + 0.5));
}

// What the texels see of the sky, times seenBits.
vec4 seenFrom(vec4 texels)
{
    return vec4(floatBitsToUint(texels) & uvec4(seenBits));
}

// 1 where texels lie on the surface that is `depth` away, 0 where they lie on another.
vec4 likeness(vec4 texels, float depth)
{
    return max(1.0 - abs(texels - depth) / (0.03 * max(depth, 1e-6)), 0.0);
}

// The four texels around the corner that `corner` texels lie left of and below: upper left, upper right, lower right, lower
// left.
vec4 texelsAround(ivec2 corner)
{
#ifdef GATHERS
    return textureGather(occlusion, vec2(corner) / vec2(textureSize(occlusion, 0)));
#else
    ivec2 last = textureSize(occlusion, 0) - 1;
    ivec2 low = clamp(corner - 1, ivec2(0), last), high = clamp(corner, ivec2(0), last);
    return vec4(texelFetch(occlusion, ivec2(low.x, high.y), 0).x, texelFetch(occlusion, high, 0).x,
                texelFetch(occlusion, ivec2(high.x, low.y), 0).x, texelFetch(occlusion, low, 0).x);
#endif
}

// Returns how much of the sky a pixel of the picture sees, by those of the four texels around it that lie as deep.
float skySeen(ivec2 pixel, float depth)
{
    vec2 high = 0.5 * vec2(pixel & 1), low = 1.0 - high;
    vec4 texels = texelsAround((pixel >> 1) + 1);
    vec4 weights = vec4(low.x, high.x, high.x, low.x) * vec4(high.y, high.y, low.y, low.y) * likeness(texels, depth);
    float sum = dot(weights, vec4(1.0));
    return sum > 1e-3 ? dot(weights, seenFrom(texels)) / (sum * float(seenBits)) : 1.0;
}
