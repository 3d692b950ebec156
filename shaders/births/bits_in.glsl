// Returns how many bits are set in each word.
ivec4 bitsIn(uvec4 words)
{
    words -= (words >> 1u) & 0x55555555u;
    words = (words & 0x33333333u) + ((words >> 2u) & 0x33333333u);
    return ivec4((((words + (words >> 4u)) & 0x0f0f0f0fu) * 0x01010101u) >> 24u);
}
