// A particle, or a corner of it, straight from the state; everything that depends on its age and its seed is worked out
// here. The middle of a picture's square is (0, 0), its corners are at +-1.
//
//   POINTS   a dot of `pixels`
//   SPRITES  a point as wide as the turned square, which the fragment stage cuts out of it [Latta 2004, section 3.4.6]
//   else     gl_VertexID: 4 corners of a quad, that of many [Kapoulkine 2008]
//
// Variants, each only where the type needs it: SIZES (random), GROWS, TURNS (about the line of sight, or free quads
// about their axis), COLORS (keyframes), IMAGE, LIT; and those of state/molecule.glsl and render/drawn.glsl. An instance is a
// BATCH of particles of CORNERS vertices each. The values of FACING, TILES and FADES are in particles/kinds.glsl.

#include "state/molecule.glsl"
#include "render/drawn.glsl"
#include "render/blend.glsl"
#include "particles/attributes.glsl"
#include "particles/kinds.glsl"
#ifdef COLOR_BY
#include "render/color_scale.glsl"
#endif

uniform mat4 toClip;
uniform mat3 viewToScene;      // columns: right, up, towards the eye
uniform vec4 eyeAt;            // w 1: xyz the eye, m; w 0: xyz the direction towards it
uniform vec2 pictureSize;      // pixels
uniform float pixelsPerMeter;  // at a distance of one metre, or everywhere in the shadow map
uniform uint timeBlocks;       // of 64 s
uniform float time;            // s, since the last of them
uniform int drawnCount;        // particles; the last instance may be left with fewer

#ifdef POINTS
uniform float pixels;
#else
uniform vec2 sizeSpan;  // m
#endif
#ifdef GROWS
uniform vec2 growth;
#endif
#ifdef TURNS
uniform vec2 turnSpan, spinSpan;  // rad, rad/s
#endif
uniform float stretch;    // s, of what faces along its velocity
uniform vec4 firstColor;  // linear RGB and opacity
#ifdef COLORS
uniform vec4 colorChanges[3];
uniform vec3 colorBegins, colorPerAge;
#endif
#ifdef IMAGE
uniform float tileCount;
uniform float frameRate;
uniform float flipTime;  // s, less whole flip-books
#endif

flat out vec4 color;
out vec3 place;  // m, relative to the origin of drawing
#if defined(POINTS) || defined(SPRITES)
// Not gl_PointCoord: rasterisers are free to be half a pixel off.
flat out vec2 pointMiddle;  // pixels
#endif
#ifdef SPRITES
flat out vec4 toSquare;  // matrix by columns: from pixels off the middle to the particle's square
#endif
#if !defined(POINTS) && !defined(SPRITES)
out vec2 at;
#endif
#ifdef IMAGE
flat out vec3 tiles;  // x one, y the next one, z its share
#endif
#if defined(LIT) && !defined(POINTS) && !defined(SPRITES)
flat out mat3 frame;  // columns: right, up, towards the eye
#endif

// Smaller ones would come and go between the samples of a pixel.
const float leastPixels = 1.5;

vec3 unitOr(vec3 v, vec3 otherwise)
{
    float lengthSquared = dot(v, v);
    return lengthSquared > 1e-20 ? v * inversesqrt(lengthSquared) : otherwise;
}

