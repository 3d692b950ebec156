// Two triangles over the rows of places that a step has to reach: one past the last that is taken, or was one step before,
// on the other side of the state.
#include "births/words.glsl"

uniform usampler2D control;
uniform int controlBase;
uniform int stateRows;

void main()
{
    uint mark = max(wordOfControl(control, controlBase + controlMark), wordOfControl(control, controlBase + controlMarkBefore));
    int rows = min((int(mark) + STATE_WIDTH - 1) / STATE_WIDTH, stateRows);
    int corner = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2;  // of 4, and those of the second triangle
    vec2 place = vec2(float(corner & 1), float(corner >> 1) * float(rows) / float(stateRows));
    gl_Position = vec4(2.0 * place - 1.0, 0.0, 1.0);
}
