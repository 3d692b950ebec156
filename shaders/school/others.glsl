// Sums over the members that one of a school sees, and over those that it flees or hunts.

// The slots of three cells of a row: from x up to below y, where those at `slots` and beyond start over.
ivec2 runOf(ivec4 grid, ivec3 cell)
{
    int mask = grid.w - 1;
    int from = (cellKey(cell, grid.w) - 1) & mask;
    int to = from + 3;
    bool over = to > grid.w;
    int first = int(startsAt(grid.z + from));
    int last = int(startsAt(grid.z + (over ? to - grid.w : to)));
    return ivec2(first, over ? last + grid.y : last) - grid.x;
}

ivec3 rowBeside(ivec3 cell, int r)
{
    return cell + ivec3(0, r % 3 - 1, r / 3 - 1);
}

// Sums over the others that it sees.
struct Others {
    vec3 apart;
    vec4 velocity;
    vec3 place;  // relative to it, m
    float count;
};

Others lookAround(vec3 place, vec3 forward, int slot)
{
    Others sum = Others(vec3(0.0), vec4(0.0), vec3(0.0), 0.0);
    float inverseCell = min(gridRules[0].x, 3.4e38);
    float radius = min(gridRules[0].y, 3.4e38);
    float keep = min(others.x, 3.4e38);
    float blind = min(blindCosine, 3.4e38);
    ivec3 cell = cellOf(place, inverseCell);
    for (int r = 0; r < 9; ++r) {
        ivec3 row = rowBeside(cell, r);
        ivec2 run = runOf(grids[0], row);
        for (int i = run.x; i < run.y; ++i) {
            int entry = grids[0].x + (i < grids[0].y ? i : i - grids[0].y);
            vec3 other = placesAt(entry).xyz;
            vec3 d = other - place;
            bool met = dot(d, d) < radius * radius && entry != slot && cellOf(other, inverseCell).yz == row.yz &&
                       isSeen(d, forward, blind);
            float share = met ? 1.0 : 0.0;
            sum.apart -= awayFrom(d, keep) * share;
            sum.velocity += velocitiesAt(entry) * share;
            sum.place += met ? d : vec3(0.0);
            sum.count += share;
        }
    }
    return sum;
}

// The most members of a run that are looked at, spread evenly over it. Each counts for those that it stands for.
const int mostOfRun = 48;

// Returns the acceleration towards those that are hunted and away from those that are fled from.
vec3 meetTargets(vec3 place)
{
    vec3 a = vec3(0.0);
    for (int t = 1; t <= TARGETS; ++t) {
        vec3 sum = vec3(0.0);
        float weight = 0.0;
        float radius = gridRules[t].y;
        ivec3 cell = cellOf(place, gridRules[t].x);
        for (int r = 0; r < 9; ++r) {
            ivec3 row = rowBeside(cell, r);
            ivec2 run = runOf(grids[t], row);
            int stride = 1 + (run.y - run.x) / mostOfRun;
            for (int i = run.x; i < run.y; i += stride) {
                int entry = grids[t].x + (i < grids[t].y ? i : i - grids[t].y);
                vec3 other = placesAt(entry).xyz;
                vec3 d = other - place;
                bool met = dot(d, d) < radius * radius && cellOf(other, gridRules[t].x).yz == row.yz;
                float share = met ? float(stride) : 0.0;
                sum += met ? awayFrom(d, radius) * share : vec3(0.0);
                weight += share * max(1.0 - length(met ? d : vec3(radius)) / radius, 0.0);
            }
        }
        // A fleeing member turns away from each enemy. A hunting one goes for the middle of its prey, weighted towards
        // the near ones.
        float strength = gridRules[t].z;
        a += sum * (strength < 0.0 ? strength : strength / max(weight, 1e-6));
    }
    return a;
}
