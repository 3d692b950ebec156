// A particle's pixels. Variants: POINTS, SPRITES, FACING_FREE as in particle.vert; IMAGE and FADES; LIT; SOFT; HAZE;
// BLENDED with one of ADDS and FILTERS or neither (alpha), else cut out; DEPTH_ONLY.

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
#ifndef BLENDED
uniform float leastCover;  // below this a pixel is left out
#endif
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
#ifdef FADES
    // Mixed by what each covers, so that the colour of what is clear does not count.
    vec4 next = texture(image, vec3(uv, tiles.y));
    vec2 weights = vec2(texel.a * (1.0 - tiles.z), next.a * tiles.z);
    float weight = weights.x + weights.y;
    texel = vec4((texel.rgb * weights.x + next.rgb * weights.y) / max(weight, 1e-6), weight);
#endif
    shown *= texel;
#ifndef BLENDED
    shown.a = clamp((texel.a - 0.5) / max(fwidth(texel.a), 1e-4) + 0.5, 0.0, 1.0);
#endif
#ifdef SPRITES
    shown.a *= insideOf(max(abs(at.x), abs(at.y)));
#endif
#else
    // A dot: a bell without a kink at its rim, or where it hides what is behind a disc.
    float r2 = dot(at, at);
#ifdef BLENDED
    float bell = max(1.0 - r2, 0.0);
    shown.a = bell * bell;
#else
    shown.a = insideOf(sqrt(r2));
#endif
#endif
#endif
    shown.a *= color.a;

#ifdef SOFT
    // gl_FragCoord.w is 1 / depth.
    float behind = nearest / max(1.0 - texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, 1e-9);
    shown.a *= clamp((behind - 1.0 / gl_FragCoord.w) * perSoftness, 0.0, 1.0);
#endif
#ifdef BLENDED
    if (shown.a <= 0.0) discard;
#else
    if (shown.a < leastCover) discard;
#endif

#ifndef DEPTH_ONLY
    vec3 light = shown.rgb;
#ifdef LIT
    Surface surface;
    surface.place = place;
#ifdef FACING_FREE
    vec3 n = frame[2];
    if (dot(n, place) > 0.0) n = -n;
#else
    vec3 ball = vec3(at, sqrt(max(1.0 - dot(at, at), 0.0)));
#if defined(POINTS) || defined(SPRITES)
#ifdef SPRITES
    ball.xy = off * length(toSquare.xy);  // not turned with the picture
#endif
    vec3 n = normalize(viewToScene * ball);
#else
    vec3 n = normalize(frame * ball);
#endif
#endif
    surface.normal = n;
    surface.face = n;
    surface.albedo = shown.rgb;
    surface.roughness = 0.9;
    surface.translucency = 0.0;
    surface.throughColor = vec3(0.0);
    surface.openness = crownOpenness(place, n);
    light = shade(surface);
#endif

    // Haze covers what is behind it; it adds nothing to light that is added, and leaves filters less to filter.
#ifdef HAZE
#ifdef FILTERS
    shown.a *= hazeThrough(place).g;
#elif defined(ADDS)
    light *= hazeThrough(place);
#else
    light = withHaze(light, place);
#endif
#endif
#ifdef FILTERS
    fragment = vec4(mix(vec3(1.0), light, shown.a), 1.0);
#else
    fragment = vec4(squeeze(light), shown.a);
#endif
#endif
}
