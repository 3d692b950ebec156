// Those of the scene's colliders that sphere k of its molecule may press on, the nearest first.
NearCollider[MOST_COLLIDERS] nearColliders(StateSphere own, int k)
{
    NearCollider near[MOST_COLLIDERS] = noneNear();
    float reach = reachOf(own);
    ivec3 skip = ivec3(-1);
    waySquared = 0.0;  // distances as they are
    for (int w = 0; w < MOST_COLLIDERS; ++w) {
        Touch t = survey(own.anchor, own.position, own.velocity, contactStep, skip).swept;
        if (t.which < 0 || t.distance >= reach) break;
        near[w] = NearCollider(t.normal, max(t.distance, leastGap(k)), t.velocity, materialOf(t).y);
        skip = ivec3(skip.y, t.which, -1);
    }
    return near;
}
