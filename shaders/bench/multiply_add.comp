// Multiply-adds and nothing else: the arithmetic that a device reaches, 16 ROUNDS operations a lane.
layout(local_size_x = LANES) in;

uniform vec4 factor, addend;

layout(std430) writeonly buffer Result { float result[]; };

void main()
{
    // eight chains that do not wait for one another
    vec4 a = vec4(gl_LocalInvocationID.x) * factor;
    vec4 b = a + addend;
    for (int i = 0; i < ROUNDS; ++i) {
        a = a * factor + addend;
        b = b * factor + addend;
    }
    result[gl_GlobalInvocationID.x] = dot(a + b, vec4(1.0));
}
