// The collider nearest to a slot's sphere: xyz unit normal, w the centre's distance from its surface, m; 1e30: none is near.
// `walls`: by sphere, or with TEXTURES by slot.
uniform FLOATS walls;

vec4 wallOf(int slot)
{
#ifdef TEXTURES
    return fetch(walls, slot);
#else
    return fetch(walls, sphereOf(slot));
#endif
}

bool isNear(vec4 wall)
{
    return wall.w < 1e20;
}
