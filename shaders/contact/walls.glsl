// The colliders near a slot's sphere (contact/sphere.glsl), nearest first.
struct Wall {
    vec3 normal;    // unit
    float gap;      // m; 1e30: none is near
    vec3 velocity;  // m/s
    float friction;
};
const int MOST_WALLS = 3;

uniform FLOATS walls;

Wall wallOf(int slot, int k)
{
    int at = 6 * sphereOf(slot) + 2 * k;
    vec4 place = fetch(walls, at);
    vec4 more = fetch(walls, at + 1);
    return Wall(place.xyz, place.w, more.xyz, more.w);
}

bool isNear(Wall wall)
{
    return wall.gap < 1e20;
}
