// Set by C++: TEXTURED, true where a molecule is cut out of an image by its alpha; SKIN_WEIGHTS, 0 where it has no skin;
// METALLIC, true where it is a mirror.

#include "render/alpha_cut.glsl"
#include "render/blend.glsl"
#include "render/light.glsl"

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
    testDepthLate();
    vec3 flatNormal = cross(dFdx(place), dFdy(place));  // before any discard, after which slopes are undefined
    vec3 albedo = color;
    float covered = 1.0;
    if (TEXTURED) {
        vec4 texel = texture(image, uv);
        covered = coverage(keptAlpha(texel.a, uv));
        if (covered <= 0.0) discard;
        albedo *= texel.rgb;
    }
    // Both sides are drawn; the normal is turned to the one that is seen. Where the vertices' normals cancel,
    // the triangle's own does.
    vec3 n = dot(normal, normal) > 0.01 ? normalize(normal) : normalize(flatNormal + vec3(0.0, 1e-12, 0.0));
    if (SKIN_WEIGHTS == 0) n = towardsEye(n, place, flatNormal);
    // A skin's normals are smooth: at its rim they lean away from the eye, and are right all the same.
    else if (!gl_FrontFacing) n = -n;

    Surface s = surfaceOf(place, n, albedo, roughness);
    s.translucency = translucency;
    // Green tissue lets yellow pass.
    s.throughColor = albedo * vec3(1.7, 1.45, 0.5);
    if (METALLIC) s.metallic = metallic;
    fragment = blended(squeeze(withHaze(shade(s), place)), albedo, covered);
}
