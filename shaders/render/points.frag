// A sprite shaded as the sphere that it stands for. Set by C++: METALLIC, true where it is a mirror.

#include "render/blend.glsl"
#include "render/light.glsl"

in vec3 middle;
flat in vec3 color;

uniform mat3 viewToScene;  // columns: right, up, towards the eye
uniform float pointSize;
uniform float roughness;
uniform float metallic;
uniform float translucency;

out vec4 fragment;

void main()
{
    testDepthLate();
    vec2 point = vec2(gl_PointCoord.x, 1.0 - gl_PointCoord.y) * 2.0 - 1.0;
    float r2 = dot(point, point);
    float edge = sqrt(r2);
    float covered = clamp((1.0 - edge) / max(fwidth(edge), 1e-4) + 0.5, 0.0, 1.0);
    if (covered <= 0.0) discard;
    vec3 n = normalize(viewToScene * vec3(point, sqrt(max(1.0 - r2, 0.0))));
    // Light spreads within the ball: it is shaded as if less of it faced away from the sun.
    n = normalize(mix(n, sunDirection, 0.6 * translucency));

    Surface s = surfaceOf(middle + n * (0.5 * pointSize), n, color, roughness);
    if (METALLIC) s.metallic = metallic;
    fragment = blended(squeeze(withHaze(shade(s), s.place)), color, covered);
}
