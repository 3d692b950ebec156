// Surfaces of colliders at a point: xyz unit normal towards the free side, w signed distance (negative inside).
#include "state/samples.glsl"
#include "physics/collide.glsl"
#include "physics/solid.glsl"

#ifdef CONTACT_RADIUS
// The radius of the sphere around the place that is asked for, m, which rests on surfaces where a collider's thickness is
// less. CONTACT_RADIUS: that of the group's vertices, of a molecule of scale 1; CONTACT_GROWTH: its factors at birth and at
// death.
float contactRadius = 0.0;

// `lived`: which share of its life a molecule has lived.
void takeRadius(float scale, float lived)
{
    float growth = mix(CONTACT_GROWTH.x, CONTACT_GROWTH.y, lived);
    contactRadius = CONTACT_RADIUS * (CONTACT_GROWTH == vec2(1.0) ? scale : scale * growth);
}
#else
const float contactRadius = 0.0;

void takeRadius(float scale, float lived)
{
}
#endif

// The surface that a vertex has struck last in this substep: its normal and friction, and its velocity; w
// negative: none.
vec4 struckLast;
vec3 struckVelocity;

const vec4 noSurface = vec4(0.0, 1.0, 0.0, 1e30);

// origin: of x, relative to a point of the plane; apart, so that its part is the same in every substep.
vec4 planeSurface(vec3 origin, vec3 x, vec3 normal)
{
    return vec4(normal, dot(origin, normal) + dot(x, normal));
}

// Between two quaternions, by the straight way.
vec4 turnAt(vec4 from, vec4 to, float share)
{
    return normalize(mix(from, to, share));
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

// A distance field. x: relative to the first sample, m. last: xyz the last sample's indices, w the least distance on
// the grid's faces, m. Samples: the distances at the four corners of a cell in one layer, layers along z one after
// another (scene/collider.cpp), so that a cell is two fetches that follow one another.
//
// The normal is the gradient of the trilinear distance: exact on flat faces whatever their direction, so that what
// rests there does not jitter. Beyond the grid the distance is a lower bound. Without branches, as in collide.glsl.
vec4 distanceSurface(vec3 x, float cell, vec4 last, int base)
{
    vec3 p = x * (1.0 / cell);
    vec3 inside = clamp(p, vec3(0.0), last.xyz);
    vec3 way = p - inside;
    float wayLength = length(way);
    vec3 corner = min(floor(inside), last.xyz - 1.0);
    vec3 f = inside - corner;
    // whole numbers below 2^24, exact in floats, which a rasteriser on a CPU multiplies faster
    int index = base + int((corner.y * (last.x + 1.0) + corner.x) * (last.z + 1.0) + corner.z);
    vec4 lower = sampleAt(index), upper = sampleAt(index + 1);
    vec4 corners = mix(lower, upper, f.z);
    vec4 climb = upper - lower;
    vec2 alongX = corners.yw - corners.xz;
    vec2 rows = corners.xz + alongX * f.x;
    vec2 climbs = mix(climb.xz, climb.yw, f.x);
    vec3 gradient = vec3(mix(alongX.x, alongX.y, f.y), rows.y - rows.x, mix(climbs.x, climbs.y, f.y)) / cell;
    // where the field is level the way out is away from the middle, else up
    gradient += 1e-7 * (p / last.xyz - 0.5) + vec3(0.0, 1e-12, 0.0);
    bool beyond = wayLength > 0.0;
    return vec4(normalize(beyond ? way : gradient), beyond ? wayLength * cell + last.w : mix(rows.x, rows.y, f.y));
}
