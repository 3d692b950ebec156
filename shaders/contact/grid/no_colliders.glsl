// Spheres of a group that meets no colliders, or whose colliders another pass looks for.
void putNearColliders(int sphere, StateSphere own, int k)
{
}
