// A particle, or a corner of it, straight from the state; everything that depends on its age and its seed is worked out
// here. The middle of a picture's square is (0, 0), its corners are at +-1. What C++ sets is in particles/kinds.glsl; an
// instance is a BATCH of particles of CORNERS vertices each. Variants are those of render/drawn.glsl.

#include "state/molecule.glsl"
#include "render/drawn.glsl"
#include "render/blend.glsl"
#include "render/color_scale.glsl"
#include "particles/attributes.glsl"
#include "particles/kinds.glsl"

uniform mat4 toClip;
uniform mat3 viewToScene;      // columns: right, up, towards the eye
uniform vec4 eyeAt;            // w 1: xyz the eye, m; w 0: xyz the direction towards it
uniform vec2 pictureSize;      // pixels
uniform float pixelsPerMeter;  // at a distance of one metre, or everywhere in the shadow map
uniform uint timeBlocks;       // of 64 s
uniform float time;            // s, since the last of them
uniform int drawnCount;        // particles; the last instance may be left with fewer

uniform float pixels;             // of a point
uniform vec2 sizeSpan;            // m
uniform vec2 growth;              // factors at birth and at the end
uniform vec2 turnSpan, spinSpan;  // rad, rad/s
uniform float stretch;            // s, of what faces along its velocity
uniform vec4 firstColor;          // linear RGB and opacity
uniform vec4 colorChanges[3];
uniform vec3 colorBegins, colorPerAge;
uniform float tileCount;
uniform float frameRate;
uniform float flipTime;  // s, less whole flip-books

flat out vec4 color;
out vec3 place;       // m, relative to the origin of drawing
flat out vec3 tiles;  // x one, y the next one, z its share
// Of points and sprites; not gl_PointCoord: rasterisers are free to be half a pixel off.
flat out vec2 pointMiddle;  // pixels
// Of sprites, a matrix by columns: from pixels off the middle to the particle's square.
flat out vec4 toSquare;
// Of quads.
out vec2 corner;
flat out mat3 frame;  // columns: right, up, towards the eye

// Smaller ones would come and go between the samples of a pixel.
const float leastPixels = 1.5;

vec3 unitOr(vec3 v, vec3 fallback)
{
    float lengthSquared = dot(v, v);
    return lengthSquared > 1e-20 ? v * inversesqrt(lengthSquared) : fallback;
}

vec3 tilesShown(uint seed, vec2 life)
{
    if (TILES == tileOfSeed) return vec3(randomTile(seed, tileCount), 0.0, 0.0);
    if (TILES == tilesOnce) return framesOnce(ageShare(life), tileCount, FADES);
    if (TILES == oneTile) return vec3(0.0);
    float start = uniformFrom(hashSeed(seed, tileCounter));
    return AGES ? framesAgain(life.x, frameRate, 0.0, tileCount, FADES)
                : framesAgain(flipTime, frameRate, start, tileCount, FADES);
}

// rad, less whole turns.
float angleOf(uint seed, vec2 life)
{
    if (!TURNS) return 0.0;
    // What never dies has no birth to count from.
    float spin = randomBetween(spinSpan, seed, spinCounter);
    float angle = AGES ? spin * life.x : turnedBy(spin, timeBlocks, time);
    angle += randomBetween(turnSpan, seed, turnCounter);
    return angle - fullTurn * floor(angle / fullTurn);
}

// m, of the diameter.
float sizeOf(uint seed, float age)
{
    float size = SIZES ? randomBetween(sizeSpan, seed, sizeCounter) : sizeSpan.x;
    return GROWS ? size * mix(growth.x, growth.y, age) : size;
}

void placePoint(float width)
{
    pointMiddle = (gl_Position.xy / gl_Position.w * 0.5 + 0.5) * pictureSize;
    gl_PointSize = width + 2.0;  // and a pixel of edge all around
}

// `shown`: pixels, of the particle's diameter.
void placeSprite(float shown, float angle)
{
    float c = cos(angle), s = sin(angle);
    toSquare = 2.0 / shown * vec4(c, -s, s, c);
    placePoint((abs(c) + abs(s)) * shown);  // encloses the turned particle
}

void placeQuad(int molecule, uint seed, vec3 middle, float size, float angle)
{
    int number = gl_VertexID & 3;
    corner = vec2((number & 1) != 0 ? 1.0 : -1.0, (number & 2) != 0 ? 1.0 : -1.0);
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
        if (TURNS) rotation = composed(aboutAxis(randomAxis(seed), angle), rotation);
        right = turned(rotation, vec3(1.0, 0.0, 0.0));
        up = turned(rotation, vec3(0.0, 1.0, 0.0));
        front = cross(right, up);
    } else {
        float c = cos(angle), s = sin(angle);
        vec3 level = right;
        right = c * level + s * up;
        up = c * up - s * level;
    }
    frame = mat3(right, up, front);
    place = middle + right * (corner.x * reach.x) + up * (corner.y * reach.y);
    gl_Position = toClip * vec4(place, 1.0);
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
    if (AGES) color = colorAt(age, firstColor, colorChanges[0], colorChanges[1], colorChanges[2], colorBegins, colorPerAge);
    if (COLOR_BY) color.rgb *= scaleColor(molecule);
    tiles = tilesShown(seed, life);
    place = middle;
    gl_Position = toClip * vec4(middle, 1.0);
    if (SHAPE == pointsShape) {
        placePoint(pixels);
    } else {
        float size = sizeOf(seed, age), angle = angleOf(seed, life);
        drawn = drawn && size > 0.0;
        // A particle narrower than `leastPixels` is drawn wider, and in return lets more through.
        float shown = size * pixelsPerMeter / max(gl_Position.w, 1e-6);
        float wider = max(leastPixels / max(shown, 1e-6), 1.0);
        if (BLEND != noneBlend) color.a /= wider * wider;
        if (SHAPE == spritesShape) placeSprite(max(shown, leastPixels), angle);
        else placeQuad(molecule, seed, middle, size * wider, angle);
    }
    if (!drawn || color.a <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
}
