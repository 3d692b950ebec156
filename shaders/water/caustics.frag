// How many times brighter the light is than under a calm surface: a triangle's area before refraction over its area
// now. Triangles that have folded over one another add up. Set by C++: TEXELS, of the tile's side.

in vec2 before;

out vec4 brightness;

void main()
{
    vec2 dx = dFdx(before), dy = dFdy(before);
    float area = abs(dx.x * dy.y - dx.y * dy.x) * float(TEXELS) * float(TEXELS);
    brightness = vec4(min(area, 20.0));  // the fold itself is infinitely bright
}
