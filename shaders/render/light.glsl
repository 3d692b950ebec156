// Light on a surface: the sun through its shadow map, the sky all around, light through thin things, haze.
// Places are relative to the eye, in the scene's directions. With WATER all below its surface is under water. Set by C++,
// true or false: SHADOWS, which the sun casts, and WIDE_SHADOWS, beyond the molecules too. With GATHERS four texels of a shadow
// map are read at once.

#include "render/sky.glsl"
#include "render/tone.glsl"

// Where leaves are dense they hide the sky. The crown is a sphere around the molecules that are placed
// densely on a model; the sky that it hides is found in closed form. A radius of 0 switches it off.
uniform vec4 crown;  // xyz middle, w radius, m

// To be called first. With several samples a pixel Mesa's CPU rasteriser shades eight pixels at once even where none is
// covered, unless depth is tested after the shader, as it is where that writes a stencil value. There is no stencil.
void testDepthLate()
{
#ifdef LATE_DEPTH
    gl_FragStencilRefARB = 0;
#endif
}

struct Surface {
    vec3 place;          // m, relative to the eye
    vec3 normal;         // unit, on the side that is seen
    vec3 face;           // the same without bumps: what shadows fall on
    vec3 albedo;         // linear RGB
    float roughness;     // in [0, 1]
    float translucency;  // share of the light on the other side that comes through
    vec3 throughColor;   // colour of that light
    float openness;      // share of the sky that reaches it, in [0, 1]
    float metallic;      // share of a mirror, in [0, 1]
};

#ifdef WATER
#include "water/medium.glsl"
#else
#include "render/air.glsl"
#endif

uniform sampler2DShadow shadowMap;
uniform mat4 toShadow;       // place -> texel and depth
uniform vec2 shadowOffsets;  // m, along the normal and towards the sun
// A second map, of what stands still, beyond the first one. That begins at texel 0 and has `nearTexels` a side.
uniform float nearTexels;
uniform vec3 wideShadowScale, wideShadowStart;  // from texel and depth in the first map to those in the second
uniform vec2 wideShadowOffsets;
uniform vec4 wideBounds;  // texels between which places are looked up; beyond its edge all is lit

// Share of the sun that is seen: the mean of 3 x 3 bilinear comparisons a texel apart, which are 16 texels.
float sunVisibility(vec3 place, vec3 normal)
{
    if (!SHADOWS) return 1.0;
    vec3 spot = (toShadow * vec4(place, 1.0)).xyz;
    bool wide = WIDE_SHADOWS && max(abs(spot.x - 0.5 * nearTexels), abs(spot.y - 0.5 * nearTexels)) > 0.49 * nearTexels;
    vec2 offsets = wide ? wideShadowOffsets : shadowOffsets;
    // A surface seen at a grazing angle spans more depth within one texel: shift it more.
    float facing = dot(normal, sunDirection);
    float slope = sqrt(max(1.0 - facing * facing, 0.0));
    vec3 shift = normal * (sign(facing) * offsets.x * (0.4 + slope)) + sunDirection * offsets.y;
    spot += mat3(toShadow) * shift;
    if (wide) {
        spot = spot * wideShadowScale + wideShadowStart;
        spot.xy = clamp(spot.xy, wideBounds.xy, wideBounds.zw);
    }
    spot.z = min(spot.z, 1.0);  // below the map's far end: shaded by whatever the map holds
    vec2 texel = 1.0 / vec2(textureSize(shadowMap, 0));
    float lit = 0.0;
#ifdef GATHERS
    vec2 share = fract(spot.xy - 0.5);
    vec2 corner = spot.xy - (share - 0.5);  // between four texels, the middle ones of 16
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        vec2 outer = mix(1.0 - share, share, vec2(side));  // of the texels at the rim
        vec2 low = mix(outer, vec2(1.0), vec2(side));
        vec2 high = mix(vec2(1.0), outer, vec2(side));
        vec4 seen = textureGather(shadowMap, texel * (corner + vec2(2 * side - 1)), spot.z);
        lit += low.y * (low.x * seen.w + high.x * seen.z) + high.y * (low.x * seen.x + high.x * seen.y);
    }
#else
    for (int i = 0; i < 9; ++i) lit += texture(shadowMap, vec3(texel * (spot.xy + vec2(i % 3 - 1, i / 3 - 1)), spot.z));
