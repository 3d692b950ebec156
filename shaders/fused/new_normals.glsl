// The buffer of the normals.
#include "state/stored.glsl"

layout(std430) writeonly buffer NewNormals { ELEMENT newNormals[]; };
