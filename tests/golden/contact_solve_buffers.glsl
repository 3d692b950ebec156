#version 430 core
#define REMEMBERS true
#define RESTS false
#define STAGGERS false
#define SWEEPS false
#define SELF false
#define SPREADS false
#define BODIES false
#define COLLIDERS false
#define LIST 24
#define MOST_COLLIDERS 3
const bool inTextures = false;
#define UINTS usamplerBuffer
#define FLOATS samplerBuffer
#define fetch(values, i) texelFetch(values, i)
#define putColliderImpulses(i, k, value)
#define putAllColliderImpulses(i, values)
#define colliderImpulsesAt(i, k) vec4(0)
#define putEarlierColliderImpulses(i, k, value)
#define putAllEarlierColliderImpulses(i, values)
#define earlierColliderImpulsesAt(i, k) vec4(0)
uniform int listStride;
uniform samplerBuffer impulses;
vec4 impulsesAt(int i, int e)
{
    return texelFetch(impulses, (e) * listStride + (i));
}
uniform samplerBuffer earlierImpulses;
vec4 earlierImpulsesAt(int i, int e)
{
    return texelFetch(earlierImpulses, (e) * listStride + (i));
}
layout(std430) writeonly buffer EarlierImpulses { vec4 earlierImpulsesBuffer[]; };
#define putEarlierImpulses(i, e, value) earlierImpulsesBuffer[(e) * listStride + (i)] = (value)
layout(std430) writeonly buffer EarlierTotals { vec4 earlierTotalsBuffer[]; };
#define putEarlierTotals(i, k, value) earlierTotalsBuffer[2 * (i) + (k)] = (value)
void putAllEarlierTotals(int i, vec4 values[2])
{
    for (int k = 0; k < 2; ++k) putEarlierTotals(i, k, values[k]);
}
uniform float momentum;
uniform int firstNumber;
uniform int numbers;
layout(local_size_x = 64) in;
int ownNumber()
{
    return int(gl_GlobalInvocationID.x);
}
int ownLane()
{
    return min(ownNumber(), numbers - 1);
}
bool isBehindLast()
{
    return ownNumber() >= numbers;
}
void discardTexel()
{
}
const uint CONTACTS = 0x1fffffffu;
const uint HELD = 0x20000000u;
const uint RESPONDS = 0x40000000u;
bool isActedOn(uint counted)
{
    return (counted & ~RESPONDS) != 0u;
}
float asMemory(uint counted)
{
    return uintBitsToFloat(counted | RESPONDS);
}
const int NO_ROW = -1;
const uint FLAG = 0x80000000u;
uint withFlag(float number, bool isSet)
{
    return floatBitsToUint(number) | (isSet ? FLAG : 0u);
}
bool hasFlag(uint word)
{
    return (word & FLAG) != 0u;
}
float withoutFlag(uint word)
{
    return uintBitsToFloat(word & ~FLAG);
}
const uint TOUCHED = 1u;
const uint BESIDE = 2u;
const uint LOAD_CHANGED = 4u;
const uint STRUCK = 8u;
const uint WOKEN = 0x80000000u;
bool marksWoken(uint mark)
{
    return mark >= STRUCK;
}
uniform usamplerBuffer counts;
uint countsAt(int i)
{
    return texelFetch(counts, i).x;
}
uniform usamplerBuffer responding;
uint respondingAt(int i, int k)
{
    return texelFetch(responding, 2 * (i) + (k)).x;
}
int ownSlot(int count)
{
    int number = ownNumber();
    if (!inTextures) return number < int(respondingAt(0, 0)) ? int(respondingAt(1 + number, 0)) : -1;
    if (number >= count || countsAt(number) == 0u) discardTexel();
    return number;
}
int rowOf(int slot)
{
    return inTextures ? slot : int(respondingAt(1 + slot, 1));
}
int ownRow(int slot)
{
    return inTextures ? slot : ownNumber();
}
const int localCells = 4;
struct CellPlace {
    ivec3 cell;
    vec3 local;
};
CellPlace cellPlace(vec3 anchor, vec3 position, float cell)
{
    int bits = floatBitsToInt(cell);
    int doublings = min((bits >> 23) - 127, 26);
    int size = (16 + ((bits >> 19) & 15)) << max(doublings, 0);
    int finer = 1 << max(-doublings, 0);
    ivec3 point = ivec3(clamp(anchor * 16.0f, -1e9f, 1e9f));
    ivec3 whole = ivec3(floor(vec3(point) / float(size)));
    ivec3 part = (point - whole * size) * finer;
    ivec3 fine = ivec3(floor(vec3(part) / float(size)));
    ivec3 base = ivec3(uvec3(whole) * uint(finer)) + fine;
    vec3 rest = vec3(part - fine * size) * (0.0625f / float(finer)) + position;
    vec3 steps = floor(clamp(rest / cell, -1e9f, 1e9f));
    ivec3 index = base + ivec3(steps);
    vec3 inCell = clamp(rest - steps * cell, 0.0f, cell);
    return CellPlace(index, inCell + vec3(index & (localCells - 1)) * cell);
}
ivec3 cellApart(int sphere)
{
    return ivec3(0x40000000, sphere, 0);
}
vec3 localDifference(vec3 a, vec3 b, float cell)
{
    vec3 d = a - b;
    float period = float(localCells) * cell;
    return d - floor(d / period + 0.5f) * period;
}
uint cellKey(ivec3 cell, uint mask)
{
    ivec3 block = cell >> 3;
    ivec3 inBlock = cell & 7;
    uint h = uint(block.x) * 3266489917u ^ uint(block.y) * 2654435769u ^ (uint(block.z) * 2246822507u + 374761393u);
    h = (h ^ (h >> 15u)) * 739982445u;
    h = (h ^ (h >> 12u)) * 695872825u;
    h = h ^ (h >> 15u);
    return (h + uint(inBlock.x + 8 * inBlock.y + 64 * inBlock.z)) & mask;
}
uint staggeredKey(ivec3 own, vec3 local, float cell, int keyMask)
{
    vec3 offset = local - vec3(own & (localCells - 1)) * cell;
    return cellKey(own + ivec3(step(vec3(0.5 * cell), offset)), uint(keyMask));
}
#define motionsAt(i) uvec4(0)
#define marksAt(i) uint(0)
uniform usamplerBuffer sorted;
uvec2 sortedAt(int i)
{
    return texelFetch(sorted, i).xy;
}
uniform usamplerBuffer places;
uvec4 placesAt(int i)
{
    return texelFetch(places, i);
}
uniform usamplerBuffer sphereMotions;
uvec4 sphereMotionsAt(int i)
{
    return texelFetch(sphereMotions, i);
}
uniform usamplerBuffer cells;
uvec4 cellsAt(int i)
{
    return texelFetch(cells, i);
}
uniform int count;
uniform int keyMask;
uniform float cell;
uniform float stepTime;
uniform float restSpeed;
int sphereOf(int slot)
{
    return int(sortedAt(slot).y);
}
int memoryRow(int slot)
{
    return inTextures ? slot : sphereOf(slot);
}
uvec4 motionAt(int slot)
{
    return inTextures ? motionsAt(slot) : sphereMotionsAt(sphereOf(slot));
}
vec3 placeAt(int slot)
{
    return uintBitsToFloat(placesAt(slot).xyz);
}
vec3 velocityAt(int slot)
{
    return uintBitsToFloat(motionAt(slot).xyz);
}
bool isFresh(int slot)
{
    return hasFlag(motionAt(slot).w);
}
float radiusAt(int slot)
{
    return withoutFlag(cellsAt(slot).w);
}
bool rested(int slot)
{
    return hasFlag(cellsAt(slot).w);
}
bool rests(int slot)
{
    return RESTS && rested(slot) && !marksWoken(marksAt(slot));
}
int listedIn(uint counted)
{
    return min(int(counted & CONTACTS), LIST);
}
const int NO_PART = 0;
const int IMPACT = 1;
const int PERSISTENT = 2;
const int REPEATED = 3;
struct ContactImpulse {
    vec3 impulse;
    float multiplier;
    bool sticks;
    vec3 anchor;
    float start;
    int kind;
};
vec4 firstPart(ContactImpulse c)
{
    return vec4(c.impulse, c.sticks ? c.multiplier : -max(c.multiplier, 1e-30));
}
vec4 secondPart(ContactImpulse c)
{
    float kind = c.kind == IMPACT ? 0.0 : c.kind == NO_PART ? -1.0 : -2.0;
    return vec4(c.anchor, c.kind == PERSISTENT ? c.start + 1e-20 : kind);
}
ContactImpulse impulseFrom(vec4 first, vec4 second)
{
    int kind = second.w > 0.0 ? PERSISTENT : second.w == 0.0 ? IMPACT : second.w > -1.5 ? NO_PART : REPEATED;
    return ContactImpulse(first.xyz, abs(first.w), first.w >= 0.0, second.xyz, second.w, kind);
}
bool isLoaded(ContactImpulse begun)
{
    return begun.kind == PERSISTENT && begun.start > 1e-19;
}
ContactImpulse mirrored(ContactImpulse c)
{
    c.impulse = -c.impulse;
    c.anchor = -c.anchor;
    return c;
}
ContactImpulse noImpulse(int kind)
{
    return ContactImpulse(vec3(0.0), 0.0, true, vec3(0.0), 0.0, kind);
}
const float restingOverlap = 0.005f;
struct PairContact {
    vec3 normal;
    float depth;
    float speed;
};
vec3 directionFrom(uint other, uint number)
{
    uvec3 steps = uvec3(3518319155u, 2882110345u, 2360945575u);
    vec3 d = vec3((steps * number) >> 8u) - vec3((steps * other) >> 8u);
    return d / sqrt(max(dot(d, d), 1.0f));
}
PairContact pairContact(vec3 d, vec3 u, float reach)
{
    float apart = sqrt(dot(d, d));
    vec3 direction = d / max(apart, 1e-30f);
    return PairContact(direction, reach - apart, dot(direction, u));
}
struct PairImpact {
    vec3 normal;
    float since;
    float speed;
    bool happens;
};
PairImpact nextImpact(vec3 d, vec3 u, float reach, float time, float restSpeed)
{
    vec3 start = d - u * time;
    float along = dot(start, u);
    float gap = dot(start, start) - reach * reach;
    float under = along * along - dot(u, u) * gap;
    float wait = gap > 0.0f ? gap / max(sqrt(max(under, 0.0f)) - along, 1e-30f) : 0.0f;
    vec3 touch = start + u * wait;
    float apart = sqrt(dot(touch, touch));
    vec3 normal = touch / max(apart, 1e-30f);
    float speed = dot(normal, u);
    bool happens = along < 0.0f && under > 0.0f && wait <= time && speed < -restSpeed;
    return PairImpact(normal, max(time - wait, 0.0f), speed, happens);
}
vec3 pairImpulse(vec3 u, vec3 n, float target, vec3 pushed, vec2 w)
{
    float along = dot(u, n);
    return pushed + n * ((target - along) / w.x) - (u - n * along) / w.y;
}
vec3 withinFriction(vec3 impulse, vec3 n, float friction)
{
    float along = dot(impulse, n);
    vec3 across = impulse - n * along;
    float most = friction * max(along, 0.0f);
    float grip = sqrt(dot(across, across));
    return along >= 0.0f && grip <= most ? impulse : n * max(along, 0.0f) + across * (most / max(grip, 1e-30f));
}
const float frictionStep = 0.4f;
struct ContactSum {
    vec3 diagonal;
    vec3 beside;
    float number;
};
ContactSum noContacts()
{
    return ContactSum(vec3(0.0f), vec3(0.0f), 0.0f);
}
ContactSum withContact(ContactSum sum, vec3 n, vec2 parts)
{
    float across = frictionStep * parts.y;
    float along = parts.x - across;
    return ContactSum(sum.diagonal + n * n * along + across, sum.beside + vec3(n.y * n.z, n.x * n.z, n.x * n.y) * along,
                      sum.number + 1.0f);
}
ContactSum bothSums(ContactSum a, ContactSum b)
{
    return ContactSum(a.diagonal + b.diagonal, a.beside + b.beside, a.number + b.number);
}
mat3 symmetric(vec3 d, vec3 o)
{
    return mat3(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z);
}
mat3 matrixOf(ContactSum sum)
{
    return symmetric(sum.diagonal, sum.beside);
}
float traceOf(mat3 a, mat3 b)
{
    mat3 t = transpose(b);
    return dot(a[0], t[0]) + dot(a[1], t[1]) + dot(a[2], t[2]);
}
float effectiveCount(ContactSum sum)
{
    mat3 squared = matrixOf(sum);
    squared = squared * squared;
    mat3 fourth = squared * squared;
    return sum.number < 1.5f ? 1.0f : max(sqrt(sqrt(sqrt(traceOf(fourth, fourth)))), 1.01f);
}
float effectiveCount(mat3 a, mat3 b, mat3 c, mat3 d)
{
    for (int i = 0; i < 2; ++i) {
        mat3 a0 = a;
        mat3 b0 = b;
        mat3 c0 = c;
        a = a0 * a0 + b0 * c0;
        b = a0 * b0 + b0 * d;
        c = c0 * a0 + d * c0;
        d = c0 * b0 + d * d;
    }
    return max(sqrt(sqrt(sqrt(traceOf(a, a) + 2.0f * traceOf(b, c) + traceOf(d, d)))), 1.01f);
}
bool isAlone(float count)
{
    return count < 1.003f;
}
#define bodiesAt(i, k) vec4(0)
struct BodySphere {
    vec3 arm;
    float perMass;
    mat3 perInertia;
    float turning;
};
const BodySphere noBody = BodySphere(vec3(0.0), 0.0, mat3(0.0), 0.0);
struct BodyMotion {
    vec3 shift;
    vec3 turn;
};
vec3 motionAt(BodySphere body, BodyMotion motion)
{
    return motion.shift + cross(motion.turn, body.arm);
}
vec3 wayAt(BodySphere body, BodyMotion motion)
{
    vec3 across = cross(motion.turn, body.arm);
    vec3 halfTurn = 0.5 * motion.turn;
    return motion.shift + (across + cross(halfTurn, across)) / (1.0 + dot(halfTurn, halfTurn));
}
vec4[3] packedBody(BodySphere body)
{
    mat3 t = body.perInertia;
    return vec4[3](vec4(body.arm, body.perMass), vec4(t[0][0], t[1][1], t[2][2], body.turning), vec4(t[1][2], t[0][2], t[0][1], 0.0));
}
BodySphere bodySphereAt(int sphere)
{
    vec4 arm = bodiesAt(sphere, 0);
    vec4 d = bodiesAt(sphere, 1);
    return BodySphere(arm.xyz, arm.w, symmetric(d.xyz, bodiesAt(sphere, 2).xyz), d.w);
}
void add(inout BodyMotion motion, BodySphere body, vec3 impulse)
{
    motion.shift += impulse * body.perMass;
    motion.turn += body.perInertia * cross(body.arm, impulse);
}
#define collidersAt(i, k) vec4(0)
struct NearCollider {
    vec3 normal;
    float gap;
    vec3 velocity;
    float friction;
    bool bounces;
};
bool isNear(NearCollider collider)
{
    return collider.gap < 1e20;
}
vec4[2 * MOST_COLLIDERS] packedColliders(NearCollider near[MOST_COLLIDERS])
{
    vec4 texels[2 * MOST_COLLIDERS];
    for (int k = 0; k < MOST_COLLIDERS; ++k) {
        texels[2 * k] = vec4(near[k].normal, near[k].gap);
        texels[2 * k + 1] = vec4(near[k].velocity, uintBitsToFloat(withFlag(near[k].friction, near[k].bounces)));
    }
    return texels;
}
NearCollider colliderNear(int sphere, int k)
{
    vec4 place = collidersAt(sphere, 2 * k);
    vec4 surface = collidersAt(sphere, 2 * k + 1);
    uint friction = floatBitsToUint(surface.w);
    return NearCollider(place.xyz, place.w, surface.xyz, withoutFlag(friction), hasFlag(friction));
}
uniform usamplerBuffer lists;
uint listsAt(int i, int e)
{
    return texelFetch(lists, (e) * listStride + (i)).x;
}
uniform samplerBuffer materials;
vec4 materialsAt(int i)
{
    return texelFetch(materials, i);
}
uniform int groupCount;
const float pushSpeed = 1.0;
struct Sphere {
    vec3 place;
    uint label;
    vec3 velocity;
    float weight;
    float radius;
    bool fresh;
    bool rests;
};
Sphere sphereAt(int slot)
{
    uvec4 place = placesAt(slot);
    uvec4 motion = motionAt(slot);
    bool stays = RESTS && rested(slot) && rowOf(slot) == NO_ROW;
    return Sphere(uintBitsToFloat(place.xyz), place.w, uintBitsToFloat(motion.xyz), stays ? 0.0 : withoutFlag(motion.w),
                  radiusAt(slot), hasFlag(motion.w), stays);
}
vec2 materialOf(Sphere a, Sphere b)
{
    return materialsAt(int(a.label >> 26u) * groupCount + int(b.label >> 26u)).xy;
}
int listedOf(int slot)
{
    return listedIn(countsAt(slot));
}
bool holds(int slot, int other)
{
    int listed = int(countsAt(slot) & CONTACTS);
    bool found = listed <= LIST;
    int e = found ? LIST : 0;
    while (e < LIST) {
        found = found || int(listsAt(slot, e)) == other;
        ++e;
    }
    return found;
}
BodySphere bodyOf(int slot, Sphere sphere)
{
    if (!BODIES || sphere.rests) return noBody;
    return bodySphereAt(sphereOf(slot));
}
struct Pair {
    Sphere sphere;
    vec3 apart;
    PairContact contact;
    bool meets;
    vec2 material;
    BodySphere body;
};
Sphere own;
BodySphere ownBody;
void loadSphere(int slot)
{
    own = sphereAt(slot);
    ownBody = bodyOf(slot, own);
}
vec2 weightsOf(Sphere sphere, BodySphere body, vec3 n)
{
    if (!BODIES) return vec2(sphere.weight);
    vec3 across = cross(body.arm, n);
    float turning = dot(across, body.perInertia * across);
    return sphere.weight + vec2(turning, max(body.turning - turning, 0.0));
}
uniform usamplerBuffer effectiveCounts;
uint effectiveCountsAt(int i)
{
    return texelFetch(effectiveCounts, i).x;
}
float effectiveCountOf(int slot, Sphere sphere)
{
    return sphere.rests ? 1.0 : uintBitsToFloat(effectiveCountsAt(slot));
}
vec2 weightsBetween(Pair pair, vec3 n, vec2 effective)
{
    return weightsOf(own, ownBody, n) * effective.x + weightsOf(pair.sphere, pair.body, n) * effective.y;
}
vec3 parted(vec3 d, float reach, int slot, int other)
{
    bool coincide = dot(d, d) <= 1e-12 * reach * reach;
    while (coincide) {
        uvec2 numbers = uvec2(placesAt(other).w, placesAt(slot).w);
        if (numbers.x == numbers.y) numbers = uvec2(sphereOf(other), sphereOf(slot));
        d = directionFrom(numbers.x, numbers.y) * (1e-6 * reach);
        coincide = false;
    }
    return d;
}
Pair pairOf(int slot, int other)
{
    Pair pair;
    pair.sphere = sphereAt(other);
    pair.apart = localDifference(own.place, pair.sphere.place, cell);
    float reach = own.radius + pair.sphere.radius;
    pair.contact = pairContact(parted(pair.apart, reach, slot, other), own.velocity - pair.sphere.velocity, reach);
    pair.material = materialOf(own, pair.sphere);
    pair.body = bodyOf(other, pair.sphere);
    return pair;
}
float mostRemembered(float start, float size, float weight)
{
    return min(start + 0.1 * max(size - start, 0.0), 1.5 * start + restSpeed / weight);
}
ContactImpulse remembered(ContactImpulse known, Sphere other)
{
    float size = length(known.impulse);
    float most = known.kind == PERSISTENT ? mostRemembered(known.start, size, own.weight + other.weight) : 0.0;
    known.impulse *= min(1.0, most / max(size, 1e-30));
    if (known.kind == PERSISTENT) known.start = length(known.impulse);
    return known;
}
bool bouncesNext(NearCollider near)
{
    return !SPREADS && near.bounces && near.gap > 0.0 && dot(near.velocity - own.velocity, near.normal) > restSpeed;
}
bool isDeep(PairContact contact, float reach)
{
    return contact.depth > 0.25 * reach;
}
void leaveAsCome(inout Pair pair, vec3 anchor)
{
    float reach = own.radius + pair.sphere.radius;
    if (!isDeep(pair.contact, reach)) return;
    vec3 n = anchor / max(length(anchor), 1e-30);
    pair.contact.normal = n;
    pair.contact.depth = reach - dot(pair.apart, n);
    pair.contact.speed = dot(own.velocity - pair.sphere.velocity, n);
}
Pair pairAs(int slot, int other, ContactImpulse begun)
{
    Pair pair = pairOf(slot, other);
    pair.meets = begun.kind != NO_PART;
    leaveAsCome(pair, begun.anchor);
    return pair;
}
uniform samplerBuffer totals;
vec4 totalsAt(int i, int k)
{
    return texelFetch(totals, 2 * (i) + (k));
}
uniform samplerBuffer earlierTotals;
vec4 earlierTotalsAt(int i, int k)
{
    return texelFetch(earlierTotals, 2 * (i) + (k));
}
uniform samplerBuffer velocities;
vec4 velocitiesAt(int i, int k)
{
    return texelFetch(velocities, 2 * (i) + (k));
}
struct Constraint {
    vec3 normal;
    float target;
    vec2 weights;
    float lacks;
    float friction;
};
const float overRelaxed = 1.3;
float partingSpeed(float depth, float reach, bool loaded)
{
    float much = loaded ? clamp(0.1 * (depth - restingOverlap * reach), 0.0, 0.1 * stepTime) : 0.0;
    return (min(depth, 0.0) + much) / stepTime;
}
float lacking(float depth, float reach)
{
    return min(depth - restingOverlap * reach, pushSpeed * stepTime);
}
vec2 stepWeights(vec2 weights, float count)
{
    return isAlone(count) ? weights : weights / vec2(overRelaxed, overRelaxed * frictionStep);
}
Constraint constrain(int slot, int other, ContactImpulse begun)
{
    Pair pair = pairAs(slot, other, begun);
    PairContact contact = pair.contact;
    vec2 effective = vec2(effectiveCountOf(slot, own), effectiveCountOf(other, pair.sphere));
    vec2 weights = stepWeights(weightsBetween(pair, contact.normal, effective), max(effective.x, effective.y));
    float reach = own.radius + pair.sphere.radius;
    return Constraint(contact.normal, partingSpeed(contact.depth, reach, isLoaded(begun)), weights, lacking(contact.depth, reach),
                      pair.meets ? pair.material.y : -1.0);
}
uniform samplerBuffer normals;
vec4 normalsAt(int i, int e)
{
    return texelFetch(normals, (e) * listStride + (i));
}
uniform samplerBuffer weights;
vec4 weightsAt(int i, int e)
{
    return texelFetch(weights, (e) * listStride + (i));
}
uniform usamplerBuffer partnerRows;
uint partnerRowsAt(int i, int e)
{
    return texelFetch(partnerRows, (e) * listStride + (i)).x;
}
uniform samplerBuffer rowSpheres;
vec4 rowSpheresAt(int i, int k)
{
    return texelFetch(rowSpheres, 2 * (i) + (k));
}
Constraint constraintOf(int slot, int e)
{
    vec4 normal = normalsAt(ownRow(slot), e);
    vec4 weights = weightsAt(ownRow(slot), e);
    return Constraint(normal.xyz, normal.w, weights.xy, weights.z, weights.w);
}
struct Moved {
    vec3 velocity;
    vec3 move;
};
float ownCount;
Moved ownMoved;
vec3 ahead(vec3 latest, vec3 before)
{
    return momentum == 0.0 ? latest : latest + (latest - before) * momentum;
}
int rowOfOther(int slot, int e)
{
    return int(partnerRowsAt(ownRow(slot), e));
}
void loadOwnSphere(int slot)
{
    vec4 first = rowSpheresAt(ownRow(slot), 0);
    own.velocity = first.xyz;
    own.weight = first.w;
    own.radius = rowSpheresAt(ownRow(slot), 1).w;
    own.rests = own.weight == 0.0;
    ownBody = bodyOf(slot, own);
}
Moved movedAt(int row)
{
    if (inTextures && !SPREADS) {
        Sphere sphere = sphereAt(row);
        return Moved(sphere.velocity + ahead(totalsAt(row, 0).xyz, earlierTotalsAt(row, 0).xyz) * sphere.weight,
                     ahead(totalsAt(row, 1).xyz, earlierTotalsAt(row, 1).xyz) * sphere.weight);
    }
    if (row == NO_ROW) return Moved(vec3(0.0), vec3(0.0));
    return Moved(velocitiesAt(row, 0).xyz, velocitiesAt(row, 1).xyz);
}
void loadOwn(int slot)
{
    loadOwnSphere(slot);
    ownCount = effectiveCountOf(slot, own);
    ownMoved = movedAt(ownRow(slot));
}
Constraint constrainCollider(NearCollider near)
{
    vec2 weights = stepWeights(weightsOf(own, ownBody, near.normal) * ownCount, ownCount);
    return Constraint(near.normal, partingSpeed(-near.gap, own.radius, false), weights, lacking(-near.gap, own.radius), near.friction);
}
float residualOf(Constraint asked, vec4 next, vec4 push, vec4 before)
{
    vec3 change = next.xyz - ahead(push.xyz, before.xyz);
    float along = dot(change, asked.normal);
    float speed = max(abs(along) * asked.weights.x, length(change - along * asked.normal) * asked.weights.y);
    float move = (abs(next.w) - ahead(vec3(abs(push.w)), vec3(abs(before.w))).x) * asked.weights.x;
    return max(speed / max(restSpeed, 1e-20), abs(move) / own.radius);
}
ContactImpulse solved(Constraint asked, Moved other, vec4 push, vec4 before)
{
    vec3 n = asked.normal;
    vec3 wanted = pairImpulse(ownMoved.velocity - other.velocity, n, asked.target, ahead(push.xyz, before.xyz), asked.weights);
    vec3 taken = withinFriction(wanted, n, asked.friction);
    float lacks = asked.lacks - dot(ownMoved.move - other.move, n);
    float apart = ahead(vec3(abs(push.w)), vec3(abs(before.w))).x + lacks / asked.weights.x;
    return ContactImpulse(taken, max(apart, 0.0), taken == wanted, vec3(0.0), 0.0, PERSISTENT);
}
vec4 solve(int row, Constraint asked, vec4 push, vec4 before)
{
    if (asked.friction < 0.0) return vec4(0.0);
    return firstPart(solved(asked, movedAt(row), push, before));
}
uniform samplerBuffer anchors;
vec4 anchorsAt(int i, int e)
{
    return texelFetch(anchors, (e) * listStride + (i));
}
uniform samplerBuffer warmStart;
vec4 warmStartAt(int i)
{
    return texelFetch(warmStart, i);
}
#define putNextTotals(i, k, value)
#define putAllNextTotals(i, values)
#define putNextColliderImpulses(i, k, value)
#define putAllNextColliderImpulses(i, values)
layout(std430) writeonly buffer NextVelocities { vec4 nextVelocitiesBuffer[]; };
#define putNextVelocities(i, k, value) nextVelocitiesBuffer[2 * (i) + (k)] = (value)
void putAllNextVelocities(int i, vec4 values[2])
{
    for (int k = 0; k < 2; ++k) putNextVelocities(i, k, values[k]);
}
uniform float nextMomentum;
struct Batch {
    uint groupsX;
    uint groupsY;
    uint groupsZ;
    uint residual;
};
layout(std430) buffer Batches {
    Batch batches[];
};
uniform int batch;
uniform float tolerance;
float residual = 0.0;
void addResidual(Constraint asked, vec4 next, vec4 push, vec4 before)
{
    if (batch >= 0) residual = max(residual, residualOf(asked, next, push, before));
}
void endBatch()
{
    uint bits = floatBitsToUint(residual);
    bool isLarger = batch >= 0 && bits > batches[batch].residual;
    while (isLarger) {
        atomicMax(batches[batch].residual, bits);
        if (residual > tolerance && batch + 1 < batches.length()) batches[batch + 1].groupsX = batches[0].groupsX;
        isLarger = false;
    }
}
vec4 solveEntry(int slot, int e, Constraint asked)
{
    int row = ownRow(slot);
    if (inTextures) return impulsesAt(row, e);
    vec4 push = impulsesAt(row, e);
    vec4 before = earlierImpulsesAt(row, e);
    vec4 next = solve(rowOfOther(slot, e), asked, push, before);
    addResidual(asked, next, push, before);
    putEarlierImpulses(row, e, next);
    return next;
}
vec4 solveCollider(NearCollider near, vec4 push, vec4 before)
{
    if (ownCount <= 0.0 || bouncesNext(near)) return vec4(0.0);
    Constraint asked = constrainCollider(near);
    ContactImpulse next = solved(asked, Moved(near.velocity, vec3(0.0)), push, before);
    vec4 impulse = vec4(next.impulse, next.multiplier);
    addResidual(asked, impulse, push, before);
    return impulse;
}
void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    loadOwn(slot);
    int row = ownRow(slot);
    int listed = listedOf(slot);
    vec3 impulse = -(inTextures ? warmStartAt(row) : rowSpheresAt(row, 1)).xyz;
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        Constraint asked = constraintOf(slot, e);
        vec4 push = solveEntry(slot, e, asked);
        impulse += push.xyz;
        shift += asked.normal * abs(push.w);
    }
    if (COLLIDERS) {
        int memory = memoryRow(slot);
        vec4 next[MOST_COLLIDERS];
        for (int k = 0; k < MOST_COLLIDERS; ++k) next[k] = vec4(0.0);
        for (int k = 0; k < MOST_COLLIDERS; ++k) {
            NearCollider near = colliderNear(sphereOf(slot), k);
            if (!isNear(near) || own.weight <= 0.0) break;
            vec4 push = colliderImpulsesAt(memory, k);
            next[k] = solveCollider(near, push, earlierColliderImpulsesAt(memory, k));
            impulse += next[k].xyz;
            shift += near.normal * next[k].w;
            putEarlierColliderImpulses(memory, k, push);
            putColliderImpulses(memory, k, next[k]);
        }
        putAllNextColliderImpulses(slot, next);
    }
    vec4 next[2] = vec4[2](vec4(impulse, totalsAt(row, 0).w), vec4(shift, 0.0));
    putAllNextTotals(row, next);
    putAllEarlierTotals(row, next);
    vec3 further = impulse + (impulse - totalsAt(row, 0).xyz) * nextMomentum;
    putNextVelocities(row, 0, vec4(own.velocity + further * own.weight, 0.0));
    further = shift + (shift - totalsAt(row, 1).xyz) * nextMomentum;
    putNextVelocities(row, 1, vec4(further * own.weight, 0.0));
    endBatch();
}
