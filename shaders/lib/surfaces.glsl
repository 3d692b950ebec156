// Surfaces of colliders at a point: xyz unit normal towards the free side, w signed distance (negative inside).
#include "lib/samples.glsl"
#include "physics/collide.glsl"
#include "physics/solid.glsl"

const vec4 noSurface = vec4(0.0, 1.0, 0.0, 1e30);

// origin: of x, relative to a point of the plane; apart, so that its part is the same in every substep.
vec4 planeSurface(vec3 origin, vec3 x, vec3 normal)
{
    return vec4(normal, dot(origin, normal) + dot(x, normal));
}

vec4 turnedSurface(vec4 q, vec4 surface)
{
    return vec4(turned(q, surface.xyz), surface.w);
}

// x: relative to the first sample's corner at height 0. cells: 1/dx, dx, dz, 1/dz.
// Samples: xyz unit normal, w height. Nothing beyond the outer samples.
vec4 heightSurfaceStored(vec3 x, vec4 cells, ivec2 size, int base)
{
    vec2 p = x.xz * cells.xw;
    if (p.x < 0.0 || p.y < 0.0 || p.x > float(size.x - 1) || p.y > float(size.y - 1)) return noSurface;
    ivec2 cell = min(ivec2(p), size - 2);
    vec2 f = p - vec2(cell);
    int index = base + cell.y * size.x + cell.x;
    vec4 s = mix(mix(sampleAt(index), sampleAt(index + 1), f.x),
                 mix(sampleAt(index + size.x), sampleAt(index + size.x + 1), f.x), f.y);
    vec3 normal = normalize(s.xyz);
    return vec4(normal, (x.y - s.w) * normal.y);
}

float heightAt(vec2 p, ivec2 size, int base)
{
    ivec2 cell = clamp(ivec2(p), ivec2(0), size - 2);
    int index = base + cell.y * size.x + cell.x;
    return bilinear(sampleAt(index).w, sampleAt(index + 1).w, sampleAt(index + size.x).w,
                    sampleAt(index + size.x + 1).w, clamp(p - vec2(cell), 0.0, 1.0));
}

// The normal from three height samples (Latta, section 3.4.2).
vec4 heightSurfaceSampled(vec3 x, vec4 cells, ivec2 size, int base)
{
    vec2 p = x.xz * cells.xw;
    if (p.x < 0.0 || p.y < 0.0 || p.x > float(size.x - 1) || p.y > float(size.y - 1)) return noSurface;
    float here = heightAt(p, size, base);
    // towards the inside at the far border
    vec2 side = vec2(p.x + 1.0 <= float(size.x - 1) ? 1.0 : -1.0, p.y + 1.0 <= float(size.y - 1) ? 1.0 : -1.0);
    float alongX = heightAt(p + vec2(side.x, 0.0), size, base);
    float alongZ = heightAt(p + vec2(0.0, side.y), size, base);
    vec3 normal = normalize(vec3((here - alongX) * side.x * cells.x, 1.0, (here - alongZ) * side.y * cells.w));
    return vec4(normal, (x.y - here) * normal.y);
}
