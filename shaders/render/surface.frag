// Host models, terrain and colliders. Set by C++, true or false: PLANE, which has no end and fades into the haze instead;
// GRID, of lines every metre on a plane; COLOR_IMAGE, NORMAL_IMAGE, ROUGHNESS_IMAGE, EMISSIVE_IMAGE, of the material
// (geometry/mesh.h); METALLIC, where it is a mirror; GRAINY, where it has grain, and STONY, where that is
// stone's; CUT, out of the colour image by its alpha; REFRACTS, of what is blended.

#include "render/alpha_cut.glsl"
#include "render/glass.glsl"
#include "render/grain.glsl"
#include "render/light.glsl"

in vec2 uv;
in vec3 place;
in vec3 local;
in vec3 normal;
in vec3 color;

uniform vec4 meshColor;  // a opacity
uniform vec3 emissive;
uniform float roughness;
uniform float metallic;
uniform float detail;  // strength of the grain
uniform mat3 meshTurn;
uniform sampler2D normalImage;
uniform float normalScale;
uniform sampler2D roughnessImage;  // g roughness, b metallic
uniform sampler2D emissiveImage;
// Of a plane.
uniform float planeRadius;  // m, where the plane has faded away
uniform vec3 planeAlong;    // two unit directions within the plane
uniform vec3 planeAcross;
uniform vec2 planeOffset;   // of the foot of the eye on the grid, m

out vec4 fragment;

// The normal that an image says, in the frame of its coordinates, which follows from how they change along the
// surface [Schüler 2006].
vec3 mapped(vec3 n, vec3 p, vec2 uv)
{
    vec3 across = cross(dFdy(p), n);
    vec3 along = cross(n, dFdx(p));
    vec2 dx = dFdx(uv);
    vec2 dy = dFdy(uv);
    vec3 tangent = across * dx.x + along * dy.x;
    vec3 bitangent = across * dx.y + along * dy.y;
    float larger = max(dot(tangent, tangent), dot(bitangent, bitangent));
    vec3 slope = texture(normalImage, uv).xyz * 2.0 - 1.0;
    slope.xy *= normalScale * inversesqrt(max(larger, 1e-30));
    return normalize(tangent * slope.x + bitangent * slope.y + n * max(slope.z, 0.05));
}

// How dark the lines of the grid are at a place, of a pixel's width: stronger every ten metres; one pixel soft at every
// distance.
float gridLines(vec2 uv)
{
    vec2 width = max(fwidth(uv), vec2(1e-5));
    vec2 toLine = abs(fract(uv - 0.5) - 0.5);
    vec2 lines = clamp(1.0 - (toLine - 0.008) / width, 0.0, 1.0) * min(0.03 / width, vec2(1.0));
    vec2 toTenth = abs(fract(uv / 10.0 - 0.5) - 0.5) * 10.0;
    vec2 tenths = clamp(1.0 - (toTenth - 0.02) / width, 0.0, 1.0) * min(0.08 / width, vec2(1.0));
    return 1.0 - 0.18 * max(lines.x, lines.y) - 0.22 * max(tenths.x, tenths.y);
}

void main()
{
    testDepthLate();
    vec3 n = towardsEye(normalize(normal), place, cross(dFdx(place), dFdy(place)));
    vec3 albedo = color * meshColor.rgb;
    float covered = meshColor.a;
    if (COLOR_IMAGE) {
        vec4 texel = texture(image, uv);
        albedo *= texel.rgb;
        covered *= texel.a;
        if (CUT) covered = coverage(keptAlpha(covered, uv));
    }
    float hollow = 1.0;
    vec3 along = n;

    if (GRAINY) {
        // Nearly the long side of a pixel's footprint: more of the short one would leave stripes.
        float across = length(dFdx(local)), down = length(dFdy(local)), longer = max(across, down);
        float footprint = longer * sqrt(sqrt(sqrt(min(across, down) / max(longer, 1e-12))));
        Grain grain = STONY ? stoneGrain(local, footprint)
                            : earthGrain(local, smoothstep(0.55, 0.8, n.y), footprint);
        albedo *= max(1.0 + detail * grain.tone, 0.25) * mix(vec3(1.0), grain.tint, detail);
        // The normal of a surface that is raised along n, whose slope is the relief's within the surface.
        vec3 slope = meshTurn * grain.slope;
        along = normalize(n - detail * (slope - n * dot(n, slope)));
        hollow = clamp(mix(1.0, grain.openness, detail), 0.3, 1.0);
    }
    float faded = 0.0;
    if (PLANE) {
        if (GRID) albedo *= gridLines(vec2(dot(place, planeAlong), dot(place, planeAcross)) + planeOffset);
        faded = smoothstep(0.1, 1.0, length(place) / planeRadius);
    }

    float rough = roughness;
    float metal = metallic;
    if (ROUGHNESS_IMAGE) {
        vec4 surface = texture(roughnessImage, uv);
        rough *= surface.g;
        metal *= surface.b;
    }
    if (NORMAL_IMAGE) along = mapped(along, place, uv);
    vec3 sent = emissive;
    if (EMISSIVE_IMAGE) sent *= texture(emissiveImage, uv).rgb;
    if (CUT && covered <= 0.0) discard;  // after all derivatives

    Surface s = surfaceOf(place, n, albedo, rough);
    if (METALLIC) s.metallic = metal;
    s.normal = along;
    s.openness *= hollow;
    vec3 radiance = shade(s) + sent;
    if (REFRACTS) {
        // Opacity is the share of light that the glass itself scatters.
        vec4 glass = throughGlass(s, albedo);
        vec3 sum = covered * radiance + (1.0 - covered) * glass.a * glass.rgb;
        covered += (1.0 - covered) * glass.a;
        radiance = sum / max(covered, 1e-3);
    }
    radiance = withHaze(radiance, place);
    fragment = vec4(squeeze(mix(radiance, farColor(normalize(place)), faded)), covered);
}
