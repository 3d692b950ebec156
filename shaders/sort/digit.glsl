// The digit that a pass of the radix sort sorts by.
uniform int digits;  // how many there are: a power of two
uniform int shift;   // of its lowest bit in the key

uint digitOf(uint key)
{
    return (key >> shift) & uint(digits - 1);
}
