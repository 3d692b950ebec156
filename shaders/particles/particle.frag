// A particle's pixels. Variants: POINTS, SPRITES, IMAGE, LIT as in particle.vert; SOFT; DEPTH_ONLY. What is not blended is cut
// out.

#include "particles/kinds.glsl"
#include "render/blend.glsl"
#ifndef DEPTH_ONLY
#include "render/light.glsl"
#endif

flat in vec4 color;
in vec3 place;
#if defined(POINTS) || defined(SPRITES)
flat in vec2 pointMiddle;
#endif
#ifdef SPRITES
flat in vec4 toSquare;
#endif
#if !defined(POINTS) && !defined(SPRITES)
in vec2 at;
#endif
#ifdef IMAGE
flat in vec3 tiles;
uniform sampler2DArray image;  // a layer a tile, so that none bleeds into another
#endif
#ifdef POINTS
uniform float pixels;
#endif
#ifdef LIT
#if defined(POINTS) || defined(SPRITES)
uniform mat3 viewToScene;
#else
flat in mat3 frame;
#endif
#endif
#ifdef SOFT
uniform sampler2D sceneDepth;  // 1 - nearest / depth
uniform float nearest;         // m
uniform float perSoftness;     // 1/m
#endif
uniform float leastCover;  // below this a pixel of what is not blended is left out
#ifndef DEPTH_ONLY
out vec4 fragment;
#endif

// The edge at 1 of something that grows from the inside out, one pixel wide.
float insideOf(float outwards)
{
    return clamp((1.0 - outwards) / max(fwidth(outwards), 1e-4) + 0.5, 0.0, 1.0);
}

void main()
{
    vec4 shown = vec4(color.rgb, 1.0);  // a: what of the particle covers this pixel
#if defined(POINTS) || defined(SPRITES)
    vec2 off = gl_FragCoord.xy - pointMiddle;
#endif
#ifdef POINTS
    vec2 at = off * (2.0 / pixels);
    shown.a = clamp((1.0 - length(at)) * 0.5 * pixels + 0.5, 0.0, 1.0);
#else
#ifdef SPRITES
    vec2 at = mat2(toSquare.xy, toSquare.zw) * off;
#endif
#ifdef IMAGE
    vec2 uv = at * 0.5 + 0.5;
    vec4 texel = texture(image, vec3(uv, tiles.x));
    if (FADES) {
        // Mixed by what each covers, so that the colour of what is clear does not count.
        vec4 next = texture(image, vec3(uv, tiles.y));
        vec2 weights = vec2(texel.a * (1.0 - tiles.z), next.a * tiles.z);
        float weight = weights.x + weights.y;
        texel = vec4((texel.rgb * weights.x + next.rgb * weights.y) / max(weight, 1e-6), weight);
    }
    shown *= texel;
    if (BLEND == noneBlend) shown.a = clamp((texel.a - 0.5) / max(fwidth(texel.a), 1e-4) + 0.5, 0.0, 1.0);
#ifdef SPRITES
    shown.a *= insideOf(max(abs(at.x), abs(at.y)));
#endif
#else
    // A dot is a bell-shaped blot without a kink at its rim or, where it is not blended, a disc.
    float r2 = dot(at, at);
    float bell = max(1.0 - r2, 0.0);
    shown.a = BLEND == noneBlend ? insideOf(sqrt(r2)) : bell * bell;
#endif
#endif
    shown.a *= color.a;

#ifdef SOFT
    // gl_FragCoord.w is 1 / depth.
    float behind = nearest / max(1.0 - texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, 1e-9);
    shown.a *= clamp((behind - 1.0 / gl_FragCoord.w) * perSoftness, 0.0, 1.0);
#endif
    if (BLEND == noneBlend ? shown.a < leastCover : shown.a <= 0.0) discard;

#ifndef DEPTH_ONLY
    vec3 light = shown.rgb;
#ifdef LIT
    vec3 ball = vec3(at, sqrt(max(1.0 - dot(at, at), 0.0)));
#ifdef SPRITES
    ball.xy = off * length(toSquare.xy);  // not turned with the picture
#endif
#if defined(POINTS) || defined(SPRITES)
    vec3 n = normalize(viewToScene * ball);
#else
    vec3 n = normalize(frame * ball);
    if (FACING == freeFacing) n = dot(frame[2], place) > 0.0 ? -frame[2] : frame[2];
#endif
    light = shade(surfaceOf(place, n, shown.rgb, 0.9));
#endif

    // Haze veils a particle that hides what is behind it, dims the light of an additive one, and weakens one that
    // filters.
    const bool filters = BLEND == multiplicativeBlend;
    if (isHazy()) {
        if (filters) shown.a *= hazeThrough(place).g;
        else if (BLEND == additiveBlend) light *= hazeThrough(place);
        else light = withHaze(light, place);
    }
    fragment = filters ? vec4(mix(vec3(1.0), light, shown.a), 1.0) : vec4(squeeze(light), shown.a);
#endif
}
