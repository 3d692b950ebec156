// Radix sort by pieces: adds up along each digit's row of counts, a lane a digit. Each count becomes the sum of those
// before it; the whole row's goes into totals.
layout(local_size_x = LANES) in;

uniform int digits, parts;

layout(std430) buffer Counts { uint counts[]; };
layout(std430) writeonly buffer Totals { uint totals[]; };

void main()
{
    int digit = int(gl_GlobalInvocationID.x);
    if (digit >= digits) return;
    uint sum = 0u;
    for (int i = digit * parts; i < (digit + 1) * parts; ++i) {
        uint here = counts[i];
        counts[i] = sum;
        sum += here;
    }
    totals[digit] = sum;
}
