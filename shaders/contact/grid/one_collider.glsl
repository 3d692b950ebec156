// The nearest place of the scene's collider.
NearCollider[MOST_COLLIDERS] nearColliders(StateSphere own, int k)
{
    NearCollider near[MOST_COLLIDERS] = noneNear();
    vec4 surface = surfaceAt(own.anchor, own.position);
    if (surface.w < reachOf(own))
        near[0] = NearCollider(surface.xyz, max(surface.w, leastGap(k)), vec3(0.0), colliderParameters[0].y);
    return near;
}
