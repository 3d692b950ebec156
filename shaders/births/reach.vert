// Two triangles over the rows of places that a step in fragments has to reach: one past the last that is taken, or was one
// step before, on the other side of the state.
#include "births/control.glsl"

uniform usampler2DArray control;  // a texel a group (births/arrays.txt)
uniform int group;
uniform int stateRows;

int wordOf(int which)
{
    return int(texelFetch(control, ivec3(group % STATE_WIDTH, group / STATE_WIDTH, which / 4), 0)[which % 4]);
}

void main()
{
    int mark = max(wordOf(controlMark), wordOf(controlMarkBefore));
    int rows = min((mark + STATE_WIDTH - 1) / STATE_WIDTH, stateRows);
    int corner = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2;  // of 4, and those of the second triangle
    vec2 place = vec2(float(corner & 1), float(corner >> 1) * float(rows) / float(stateRows));
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
