// find: all spheres that a slot touches.
#include "contact/search.glsl"
#include "contact/found.glsl"
