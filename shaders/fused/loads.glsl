// The remembered impulses of contacts with other molecules act on the vertices (contact/response/apply.pass.glsl).
#include "state/numbered.glsl"
#include "contact/rest/states.glsl"

uniform FLOATS contactLoads;  // m/s^2, by sphere; w who moves it (contact/rest/states.glsl)
uniform int firstSphere;      // of the part
vec3 load[VERTICES];          // m/s^2
bool heldByContact = true;    // contact with other molecules answers the colliders as well

#define LOAD(i) load[i]

int vertexOf(int i);

void loadLoads(int molecule)
{
    for (int i = 0; i < VERTICES; ++i) {
        vec4 own = fetch(contactLoads, firstSphere + molecule * SPHERES + vertexOf(i));
        load[i] = own.xyz;
        heldByContact = heldByContact && own.w == HELD_BY_CONTACT;
    }
}

// Who moves the molecule (contact/rest/states.glsl).
float moverOf(int molecule)
{
    return fetch(contactLoads, firstSphere + molecule * SPHERES).w;
}
