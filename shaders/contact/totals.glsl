// The totals of a slot, two texels or with TEXTURES two layers:
//   impulse  N s, what its contacts exchange beside what they remember; with TEXTURES in w what colliders pushed at first, N s
//   shift    kg m, what pushes apart what overlaps; in w 1: more or less pushes on a sphere at rest than when it came to rest
// or, as contact/spread.glsl works them out where one sphere's contacts move others, what these make of it: its velocity, m/s,
// and its move, m.
#ifdef TEXTURES
#define TOTALS sampler2DArray
#define firstTotal(totals, slot) texelFetch(totals, ivec3(texelOf(slot), 0), 0).xyz
#define secondTotal(totals, slot) texelFetch(totals, ivec3(texelOf(slot), 1), 0).xyz
#else
#define TOTALS samplerBuffer
#define firstTotal(totals, slot) texelFetch(totals, 2 * (slot)).xyz
#define secondTotal(totals, slot) texelFetch(totals, 2 * (slot) + 1).xyz
#endif
