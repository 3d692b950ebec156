// Depth only.

void main()
{
}
