// Host models, terrain and colliders. Variants: SHADOWS; PLANE, which has no end and fades into the
// haze instead; COLOR_IMAGE, NORMAL_IMAGE, ROUGHNESS_IMAGE, EMISSIVE_IMAGE, of the material (geometry/mesh.h), and
// IMAGES with any of them; CUT, out of the colour image by its alpha.

#include "physics/noise.glsl"
#include "render/light.glsl"
#ifdef CUT
#include "render/alpha_cut.glsl"
#elif defined(COLOR_IMAGE)
uniform sampler2D image;  // rgb colour, a opacity
#endif
#ifdef NORMAL_IMAGE
uniform sampler2D normalImage;
uniform float normalScale;
#endif
#ifdef ROUGHNESS_IMAGE
uniform sampler2D roughnessImage;  // g roughness, b metallic
#endif
#ifdef EMISSIVE_IMAGE
uniform sampler2D emissiveImage;
#endif
#ifdef IMAGES
in vec2 uv;
#endif

in vec3 place;
in vec3 local;
in vec3 normal;
in vec3 color;

uniform vec4 meshColor;  // a opacity
uniform vec3 emissive;
uniform float roughness;
uniform float metallic;
uniform float detail;  // strength of the procedural grain, 0 for none
#ifdef PLANE
uniform float planeRadius;  // m, where the plane has faded away
uniform vec3 planeAlong;    // two unit directions within the plane
uniform vec3 planeAcross;
uniform vec2 planeOffset;   // of the foot of the eye on the grid, m
uniform bool grid;          // lines every metre
#endif

out vec4 fragment;

// One octave of grain, which fades before it is finer than a pixel.
float grain(vec3 p, vec3 stretch, float wavelength, float footprint, uint seed)
{
    float weight = 1.0 - smoothstep(0.25, 0.8, footprint / wavelength);
    if (weight <= 0.0) return 0.0;
    return weight * gradientNoise(p * stretch / wavelength, 0u, seed);
}

// The normal of a surface raised by `height` along n, without texture coordinates
// [Mikkelsen 2010].
vec3 bumped(vec3 n, vec3 p, float height)
{
    vec3 dx = dFdx(p);
    vec3 dy = dFdy(p);
    vec3 r1 = cross(dy, n);
    vec3 r2 = cross(n, dx);
    float det = dot(dx, r1);
    vec3 gradient = sign(det) * (dFdx(height) * r1 + dFdy(height) * r2);
    return normalize(max(abs(det), 1e-12) * n - gradient);
}

#ifdef NORMAL_IMAGE
// The normal that an image says, in the frame of its coordinates, which follows from how they change along the
// surface [Schüler 2006].
vec3 mapped(vec3 n, vec3 p, vec2 at)
{
    vec3 across = cross(dFdy(p), n);
    vec3 along = cross(n, dFdx(p));
    vec2 dx = dFdx(at);
    vec2 dy = dFdy(at);
    vec3 tangent = across * dx.x + along * dy.x;
    vec3 bitangent = across * dx.y + along * dy.y;
    float larger = max(dot(tangent, tangent), dot(bitangent, bitangent));
    vec3 slope = texture(normalImage, at).xyz * 2.0 - 1.0;
    slope.xy *= normalScale * inversesqrt(max(larger, 1e-30));
    return normalize(tangent * slope.x + bitangent * slope.y + n * max(slope.z, 0.05));
}
#endif

void main()
{
    vec3 n = normalize(normal);
    if (dot(n, place) > 0.0) n = -n;
    vec3 albedo = color * meshColor.rgb;
    float covered = meshColor.a;
#ifdef COLOR_IMAGE
    vec4 texel = texture(image, uv);
    albedo *= texel.rgb;
#ifdef CUT
    covered = coverage(keptAlpha(meshColor.a * texel.a, uv));
#else
    covered *= texel.a;
#endif
#endif
    float hollow = 1.0;
    vec3 along = n;

    // Between the long and the short side of a pixel's footprint: grass seen at a low angle keeps its grain.
    float across = length(dFdx(local)), down = length(dFdy(local));
    float footprint = pow(max(across, down), 0.75) * pow(min(across, down), 0.25);
    if (detail > 0.0) {
        // Ground that faces up is mottled like grass and soil; what stands upright is furrowed like bark.
        float level = smoothstep(0.55, 0.8, n.y);
        vec3 stretch = mix(vec3(1.0, 0.13, 1.0), vec3(1.0), level);
        float patches = grain(local, vec3(1.0), 2.6, footprint, 11u);
        float tufts = grain(local, stretch, mix(0.09, 0.34, level), footprint, 12u);
        float blades = grain(local, stretch, mix(0.035, 0.055, level), footprint, 13u);
        float fine = grain(local, stretch, mix(0.015, 0.018, level), footprint, 14u);
        float furrows = tufts * 0.7 + blades * 0.7 + fine * 0.35;
        float tone = mix(furrows * 0.9, patches * 0.3 + tufts * 0.55 + blades * 0.9 + fine * 0.8, level);
        albedo *= max(1.0 + detail * tone, 0.25);
        albedo *= mix(vec3(1.0), vec3(1.0 + 0.25 * patches, 1.0 + 0.05 * tufts, 1.0 - 0.3 * patches), detail * level);
        float height = mix(furrows * 0.012, tufts * 0.06 + blades * 0.028 + fine * 0.01, level);
        along = bumped(n, local, detail * height);
        hollow = clamp(1.0 + detail * 0.7 * mix(furrows, tufts * 0.5 + blades, level), 0.3, 1.0);
    }
    float faded = 0.0;
#ifdef PLANE
    if (grid) {
        // Stronger every ten metres; one pixel soft at every distance.
        vec2 at = vec2(dot(place, planeAlong), dot(place, planeAcross)) + planeOffset;
        vec2 width = max(fwidth(at), vec2(1e-5));
        vec2 toLine = abs(fract(at - 0.5) - 0.5);
        vec2 lines = clamp(1.0 - (toLine - 0.008) / width, 0.0, 1.0) * min(0.03 / width, vec2(1.0));
        vec2 toTenth = abs(fract(at / 10.0 - 0.5) - 0.5) * 10.0;
        vec2 tenths = clamp(1.0 - (toTenth - 0.02) / width, 0.0, 1.0) * min(0.08 / width, vec2(1.0));
        albedo *= 1.0 - 0.18 * max(lines.x, lines.y) - 0.22 * max(tenths.x, tenths.y);
    }
    faded = smoothstep(0.1, 1.0, length(place) / planeRadius);
#endif

    float rough = roughness;
    float metal = metallic;
#ifdef ROUGHNESS_IMAGE
    vec4 surface = texture(roughnessImage, uv);
    rough *= surface.g;
    metal *= surface.b;
#endif
#ifdef NORMAL_IMAGE
    along = mapped(along, place, uv);
#endif
    vec3 sent = emissive;
#ifdef EMISSIVE_IMAGE
    sent *= texture(emissiveImage, uv).rgb;
#endif
#ifdef CUT
    if (covered <= 0.0) discard;  // after all derivatives
#endif

    Surface s = surfaceOf(place, n, albedo, rough);
    s.metallic = metal;
    s.normal = along;
    s.openness *= hollow;
    vec3 radiance = withHaze(shade(s) + sent, place);
    fragment = vec4(squeeze(mix(radiance, farColor(normalize(place)), faded)), covered);
}
