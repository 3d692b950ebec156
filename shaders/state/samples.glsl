// Sampled fields: grids and height fields share one table of 4-vectors, read by index: a buffer or, with TEXTURES, a texture.
#if defined(TEXTURES) || defined(LAYERED)
uniform sampler2D samples;

vec4 sampleAt(int index)
{
    return texelFetch(samples, ivec2(index & 1023, index >> 10), 0);
}
#else
uniform samplerBuffer samples;

vec4 sampleAt(int index)
{
    return texelFetch(samples, index);
}
#endif

// fromLow, fromHigh: the anchor, relative to the box's corners, m.
bool insideBox(vec3 fromLow, vec3 fromHigh, vec3 position)
{
    return all(greaterThanEqual(fromLow + position, vec3(0.0))) && all(lessThanEqual(fromHigh + position, vec3(0.0)));
}

// Returns the cell that stands for cell i, which lies at most one outside 0 .. count - 1.
int outsideIndex(int i, int count, bool wrap)
{
    if (!wrap) return clamp(i, 0, count - 1);
    return i < 0 ? i + count : i >= count ? i - count : i;
}

// Returns the velocity, trilinear between cell centres. x: relative to the grid's low corner, m; perMetre: cells per metre.
vec3 gridVelocity(vec3 x, vec3 perMetre, ivec3 resolution, int base, bool wrap)
{
    vec3 p = x * perMetre - 0.5;
    vec3 size = vec3(resolution);
    p = wrap ? p - size * floor(p / size) : clamp(p, vec3(-1.0), size);
    p = min(p, size);  // the remainder of a tiny negative number rounds up to the size
    vec3 corner = floor(p);
    vec3 f = p - corner;
    ivec3 cell = ivec3(corner);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 8; ++i) {
        ivec3 side = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        int cx = outsideIndex(cell.x + side.x, resolution.x, wrap);
        int cy = outsideIndex(cell.y + side.y, resolution.y, wrap);
        int cz = outsideIndex(cell.z + side.z, resolution.z, wrap);
        vec3 w = mix(1.0 - f, f, vec3(side));
        sum += (w.x * w.y * w.z) * sampleAt(base + (cz * resolution.y + cy) * resolution.x + cx).xyz;
    }
    return sum;
}

// Returns the velocity of a sequence of grids that lie behind one another, linear in time. place: the time in frames from the
// first; where the sequence repeats, the first follows the last.
vec3 gridSequenceVelocity(vec3 x, vec3 perMetre, ivec3 resolution, int base, bool wrap, float place, int frames,
                          bool repeats)
{
    float last = float(frames - 1);
    place = repeats ? place - float(frames) * floor(place / float(frames)) : clamp(place, 0.0, last);
    float first = min(floor(place), last);
    int here = int(first);
    int next = here + 1 < frames ? here + 1 : repeats ? 0 : here;
    int cells = resolution.x * resolution.y * resolution.z;
    return mix(gridVelocity(x, perMetre, resolution, base + here * cells, wrap),
               gridVelocity(x, perMetre, resolution, base + next * cells, wrap), place - first);
}

// Returns the place, in frames, `elapsed` s after frame `first` of a sequence of so many a second.
float placeEvenly(float first, float elapsed, float framesPerSecond)
{
    return first + elapsed * framesPerSecond;
}

// Returns the place in a sequence that is not even. Samples base .. base + frames - 1: from each frame to the next,
// from the last to the first where the sequence repeats; period: then of all of it, else 0.
float placeAmong(float first, float elapsed, int base, int frames, float period)
{
    if (period > 0.0) elapsed -= period * floor(elapsed / period);
    int here = int(first);
    float interval = sampleAt(base + here).x;
    for (int passed = 0; passed < frames && elapsed >= interval && (period > 0.0 || here + 1 < frames); ++passed) {
        elapsed -= interval;
        here = here + 1 < frames ? here + 1 : 0;
        interval = sampleAt(base + here).x;
    }
    if (period == 0.0 && here + 1 == frames) return float(here);
    return float(here) + clamp(elapsed / interval, 0.0, 1.0);
}
