// No contact with other molecules acts on the vertices (fused/loads.glsl).
#include "contact/rest/states.glsl"
const bool heldByContact = false;

#define LOAD(i) vec3(0.0)

void loadLoads(int molecule)
{
}

float moverOf(int molecule)
{
    return AWAKE;
}