void main()
{
    int molecule;
    bool drawn = findDrawn(gl_InstanceID * BATCH + gl_VertexID / CORNERS, drawnCount, molecule);
    vec3 middle = vertexPlace(molecule, 0);
    uint seed = moleculeSeed(molecule);
    vec2 life = moleculeLife(molecule);
    float age = ageShare(life);

    color = firstColor;
#ifdef COLORS
    color = colorAt(age, firstColor, colorChanges[0], colorChanges[1], colorChanges[2], colorBegins, colorPerAge);
#endif
#ifdef COLOR_BY
    color.rgb *= scaleColor(molecule);
#endif
    place = middle;

#ifdef IMAGE
    tiles = vec3(0.0);
    if (TILES == tileOfSeed) tiles.x = randomTile(seed, tileCount);
    if (TILES == tilesOnce) tiles = framesOnce(age, tileCount, FADES);
#ifdef LIFE
    if (TILES == tilesAgain) tiles = framesAgain(life.x, frameRate, 0.0, tileCount, FADES);
#else
    float start = uniformFrom(hashSeed(seed, tileCounter));
    if (TILES == tilesAgain) tiles = framesAgain(flipTime, frameRate, start, tileCount, FADES);
#endif
#endif

    float angle = 0.0;
#ifdef TURNS
    // what never dies has no birth to count from
    float spin = randomBetween(spinSpan, seed, spinCounter);
#ifdef LIFE
    angle = spin * life.x;
#else
    angle = turnedBy(spin, timeBlocks, time);
#endif
    angle += randomBetween(turnSpan, seed, turnCounter);
    angle -= fullTurn * floor(angle / fullTurn);
#endif
    float c = cos(angle), s = sin(angle);

#ifdef POINTS
    gl_Position = toClip * vec4(middle, 1.0);
    gl_PointSize = pixels + 2.0;  // and a pixel of edge all around
#else
    float size = sizeSpan.x;
#ifdef SIZES
    size = randomBetween(sizeSpan, seed, sizeCounter);
#endif
#ifdef GROWS
    size *= mix(growth.x, growth.y, age);
#endif
    drawn = drawn && size > 0.0;
    // A particle narrower than `leastPixels` is drawn wider, and in return lets more through.
    vec4 clip = toClip * vec4(middle, 1.0);
    float shown = size * pixelsPerMeter / max(clip.w, 1e-6);
    float wider = max(leastPixels / max(shown, 1e-6), 1.0);
    size *= wider;
    if (BLEND != noneBlend) color.a /= wider * wider;

#ifdef SPRITES
    gl_Position = clip;
    // The point encloses the turned particle, and a pixel of edge all around.
    shown = max(shown, leastPixels);
    gl_PointSize = (abs(c) + abs(s)) * shown + 2.0;
    toSquare = 2.0 / shown * vec4(c, -s, s, c);
#else
    int number = gl_VertexID & 3;
    at = vec2((number & 1) != 0 ? 1.0 : -1.0, (number & 2) != 0 ? 1.0 : -1.0);
    vec3 right = viewToScene[0], up = viewToScene[1], front = viewToScene[2];
    vec2 reach = vec2(0.5 * size);
    if (FACING == velocityFacing) {
        // Along the velocity as the eye sees it: seen along its way a particle is round, not gone.
        front = unitOr(eyeAt.xyz - eyeAt.w * middle, viewToScene[2]);
        vec3 velocity = vertexVelocity(molecule, 0);
        velocity -= front * dot(front, velocity);
        vec3 upright = unitOr(up - front * dot(front, up), cross(front, right));
        up = unitOr(velocity, upright);
        right = cross(up, front);
        reach.y += 0.5 * stretch * length(velocity);
    } else if (FACING == freeFacing) {
        vec4 rotation = randomRotation(seed);
#ifdef TURNS
        rotation = composed(aboutAxis(randomAxis(seed), angle), rotation);
#endif
        right = turned(rotation, vec3(1.0, 0.0, 0.0));
        up = turned(rotation, vec3(0.0, 1.0, 0.0));
        front = cross(right, up);
    } else {
        vec3 level = right;
        right = c * level + s * up;
        up = c * up - s * level;
    }
#ifdef LIT
    frame = mat3(right, up, front);
#endif
    place = middle + right * (at.x * reach.x) + up * (at.y * reach.y);
    gl_Position = toClip * vec4(place, 1.0);
#endif
#endif
#if defined(POINTS) || defined(SPRITES)
    pointMiddle = (gl_Position.xy / gl_Position.w * 0.5 + 0.5) * pictureSize;
#endif
    if (!drawn || color.a <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
}
