// Lets those impacts happen that both spheres have chosen (choose.pass.glsl beside this file).
const bool isFirst = false;
#pragma updates places sphereMotions impacts impactRounds impactSlots impactGroups choices
#pragma writes nextPlaces nextMotions nextImpacts
#include "contact/response/impact.glsl"

// Whether the choice of a slot is that of the other as well; what nothing moves has none.
bool agrees(int slot, int other, Sphere sphere)
{
    return sphere.weight == 0.0 || choicesAt(other).x == uint(slot);
}

#ifdef TEXTURES
void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    loadSphere(slot);
    Struck next = struckAs(slot);
    uvec2 choice = choicesAt(slot);
    int other = int(choice.x);
    bool any = choice.x != NOBODY;
    Sphere sphere = sphereAt(any ? other : slot);
    if (any && agrees(slot, other, sphere)) {
        PairImpact impact = impactOf(slot, other, sphere);
        next = struckBy(slot, other, impulseOf(impact, sphere), impact.since, choice.y);
    }
    putNextPlaces(slot, next.place);
    putNextMotions(slot, next.motion);
    putAllNextImpacts(slot, next.impacts);
}
#else
#include "contact/response/strike.glsl"

uniform int roundNumber;  // from 1

// Lets a slot, and all that it may touch, choose anew, where that is more than the other that it has met.
void chooseAnew(int slot)
{
    putChoices(slot, uvec2(NOBODY, 0u));
    if (listedOf(slot) < 2) return;
    for (int e = -1; e < listedOf(slot); ++e) {
        int chooser = e < 0 ? slot : int(listsAt(slot, e));
        if (!rests(chooser) && atomicExchange(impactRoundsBuffer[chooser], uint(roundNumber + 1)) == 0u) listSlot(chooser);
    }
}

void main()
{
    if (gl_GlobalInvocationID.x >= impactGroupsBuffer[3]) return;
    int slot = int(impactSlotsAt(ownNumber()));
    uvec2 choice = choicesAt(slot);
    if (choice.x == NOBODY) return;
    int other = int(choice.x);
    loadSphere(slot);
    Sphere sphere = sphereAt(other);
    if (!agrees(slot, other, sphere)) {
        putImpactRounds(slot, uint(roundNumber + 1));
        return;
    }
    if (sphere.weight > 0.0 && slot > other) return;
    strike(slot, other, sphere, choice.y, choicesAt(other).y);
    chooseAnew(slot);
    if (sphere.weight > 0.0) chooseAnew(other);
}
#endif
