// Where each key begins among sorted pairs: key k has the slots starts[k] to starts[k + 1] - 1. No slot is given out by an
// atomic: the sort is stable, and the first slot of a key writes the starts of all keys since the one before it.
#pragma reads sorted
#pragma writes starts

// Writes the starts that follow from this slot, of `count`; `key` is its own, of `keys`.
void writeStarts(int slot, uint key, int count, int keys)
{
    uint next = slot == 0 ? 0u : sortedAt(slot - 1).x + 1u;
    while (next <= key) {
        putStarts(next, uint(slot));
        ++next;
    }
    uint end = key + 1u;
    while (slot == count - 1 && end <= uint(keys)) {
        putStarts(end, uint(count));
        ++end;
    }
}
