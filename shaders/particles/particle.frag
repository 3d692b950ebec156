// A particle's pixels. What C++ sets is in particles/kinds.glsl. What is not blended is cut out.

#include "particles/cover.glsl"
#include "render/light.glsl"

in vec3 place;
flat in mat3 frame;  // of quads

uniform mat3 viewToScene;
uniform sampler2D sceneDepth;  // 1 - nearest / depth
uniform float nearest;         // m
uniform float perSoftness;     // 1/m

out vec4 fragment;

// Returns the normal of a ball, but for a particle of free facing, which is a flat sheet.
vec3 normalAt(vec2 point)
{
    if (FACING == freeFacing) return dot(frame[2], place) > 0.0 ? -frame[2] : frame[2];
    vec3 ball = vec3(point, sqrt(max(1.0 - dot(point, point), 0.0)));
    if (SHAPE == quadsShape) return normalize(frame * ball);
    if (SHAPE == spritesShape) ball.xy = offMiddle() * length(toSquare.xy);  // not turned with the picture
    return normalize(viewToScene * ball);
}

void main()
{
    testDepthLate();
    vec2 point = inSquare();
    vec4 shown = shownAt(point);
    if (SOFT) {
        // gl_FragCoord.w is 1 / depth.
        float behind = nearest / max(1.0 - texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, 1e-9);
        shown.a *= clamp((behind - 1.0 / gl_FragCoord.w) * perSoftness, 0.0, 1.0);
    }
    if (BLEND == noneBlend ? shown.a < leastCover : shown.a <= 0.0) discard;

    vec3 light = shown.rgb;
    if (LIT) light = shade(surfaceOf(place, normalAt(point), shown.rgb, 0.9));

    // Haze veils a particle that hides what is behind it, dims the light of an additive one, and weakens one that
    // filters.
    const bool filters = BLEND == multiplicativeBlend;
    if (isHazy()) {
        if (filters) shown.a *= hazeThrough(place).g;
        else if (BLEND == additiveBlend) light *= hazeThrough(place);
        else light = withHaze(light, place);
    }
    fragment = filters ? vec4(mix(vec3(1.0), light, shown.a), 1.0) : vec4(squeeze(light), shown.a);
}
