// Where each key begins among sorted pairs: key k has the slots starts[k] to starts[k + 1] - 1. No slot is given out by an
// atomic: the sort is stable, and the first slot of a key writes the starts of all keys since the one before it.
uniform usamplerBuffer sorted;  // x key, y index

layout(std430) writeonly buffer Starts { uint starts[]; };

// Writes what this slot, of `count`, settles; `key` is its own, of `keys`.
void writeStarts(int slot, uint key, int count, int keys)
{
    uint next = slot == 0 ? 0u : texelFetch(sorted, slot - 1).x + 1u;
    while (next <= key) {
        starts[next] = uint(slot);
        ++next;
    }
    uint end = key + 1u;
    while (slot == count - 1 && end <= uint(keys)) {
        starts[end] = uint(count);
        ++end;
    }
}
