// The numbers that members of a school read of one another, in the order of the sorted keys.
#include "school/bodies.glsl"

vec4 placeOf(int body)
{
    vec4 place = bodyElement(body, 0);
    return place.w > 0.0 ? place : vec4(vec3(1e18), 0.0);
}

// xyz velocity, w speed ahead.
vec4 velocityOf(int body)
{
    vec3 velocity = bodyElement(body, 1).xyz;
    return vec4(velocity, dot(velocity, bodyElement(body, 2).xyz));
}
