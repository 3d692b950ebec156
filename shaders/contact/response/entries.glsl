// A pass in fragments over the entries of lists, some in each draw: it says in makeEntry() what it draws for one.
#include "contact/response/pair.glsl"

void loadOwn(int slot);
void makeEntry(int slot, int e);

void main()
{
    int slot = ownSlot(count);
    int listed = listedOf(slot);
    if (listed <= firstEntry) discard;
    loadOwn(slot);
    for (int i = 0; i < ENTRIES_A_DRAW; ++i)
        if (firstEntry + i < listed) makeEntry(slot, firstEntry + i);
    putEntries();
}
