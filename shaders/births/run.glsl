// Which emitter makes a newborn, and when.
#ifdef DEATH_RUNS
// Returns the molecule, in the part of its group's state, whose death emits newborn j of a run; -1: another dispatch reads it.
int sourceOf(int run, int j)
{
    int molecule = int(deathsAt(deathRuns[run].z + j / deathRuns[run].y));
#ifndef LAYERED
    molecule -= sourcePlaces[run].x;
    if (molecule < 0 || molecule >= sourcePlaces[run].y) return -1;
#endif
    return molecule;
}
#endif

// Returns the emitter of newborn i, or -1 where another dispatch makes it, and sets its seed, the molecule whose death emits
// it, if one does, and its birth in s from the frame's start.
int findRun(int i, out Source source, out float birthTime)
{
    source = Source(0, 0.0);
#ifdef DEATH_RUNS
    int run = -1;
    for (int d = 0; d < DEATH_RUNS; ++d) {
        if (i >= controlWord(controlFirsts + d)) run = d;
    }
    if (run >= 0) {
        ivec4 from = deathRuns[run];
        int j = i - controlWord(controlFirsts + run);
        source.molecule = sourceOf(run, j);
        if (source.molecule < 0) return -1;
        float label;
        readDeath(from.x, source.molecule, label, source.since);
        source.since = min(source.since, frameDuration);
        seed = hashSeed(hashSeed(uint(abs(label)) ^ uint(groupSeed), uint(from.x)), uint(j % from.y)) >> 8u;
        birthTime = frameDuration - source.since;
        return from.x;
    }
#endif
    int r = 0;
    for (int k = 1; k < RUNS; ++k) {
        if (k < runCount && i >= runs[k].x) r = k;
    }
    int j = i - runs[r].x;
    seed = hashSeed(hashSeed(uint(groupSeed), uint(runs[r].y)), uint(runs[r].z) + uint(j)) >> 8u;
    float moment = runs[r].w > 0 ? float(j / max(runs[r].w, 1)) : drawn(seed, bornTime);
    birthTime = clamp(runTimes[r].x + runTimes[r].y * moment, 0.0, frameDuration);
    return runs[r].y;
}