#endif
    return lit / 9.0;
}

// Share of the sky left over by the crown: outside of it, what a sphere hides under a cosine lobe; inside,
// less and less towards the middle. Both agree at its edge.
float crownOpenness(vec3 place, vec3 normal)
{
    if (crown.w <= 0.0) return 1.0;
    vec3 towards = crown.xyz - place;
    float distance = max(length(towards), 1e-3);
    float relative = crown.w / distance;  // 1 at the edge, below 1 outside
    float hidden = 0.6 * (0.5 + 0.5 * dot(normal, towards / distance));
    if (relative < 1.0) return 1.0 - hidden * relative * relative;
    return mix(0.25, 1.0 - hidden, 1.0 / (relative * relative));
}

// Distribution and visibility of GGX in the approximation of [Karis 2013],
// for a dielectric that reflects 4 % head on.
float sheen(vec3 normal, vec3 toEye, float roughness)
{
    vec3 halfway = normalize(sunDirection + toEye);
    float a = max(roughness * roughness, 0.02);
    float a2 = a * a;
    float nh = max(dot(normal, halfway), 0.0);
    float lh = max(dot(sunDirection, halfway), 0.05);
    float d = nh * nh * (a2 - 1.0) + 1.0;
    // Rough surfaces shadow their own grazing reflections [Lagarde 2011].
    float grazing = (1.0 - lh) * (1.0 - lh);
    float fresnel = 0.04 + max(0.96 - roughness, 0.0) * grazing * grazing * (1.0 - lh);
    return fresnel * a2 / (4.0 * d * d * lh * lh * (roughness + 0.5));
}

// As sheen(), for a mirror that reflects all.
float lobe(vec3 normal, vec3 toEye, float roughness)
{
    vec3 halfway = normalize(sunDirection + toEye);
    float a = max(roughness * roughness, 0.02);
    float nh = max(dot(normal, halfway), 0.0);
    float lh = max(dot(sunDirection, halfway), 0.05);
    float d = nh * nh * (a * a - 1.0) + 1.0;
    return a * a / (4.0 * d * d * lh * lh * (roughness + 0.5));
}

// The normal of the side that is seen, of a triangle that is drawn from both. A smooth normal may lean away from the eye
// at a rim: the triangle's own, `flatNormal`, of either sign, says which side it is.
vec3 towardsEye(vec3 normal, vec3 place, vec3 flatNormal)
{
    return dot(normal, flatNormal) * dot(flatNormal, place) > 0.0 ? -normal : normal;
}

// Neither translucent nor a mirror.
Surface surfaceOf(vec3 place, vec3 normal, vec3 albedo, float roughness)
{
    float openness = crownOpenness(place, normal);
    return Surface(place, normal, normal, albedo, roughness, 0.0, vec3(0.0), openness, 0.0);
}

vec3 shade(Surface s)
{
    vec3 toEye = -normalize(s.place);
    float facing = dot(s.normal, sunDirection);
    bool sunlit = facing > 0.0 || s.translucency > 0.0;
    float visible = sunlit ? sunVisibility(s.place, s.face) : 0.0;

    vec3 sunlight = sunlightAt(s.place);
    vec3 radiance = s.albedo * ambientAt(s.place, s.normal) * s.openness;
    float front = max(facing, 0.0);
    radiance += visible * sunlight * front * (s.albedo + vec3(sheen(s.normal, toEye, s.roughness)));
    if (s.translucency > 0.0) {
        // Light from behind spreads inside a leaf: it wraps around, and glows most towards the sun.
        float behind = max(0.15 - facing, 0.0) / 1.15;
        float towards = max(-dot(toEye, sunDirection), 0.0);
        float glow = 0.75 + 0.9 * towards * towards * towards;
        radiance += visible * s.translucency * s.throughColor * sunlight * behind * glow;
        radiance += s.translucency * s.throughColor * ambientAt(s.place, -s.normal) * s.openness * 0.5;
    }
    if (s.metallic > 0.0) {
        // A mirror's picture of what is around it, and the sun's in it.
        vec3 mirrored = mirroredFrom(s.place, reflect(-toEye, s.normal), s.roughness) * s.openness;
        mirrored += visible * sunlight * front * lobe(s.normal, toEye, s.roughness);
        radiance = mix(radiance, s.albedo * mirrored, s.metallic);
    }
    return radiance;
}
