// Variants: TEXTURED (cut out of an image by its alpha), SHADOWS, WATER.

#include "render/blend.glsl"
#include "render/light.glsl"
#ifdef TEXTURED
#include "render/alpha_cut.glsl"
#endif

in vec2 uv;
in vec3 place;
in vec3 normal;
flat in vec3 color;

uniform float roughness;
uniform float translucency;
uniform float metallic;

out vec4 fragment;

void main()
{
    vec3 flatNormal = cross(dFdx(place), dFdy(place));  // before any discard, after which slopes are undefined
    vec3 albedo = color;
    float covered = 1.0;
#ifdef TEXTURED
    vec4 texel = texture(image, uv);
    covered = coverage(keptAlpha(texel.a, uv));
    if (covered <= 0.0) discard;
    albedo *= texel.rgb;
#endif
    // Both sides are drawn; the normal is turned to the one that is seen. Where the vertices' normals cancel,
    // the triangle's own does.
    vec3 n = dot(normal, normal) > 0.01 ? normalize(normal) : normalize(flatNormal + vec3(0.0, 1e-12, 0.0));
#ifdef SKIN_WEIGHTS
    // A skin's normals are smooth: at its rim they lean away from the eye, and are right all the same.
    if (!gl_FrontFacing) n = -n;
#else
    n = towardsEye(n, place, flatNormal);
#endif

    Surface s = surfaceOf(place, n, albedo, roughness);
    s.translucency = translucency;
    // Green tissue lets yellow pass.
    s.throughColor = albedo * vec3(1.7, 1.45, 0.5);
    s.metallic = metallic;
    fragment = blended(squeeze(withHaze(shade(s), place)), albedo, covered);
}
