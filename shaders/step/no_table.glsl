// No collider stands in a table (src/compile/collider_table.h).
const bool areTabled = false;
const int turns = 0;
const int mostTurns = 0;
bool nearKnown = false;
vec3 nearPlace;
float nearReach;

void gatherNear(vec3 anchor, vec3 position, float reach)
{
}
