// One triangle over the whole picture, without a buffer.

out vec2 screen;  // (0,0) lower left to (1,1)

void main()
{
    screen = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    gl_Position = vec4(screen * 2.0 - 1.0, 1.0, 1.0);
}
