// Writes alpha 1 where something stands in front of the far plane.

out vec4 fragment;

void main()
{
    fragment = vec4(1.0);
}
