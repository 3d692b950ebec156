// The surface seen from below: within Snell's window the sky, around it the water mirrored. Needs water/medium.glsl.

#include "water/waves.glsl"

const float waterIndex = 1.333;  // of refraction

vec3 fromBelow(vec3 direction)
{
    if (direction.y <= 0.01) return scatteredFrom(eyeDepth, direction, 1e4);
    float way = eyeDepth / direction.y;
    vec2 point = causticsAt.zw + causticsAt.y * direction.xz * way;
    // Waves that are seen from far or at a low angle are finer than a pixel: the surface is flat there.
    float rough = 2.2 / (1.0 + 0.0025 * way * way);
    vec2 slope = rough * rippledSlope(point);
    vec3 normal = normalize(vec3(-slope.x, 1.0, -slope.y));

    float cosine = clamp(dot(direction, normal), 0.0, 1.0);
    float left = 1.0 - waterIndex * waterIndex * (1.0 - cosine * cosine);  // cosine in the air, squared
    vec3 mirror = reflect(direction, -normal);
    mirror = normalize(vec3(mirror.x, -abs(mirror.y), mirror.z));
    vec3 seen = scatteredFrom(0.0, mirror, 1e4);
    if (left > 0.0) {
        float inAir = sqrt(left);
        vec3 air = waterIndex * direction + (inAir - waterIndex * cosine) * normal;
        // Fresnel's equations, the mean of both polarisations.
        float s = (waterIndex * cosine - inAir) / (waterIndex * cosine + inAir);
        float p = (waterIndex * inAir - cosine) / (waterIndex * inAir + cosine);
        float reflected = 0.5 * (s * s + p * p);
        // The light's direction is that in the water; waves spread the sun's disc.
        vec3 bent = normalize(direction + 0.6 * (vec3(0.0, 1.0, 0.0) - normal));
        float towards = max(dot(bent, sunDirection), 0.0);
        float power2 = towards * towards;
        float power4 = power2 * power2;
        float power8 = power4 * power4;
        vec3 sun = sunColor * (0.9 * power8 * power8 * power8 + 9.0 * smoothstep(0.9965, 0.9995, towards));
        vec3 sky = skyGradient(normalize(air)) * 1.1 + sun;
        seen = mix(sky, seen, reflected);
    }
    return seen * exp(-waterExtinction * way) + scatteredFrom(eyeDepth, direction, way);
}
