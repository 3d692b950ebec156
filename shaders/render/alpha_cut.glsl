// A shape cut out of a texture by its alpha.

uniform sampler2D image;  // rgb colour, a inside (1) or outside (0)
uniform float alphaCut;

// Coverage of a pixel, in [0, 1]: alpha made steep, so that the edge is one pixel wide at every distance.
float coverage(float alpha)
{
    return clamp((alpha - alphaCut) / max(fwidth(alpha), 1e-4) + 0.5, 0.0, 1.0);
}

// Averaging thins a shape out as mip levels shrink: its alpha grows by a quarter each level to keep its area
// [Golus 2017].
float keptAlpha(float alpha, vec2 uv)
{
    vec2 size = vec2(textureSize(image, 0));
    vec2 dx = dFdx(uv) * size;
    vec2 dy = dFdy(uv) * size;
    float level = max(0.0, 0.5 * log2(max(dot(dx, dx), dot(dy, dy)) + 1e-12));
    return alpha * (1.0 + 0.25 * level);
}
