// The vertices of molecules in the state's buffer, as contact changes them.
#include "contact/grid/shape.glsl"

layout(std430) buffer State { float state[]; };

// Returns the vector of a vertex that lies `begin` 4-vectors behind the first of its molecule: 0 for its position, POSITION_ELEMENTS
// for its velocity.
vec3 stateVector(int first, int begin, int vertex)
{
    int behind = first + begin * BLOCK;
    return vec3(state[floatIndex(behind, 3 * vertex)], state[floatIndex(behind, 3 * vertex + 1)],
                state[floatIndex(behind, 3 * vertex + 2)]);
}

void setStateVector(int first, int begin, int vertex, vec3 value)
{
    for (int c = 0; c < 3; ++c) state[floatIndex(first + begin * BLOCK, 3 * vertex + c)] = value[c];
}

// Sets the velocity and the solver's history, with which a vertex goes on as if it had moved by `step` in the last substep, m, or
// begins anew (fused/bdf2.glsl).
void setMotion(int first, int vertex, vec3 velocity, bool goesOn, vec3 step)
{
    setStateVector(first, POSITION_ELEMENTS, vertex, velocity);
#ifdef HISTORY
    setStateVector(first, 2 * POSITION_ELEMENTS, vertex, goesOn ? step : vec3(NO_HISTORY, 0.0, 0.0));
    setStateVector(first, 3 * POSITION_ELEMENTS, vertex, vec3(0.0));
#endif
}
