// Glass is drawn as a plate of even thickness, which light leaves in the direction in which it came, moved sideways.
// Nothing that is blended is seen displaced through it.
#include "render/light.glsl"

uniform sampler2D lightBehind;  // of all that is not blended
uniform sampler2D sceneDepth;   // 1 - nearest / depth
uniform float nearest;          // m
uniform mat3 viewToScene;       // columns: right, up, towards the eye
uniform vec2 tangents;          // of half the field of view
uniform float refraction;       // index
uniform float plate;            // m, its thickness

float depthBehind(vec2 uv)
{
    return nearest / max(1.0 - texture(sceneDepth, uv).r, 1e-6);
}

// Returns where in the picture a place lies, relative to the eye.
vec2 inPicture(vec3 place)
{
    vec3 seen = place * viewToScene;
    return 0.5 + 0.5 * seen.xy / (-seen.z * tangents);
}

// The light that reaches the eye from a place of the plate, and in a the share of the picture behind it that this covers.
// `tint`: what a plate seen head on lets through.
vec4 throughGlass(Surface s, vec3 tint)
{
    vec3 along = normalize(s.place);
    float facing = max(-dot(along, s.normal), 0.02);
    vec3 within = refract(along, s.normal, 1.0 / refraction);
    float steep = max(-dot(within, s.normal), 0.1);
    vec3 exit = within * (plate / steep);
    vec3 aside = exit - along * dot(exit, along);

    vec2 straight = inPicture(s.place);
    float forward = dot(along, -viewToScene[2]);
    vec3 behind = along * (min(depthBehind(straight), 1e4) / forward);
    vec2 bent = inPicture(behind + aside);
    // A thing before the plate is not seen through it.
    float ahead = dot(s.place, -viewToScene[2]);
    if (depthBehind(bent) < ahead) bent = straight;

    float head = (refraction - 1.0) / (refraction + 1.0);
    float mirror = head * head + (1.0 - head * head) * pow(1.0 - facing, 5.0);
    vec3 passed = pow(tint, vec3(1.0 / steep)) * (1.0 - mirror);
    vec3 mirrored = mirror * mirroredFrom(s.place, reflect(along, s.normal), 0.1);
    // Where the plate displaces nothing, the picture behind shows through. Elsewhere the plate covers it with the
    // displaced picture.
    float moved = smoothstep(0.3, 2.5, length((bent - straight) * vec2(textureSize(lightBehind, 0))));
    float covered = mix(1.0 - passed.g, 1.0, moved);
    vec3 light = mirrored + moved * passed * unsqueeze(texture(lightBehind, bent).rgb);
    return vec4(light / max(covered, 1e-3), covered);
}
