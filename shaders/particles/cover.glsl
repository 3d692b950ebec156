// How much of a pixel a particle covers. What C++ sets is in particles/kinds.glsl.

#include "particles/kinds.glsl"
#include "render/blend.glsl"

flat in vec4 color;
flat in vec3 tiles;
// Of points and sprites.
flat in vec2 pointMiddle;
flat in vec4 toSquare;
// Of quads.
in vec2 corner;

uniform sampler2DArray image;  // a layer a tile, so that none bleeds into another
uniform float pixels;          // of a point
uniform float leastCover;      // below this a pixel of what is not blended is left out

// Returns the pixel's place relative to the middle of a point or sprite, in pixels.
vec2 offMiddle()
{
    return gl_FragCoord.xy - pointMiddle;
}

// Returns the pixel's place in the particle's square, whose corners are at +-1.
vec2 inSquare()
{
    if (SHAPE == pointsShape) return offMiddle() * (2.0 / pixels);
    if (SHAPE == spritesShape) return mat2(toSquare.xy, toSquare.zw) * offMiddle();
    return corner;
}

// Returns the coverage of a shape whose edge is where `outwards` is 1; the edge is one pixel wide.
float insideOf(float outwards)
{
    return clamp((1.0 - outwards) / max(fwidth(outwards), 1e-4) + 0.5, 0.0, 1.0);
}

vec4 texelAt(vec2 point)
{
    vec2 uv = point * 0.5 + 0.5;
    vec4 texel = texture(image, vec3(uv, tiles.x));
    if (!FADES) return texel;
    // Mixed by what each covers, so that the colour of what is clear does not count.
    vec4 next = texture(image, vec3(uv, tiles.y));
    vec2 weights = vec2(texel.a * (1.0 - tiles.z), next.a * tiles.z);
    float weight = weights.x + weights.y;
    return vec4((texel.rgb * weights.x + next.rgb * weights.y) / max(weight, 1e-6), weight);
}

// The colour, and in a what of the particle covers the pixel, at a place of its square.
vec4 shownAt(vec2 point)
{
    vec4 shown = vec4(color.rgb, 1.0);
    if (SHAPE == pointsShape) {
        shown.a = clamp((1.0 - length(point)) * 0.5 * pixels + 0.5, 0.0, 1.0);
    } else if (IMAGE) {
        vec4 texel = texelAt(point);
        shown *= texel;
        if (BLEND == noneBlend) shown.a = clamp((texel.a - 0.5) / max(fwidth(texel.a), 1e-4) + 0.5, 0.0, 1.0);
        if (SHAPE == spritesShape) shown.a *= insideOf(max(abs(point.x), abs(point.y)));
    } else {
        // A dot is a bell-shaped blot without a kink at its rim or, where it is not blended, a disc.
        float r2 = dot(point, point);
        float bell = max(1.0 - r2, 0.0);
        shown.a = BLEND == noneBlend ? insideOf(sqrt(r2)) : bell * bell;
    }
    shown.a *= color.a;
    return shown;
}
