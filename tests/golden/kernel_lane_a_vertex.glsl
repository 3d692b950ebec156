#version 430 core
#define POSITION_ELEMENTS 2
#define STATE_ELEMENTS 4
#define BLOCK 16
#define LANES 32
#define ROWS 2
#define VERTICES 1
#define MOLECULE_VERTICES 2
#define TRIANGLES 0
#define LANE_A_VERTEX true
#define MAY_BE_CUT false
#define CARRIES false
#define TOGETHER false
#define ISSUED_AHEAD false
#define RESTS false
#define MAY_BE_HELD false
#define RIGID_IMPACT false
#define COLLIDE true
#define ANCHORS_MOVE true
#define RELEASE false
#define PINS false
#define SPRINGS true
#define SAMPLE_SUBSTEPS true
#define SAMPLE_MOLECULE false
#define VALUES samplerBuffer
int firstElement(int molecule, int elements)
{
    return (molecule / BLOCK) * (BLOCK * elements) + molecule % BLOCK;
}
vec4 element(samplerBuffer values, int first, int e)
{
    return texelFetch(values, first + e * BLOCK);
}
vec4 valueOf(samplerBuffer values, int molecule)
{
    return texelFetch(values, molecule);
}
int floatIndex(int first, int number)
{
    return (first + (number / 4) * BLOCK) * 4 + number % 4;
}
vec3 packedVertex(VALUES values, int first, int begin, int vertex)
{
    int number = 3 * vertex;
    vec4 low = element(values, first, begin + number / 4);
    vec4 high = element(values, first, begin + (number + 2) / 4);
    int shift = number % 4;
    return shift == 0 ? low.xyz : shift == 1 ? low.yzw : shift == 2 ? vec3(low.zw, high.x) : vec3(low.w, high.xy);
}
vec2 packedLife(VALUES values, int first)
{
    if (STATE_ELEMENTS % 2 == 1) return element(values, first, STATE_ELEMENTS - 1).xy;
    return vec2(element(values, first, POSITION_ELEMENTS - 1).w, element(values, first, 2 * POSITION_ELEMENTS - 1).w);
}
layout(local_size_x = LANES, local_size_y = ROWS) in;
uniform VALUES oldState;
uniform VALUES oldRecords;
uniform VALUES constants;
uniform ivec4 givenCounts;
uniform vec4 givenNumbers[7];
int frame;
int substeps;
float substep;
float frameDuration;
vec3 gravity;
float wind;
vec2 decay;
vec2 phi;
float stiffnessFactor;
float dampingFactor;
float releaseForce;
float releaseChance;
vec3 driftOfStep;
vec2 dragRate;
float stageEta;
vec2 stageDecay;
vec2 stagePhi;
vec2 flightBend;
int slips;
int restarts;
const bool isSoftware = false;
int inRegister(int value) { return value; }
float inRegister(float value) { return value; }
vec2 inRegister(vec2 value) { return value; }
vec3 inRegister(vec3 value) { return value; }
vec4 inRegister(vec4 value) { return value; }
void loadUniforms()
{
    frame = inRegister(givenCounts.x);
    substeps = inRegister(givenCounts.y);
    slips = inRegister(givenCounts.z);
    restarts = inRegister(givenCounts.w);
    gravity = inRegister(givenNumbers[0].xyz);
    wind = inRegister(givenNumbers[0].w);
    substep = inRegister(givenNumbers[1].x);
    frameDuration = inRegister(givenNumbers[1].y);
    stiffnessFactor = inRegister(givenNumbers[1].z);
    dampingFactor = inRegister(givenNumbers[1].w);
    decay = inRegister(givenNumbers[2].xy);
    phi = inRegister(givenNumbers[2].zw);
    flightBend = inRegister(givenNumbers[3].xy);
    dragRate = inRegister(givenNumbers[3].zw);
    driftOfStep = inRegister(givenNumbers[4].xyz);
    stageEta = inRegister(givenNumbers[4].w);
    stageDecay = inRegister(givenNumbers[5].xy);
    stagePhi = inRegister(givenNumbers[5].zw);
    releaseForce = inRegister(givenNumbers[6].x);
    releaseChance = inRegister(givenNumbers[6].y);
}
vec3 carried(vec3 before, vec3 after) { return !CARRIES || substeps > 0 ? after : before; }
vec3 x[VERTICES];
vec3 v[VERTICES];
vec3 w[VERTICES];
vec3 force[VERTICES];
vec3 probe[VERTICES];
vec3 fluid[VERTICES];
vec3 normal[VERTICES];
vec3 anchor;
float scale = 1.0;
float phase = 0.0;
bool released = false;
uint seed;
float age = 0.0;
float span = 0.0;
bool touched = false;
const bool isMortal = false;
const bool hasHistory = false;
bool taken()
{
    return !isMortal || span > 0.0;
}
void loadRecord(int molecule)
{
    vec4 record = valueOf(oldRecords, molecule);
    anchor = record.xyz;
    released = record.w < 0.0;
    seed = uint(abs(record.w)) - 1u;
}
vec4 recordNow()
{
    float label = float(seed + 1u);
    return vec4(anchor, released ? -label : label);
}
void waitForGroup()
{
    memoryBarrierShared();
    barrier();
}
const int PLACES = 0;
const int VELOCITIES = 4 * POSITION_ELEMENTS * LANES;
shared float sharedNumbers[2 * VELOCITIES];
float inverseMass[VERTICES];
bool pinned[VERTICES];
uniform int topologyBase;
layout(std430) readonly buffer Topology { vec4 topology[]; };
vec4 table(int index)
{
    return topology[index];
}
vec4 inertia(int vertex)
{
    return table(topologyBase + MOLECULE_VERTICES + vertex);
}
int column()
{
    return int(gl_LocalInvocationID.x);
}
int row()
{
    return int(gl_LocalInvocationID.y);
}
int vertexOf(int i)
{
    return min(row() + i * ROWS, MOLECULE_VERTICES - 1);
}
bool isOwn(int i)
{
    return row() + i * ROWS < MOLECULE_VERTICES;
}
int sharedIndex(int array, int number)
{
    return array + number * LANES + column();
}
vec3 sharedVector(int array, int vertex)
{
    int index = sharedIndex(array, 3 * vertex);
    return vec3(sharedNumbers[index], sharedNumbers[index + LANES], sharedNumbers[index + 2 * LANES]);
}
void setSharedVector(int array, int vertex, vec3 value)
{
    int index = sharedIndex(array, 3 * vertex);
    sharedNumbers[index] = value.x;
    sharedNumbers[index + LANES] = value.y;
    sharedNumbers[index + 2 * LANES] = value.z;
}
void share(int array, int i, vec3 value)
{
    if (isOwn(i)) setSharedVector(array, vertexOf(i), value);
}
void shareProbes()
{
    waitForGroup();
    share(PLACES, 0, probe[0]);
    waitForGroup();
}
#define springPlace(vertex) sharedVector(PLACES, vertex)
#define springVelocity(vertex) sharedVector(VELOCITIES, vertex)
#define springInverseMass(vertex) inertia(vertex).x
vec3 springForce(vec3 d, vec3 relativeVelocity, float stiffness, float damping, float restLength)
{
    float inverse = inversesqrt(max(dot(d, d), 1e-24f));
    float stretch = restLength * inverse - 1.0f;
    float approach = dot(d, relativeVelocity) * (inverse * inverse);
    return d * (stiffness * stretch - damping * approach);
}
float musclePull(vec3 muscle, float angle, float time, float phase)
{
    return muscle.x * sin(muscle.z + angle + phase + muscle.y * time);
}
float bentLength(float restLength, float pull, float bend)
{
    return restLength * (1.0f + pull + bend);
}
vec3 sprung(vec3 d, vec3 relative, float stiffness, float damping, float restLength, float inverseMasses)
{
    stiffness *= stiffnessFactor;
    return springForce(d, relative, stiffness, damping * dampingFactor, restLength);
}
vec3 springKick(vec3 force, float inverseMass, float time)
{
    return force * (inverseMass * time);
}
struct SpringEnd {
    vec3 place;
    vec3 velocity;
    float inverseMass;
};
float tableRestLength(int entry, float drawn, float time)
{
    float restLength = drawn * scale;
    return restLength;
}
vec3 tableSpringForce(int entry, SpringEnd own, float time)
{
    vec4 spring = table(entry);
    int other = int(spring.x);
    float restLength = tableRestLength(entry, spring.w, time);
    return sprung(own.place - springPlace(other), own.velocity - springVelocity(other), spring.y, spring.z, restLength,
                  own.inverseMass + springInverseMass(other));
}
vec3 springForceOn(int vertex, float time)
{
    vec4 spans = table(topologyBase + vertex);
    int entry = int(spans.x);
    int end = entry + 2 * int(spans.y);
    SpringEnd own = SpringEnd(springPlace(vertex), springVelocity(vertex), springInverseMass(vertex));
    vec3 sum = vec3(0.0);
    for (; entry + 2 < end; entry += 4) {
        vec3 first = tableSpringForce(entry, own, time);
        vec3 second = tableSpringForce(entry + 2, own, time);
        sum = sum + first + second;
    }
    for (; entry < end; entry += 2) sum += tableSpringForce(entry, own, time);
    return sum;
}
vec3 areaVector(vec3 b, vec3 c)
{
    return cross(b, c);
}
vec3 unitNormal(vec3 sum)
{
    float squared = dot(sum, sum);
    return squared > 1e-30f ? sum / sqrt(squared) : vec3(0.0f, 1.0f, 0.0f);
}
void loadInertia()
{
    {
        vec4 own = inertia(vertexOf(0));
        inverseMass[0] = own.x;
        pinned[0] = own.y > 0.5;
    }
}
void springForces(float time)
{
    waitForGroup();
    {
        share(PLACES, 0, x[0]);
        share(VELOCITIES, 0, w[0]);
    }
    waitForGroup();
    force[0] = springForceOn(vertexOf(0), time);
}
void shareAreas(int first, int end)
{
    waitForGroup();
    for (int t = first + row(); t < end; t += ROWS) {
        vec4 corners = table(topologyBase + 2 * MOLECULE_VERTICES + t);
        vec3 place = sharedVector(PLACES, int(corners.x));
        vec3 next = sharedVector(PLACES, int(corners.y));
        vec3 last = sharedVector(PLACES, int(corners.z));
        setSharedVector(VELOCITIES, t - first, areaVector(next - place, last - place));
    }
    waitForGroup();
}
void addAreas(inout vec3 sum, inout ivec2 fan, int first, int end)
{
    while (fan.x < fan.y) {
        int t = int(table(fan.x).w);
        if (t >= end) break;
        sum += sharedVector(VELOCITIES, t - first);
        ++fan.x;
    }
}
ivec2 fans[VERTICES];
void surfaceNormals()
{
    shareProbes();
    {
        vec4 spans = table(topologyBase + vertexOf(0));
        fans[0] = ivec2(spans.z, spans.z + spans.w);
        normal[0] = vec3(0.0);
    }
    for (int first = 0; first < TRIANGLES; first += MOLECULE_VERTICES) {
        int end = min(first + MOLECULE_VERTICES, TRIANGLES);
        shareAreas(first, end);
        addAreas(normal[0], fans[0], first, end);
    }
    if (table(topologyBase + vertexOf(0)).w > 0.0) normal[0] = unitNormal(normal[0]);
}
float largest(float value)
{
    waitForGroup();
    sharedNumbers[sharedIndex(VELOCITIES, row())] = value;
    waitForGroup();
    float most = sharedNumbers[sharedIndex(VELOCITIES, 0)];
    for (int r = 1; r < ROWS; ++r) most = max(most, sharedNumbers[sharedIndex(VELOCITIES, r)]);
    return most;
}
bool anyLane(bool value)
{
    return largest(value ? 1.0 : 0.0) > 0.5;
}
float pullOnPins()
{
    float pull = 0.0;
    if (!SPRINGS) return pull;
    if (pinned[0]) pull = max(pull, length(force[0]));
    return largest(pull);
}
vec3 firstPlace()
{
    waitForGroup();
    if (row() == 0) share(PLACES, 0, x[0]);
    waitForGroup();
    return sharedVector(PLACES, 0);
}
vec3 meanProbe()
{
    shareProbes();
    vec3 sum = sharedVector(PLACES, 0);
    for (int vertex = 1; vertex < MOLECULE_VERTICES; ++vertex) sum += sharedVector(PLACES, vertex);
    return sum * (1.0 / float(MOLECULE_VERTICES));
}
vec3 meanVelocity()
{
    waitForGroup();
    share(VELOCITIES, 0, w[0]);
    waitForGroup();
    vec3 sum = vec3(0.0);
    for (int vertex = 0; vertex < MOLECULE_VERTICES; ++vertex) sum += sharedVector(VELOCITIES, vertex) * inertia(vertex).w;
    return sum;
}
vec3 steeredMiddle()
{
    shareProbes();
    vec3 sum = vec3(0.0);
    for (int vertex = 0; vertex < MOLECULE_VERTICES; ++vertex) sum += sharedVector(PLACES, vertex) * inertia(vertex).w;
    return sum;
}
const float HELD_BY_CONTACT = -1.0;
const float AWAKE = 0.0;
const float RESTING = 1.0;
const float COME_TO_REST = 2.0;
bool isResting(float state)
{
    return state > AWAKE;
}
const bool heldByContact = false;
#define LOAD(i) vec3(0.0)
void loadLoads(int molecule)
{
}
float moverOf(int molecule)
{
    return AWAKE;
}
uint hashSeed(uint seed, uint counter)
{
    uint state = (seed ^ (counter * 2654435769u)) * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}
float uniformFrom(uint hash)
{
    return float(hash >> 8u) / 16777216.0f;
}
bool isReleased(float pull, float limit, uint seed, int frame, float chance)
{
    return pull > limit || uniformFrom(hashSeed(seed, uint(frame))) < chance;
}
vec3 driftOf(vec3 v, vec3 dragged)
{
    return ((slips != 0 ? dragged : v) + dragged) * (0.5f * substep);
}
vec3 velocityAfter(vec3 dragged, vec3 moved)
{
    return dragged;
}
float dragDecay(float y)
{
    float z = 0.5f * y;
    float q = z * z;
    float series = 2.0f * exp(-z) * z * (1.0f + q / 6.0f * (1.0f + q / 20.0f * (1.0f + q / 42.0f)));
    return abs(y) < 1.0f ? series : 1.0f - exp(-y);
}
float dragPhi(float rate, float h)
{
    return abs(rate * h) < 1e-6f ? h : dragDecay(rate * h) / rate;
}
float dragBend(float rate, float h)
{
    float y = rate * h;
    float series =
        h * h * (0.5f - y / 6.0f * (1.0f - y / 4.0f * (1.0f - y / 5.0f * (1.0f - y / 6.0f * (1.0f - y / 7.0f)))));
    return abs(y) < 0.5f ? series : (h - dragPhi(rate, h)) / rate;
}
vec3 dragAndGravity(vec3 v, vec3 u, vec3 gravity, float decay, float phi)
{
    return v + ((u - v) * decay + gravity * phi);
}
vec3 directionalDragAndGravity(vec3 v, vec3 u, vec3 gravity, vec3 n, vec2 decay, vec2 phi)
{
    vec3 slip = u - v;
    vec3 slipAcross = n * dot(slip, n);
    vec3 gravityAcross = n * dot(gravity, n);
    return v + ((slipAcross * decay.x + (slip - slipAcross) * decay.y) +
                (gravityAcross * phi.x + (gravity - gravityAcross) * phi.y));
}
vec3 withWind(vec3 velocity)
{
    return velocity;
}
vec3 fallAt(vec3 anchor, vec3 position)
{
    return gravity;
}
const bool isDirectional = false;
const bool hasFields = false;
vec3 fieldAt(vec3 anchor, vec3 position, float time)
{
    return vec3(0.0);
}
vec3 fluidOf(vec3 u)
{
    return withWind(hasFields ? u : vec3(0.0));
}
vec3 draggedBy(vec3 velocity, vec3 u, vec3 a, vec3 n, vec2 decays, vec2 phis)
{
    u = fluidOf(u);
    if (isDirectional) return directionalDragAndGravity(velocity, u, a, n, decays, phis);
    return dragAndGravity(velocity, u, a, decays.y, phis.y);
}
vec3 dragged(vec3 velocity, vec3 u, vec3 a, vec3 n)
{
    return draggedBy(velocity, u, a, n, decay, phi);
}
vec3 dragAcceleration(vec3 velocity, vec3 u, vec3 a, vec3 n)
{
    vec3 slip = fluidOf(u) - velocity;
    a += slip * dragRate.y;
    if (isDirectional) a += n * (dot(slip, n) * (dragRate.x - dragRate.y));
    return a;
}
#define PULLED(i) gravity
#define FALL(i) (PULLED(i) + LOAD(i))
bool isHeld(bool pinned)
{
    return PINS && pinned && !released;
}
void letGo(int step)
{
    if (!RELEASE || step > 0) return;
    float pulled = pullOnPins();
    released = released || isReleased(pulled, releaseForce, seed, frame, releaseChance);
}
void sampleFrame()
{
    if (!hasFields || SAMPLE_SUBSTEPS) return;
    float middle = 0.5 * frameDuration;
    if (hasHistory) middle += 0.5 * substep;
    probe[0] = x[0] + v[0] * middle;
    if (SAMPLE_MOLECULE) {
        vec3 u = fieldAt(anchor, meanProbe(), middle);
        fluid[0] = u;
        return;
    }
    fluid[0] = fieldAt(anchor, probe[0], middle);
}
void sampleSubstep(float time)
{
    if (!hasFields || !SAMPLE_SUBSTEPS) return;
    fluid[0] = fieldAt(anchor, probe[0], time);
}
void sampleHere(float time)
{
    probe[0] = x[0];
    if (isDirectional) surfaceNormals();
    sampleSubstep(time);
}
void springForcesNow(int step, float time)
{
    if (SPRINGS) {
        w[0] = v[0];
        springForces(time);
    }
    letGo(step);
}
void kickWhole(int step, float time)
{
    springForcesNow(step, time);
    if (!SPRINGS) return;
    if (!isHeld(pinned[0])) v[0] += springKick(force[0], inverseMass[0], substep);
}
void driftAll()
{
    {
        if (!isHeld(pinned[0])) {
            vec3 before = x[0];
            vec3 ended = dragged(v[0], fluid[0], FALL(0), normal[0]);
            x[0] += driftOf(v[0], ended);
            v[0] = velocityAfter(ended, x[0] - before);
        }
    }
}
void thrust(bool whole)
{
}
vec3 stageDragged(vec3 velocity, vec3 u, vec3 a, vec3 n)
{
    return draggedBy(velocity, u, a, n, stageDecay, stagePhi);
}
vec3 flight(vec3 velocity, vec3 u, vec3 a, vec3 n)
{
    vec3 slope = dragAcceleration(velocity, u, a, n);
    vec3 bend = slope * flightBend.y;
    if (isDirectional) bend += n * (dot(slope, n) * (flightBend.x - flightBend.y));
    return velocity * substep + bend;
}
const bool keepsSurface = false;
struct Contact {
    vec3 position;
    vec3 velocity;
};
struct Drift {
    float step;
    float kickDrift;
    float lag;
    vec3 acceleration;
};
vec3 wayGained(vec3 v, Drift drift)
{
    return v * drift.kickDrift;
}
const float restingSlack = 1e-6f;
const float caughtDepth = 0.005f;
const float pushSpeed = 1.0f;
Contact respond(bool inside, vec3 x, vec3 v, float distance, vec3 n, float restitution, float friction, Drift drift)
{
    float depth = max(-distance, 0.0f);
    float vn = dot(v, n);
    vec3 surface = x + n * depth;
    float gn = dot(drift.acceleration, n);
    float synchronised = vn + gn * drift.lag;
    float impact = sqrt(max(synchronised * synchronised + 2.0f * gn * depth, 0.0f));
    float since = min(depth / max(0.5f * (impact - synchronised), 1e-20f), drift.step);
    float rebound = restitution * impact;
    bool bounces = rebound > 0.5f * abs(gn) * drift.step && rebound + 0.5f * gn * since > 0.0f;
    float newNormal = bounces ? rebound + gn * (since - drift.lag) : 0.0f;
    float height = bounces ? (rebound + 0.5f * gn * since) * since : 0.0f;
    float frictionTime = bounces ? since : drift.kickDrift;
    vec3 tangential = v - n * vn;
    float speed = sqrt(dot(tangential, tangential));
    float normalChange = bounces ? rebound + impact : -vn;
    float lost = min(friction * normalChange, speed);
    vec3 lostVelocity = tangential * (lost / max(speed, 1e-30f));
    vec3 position = surface + n * height - lostVelocity * frictionTime;
    vec3 velocity = tangential - lostVelocity + n * newNormal;
    float started = distance - vn * drift.kickDrift;
    float slack = min(restingSlack, -0.02f * vn * drift.kickDrift);
    bool rests = !bounces && lost >= speed && abs(started) < slack;
    position = rests ? x - wayGained(v, drift) : position;
    velocity = rests ? vec3(0.0f) : velocity;
    bool leaves = vn >= 0.0f;
    position = leaves ? surface : position;
    velocity = leaves ? v : velocity;
    bool caught = inside || depth > caughtDepth + 2.0f * abs(vn) * drift.step;
    float way = min(depth, (pushSpeed - min(vn, 0.0f)) * drift.step);
    position = caught ? x + n * way : position;
    velocity = caught ? v + n * (clamp(vn, 0.0f, pushSpeed) - vn) : velocity;
    bool outside = distance >= 0.0f;
    return Contact(outside ? x : position, outside ? v : velocity);
}
Contact constrain(bool inside, vec3 x, vec3 v, float distance, vec3 n, float friction, float step)
{
    float vn = dot(v, n);
    float moved = min(max(-distance, 0.0f), max(pushSpeed - vn, 0.0f) * step);
    vec3 tangential = v - n * vn;
    float speed = sqrt(dot(tangential, tangential));
    float lost = min(friction * moved / step, speed);
    vec3 change = n * (moved / step) - tangential * (lost / max(speed, 1e-30f));
    float started = distance - vn * step;
    bool rests = lost >= speed && abs(started) < min(restingSlack, -0.02f * vn * step);
    bool outside = distance >= 0.0f;
    vec3 left = inside ? v + n * (clamp(vn, 0.0f, pushSpeed) - vn) : v + change;
    vec3 place = inside ? x + n * moved : x + change * step;
    rests = rests && !inside;
    return Contact(outside ? x : (rests ? x - v * step : place), outside ? v : (rests ? vec3(0.0f) : left));
}
vec3 withoutKick(vec3 answered, vec3 v, vec3 kick)
{
    return answered != v + kick ? answered - kick : v;
}
vec3 heldBy(vec3 n, float friction, vec3 acceleration)
{
    float pressure = -dot(acceleration, n);
    vec3 along = acceleration + n * pressure;
    float most = friction * pressure;
    bool holds = friction >= 0.0f && pressure >= 0.0f && dot(along, along) <= most * most;
    return holds ? vec3(0.0f) : acceleration;
}
const bool isConstraint = false;
Contact answer(bool inside, vec3 x, vec3 v, float distance, vec3 n, float restitution, float friction, Drift drift)
{
    if (isConstraint) return constrain(inside, x, v, distance, n, friction, drift.step);
    return respond(inside, x, v, distance, n, restitution, friction, drift);
}
float bilinear(float h00, float h10, float h01, float h11, vec2 f)
{
    return mix(mix(h00, h10, f.x), mix(h01, h11, f.x), f.y);
}
uniform samplerBuffer samples;
vec4 sampleAt(int index)
{
    return texelFetch(samples, index);
}
bool insideBox(vec3 fromLow, vec3 fromHigh, vec3 position)
{
    return all(greaterThanEqual(fromLow + position, vec3(0.0))) && all(lessThanEqual(fromHigh + position, vec3(0.0)));
}
int outsideIndex(int i, int count, bool wrap)
{
    if (!wrap) return clamp(i, 0, count - 1);
    return i < 0 ? i + count : i >= count ? i - count : i;
}
vec3 gridVelocity(vec3 x, vec3 perMetre, ivec3 resolution, int base, bool wrap)
{
    vec3 p = x * perMetre - 0.5;
    vec3 size = vec3(resolution);
    p = wrap ? p - size * floor(p / size) : clamp(p, vec3(-1.0), size);
    p = min(p, size);
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
float placeEvenly(float first, float elapsed, float framesPerSecond)
{
    return first + elapsed * framesPerSecond;
}
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
vec3 turned(vec4 q, vec3 v)
{
    vec3 across = cross(vec3(q.x, q.y, q.z), v) * 2.0f;
    return v + across * q.w + cross(vec3(q.x, q.y, q.z), across);
}
vec3 turnedBack(vec4 q, vec3 v)
{
    return turned(vec4(-q.x, -q.y, -q.z, q.w), v);
}
vec4 anyRotation(float u, float v, float w)
{
    float angleA = 6.2831853f * v;
    float angleB = 6.2831853f * w;
    float a = sqrt(1.0f - u);
    float b = sqrt(u);
    return vec4(a * sin(angleA), a * cos(angleA), b * sin(angleB), b * cos(angleB));
}
const float noDirection = 1e-15f;
vec4 sphereSurface(vec3 x, float radius)
{
    float r = length(x);
    return vec4(r > noDirection ? x / r : vec3(0.0f, 1.0f, 0.0f), r - radius);
}
vec4 boxSurface(vec3 x, vec3 halfSize)
{
    vec3 q = abs(x) - halfSize;
    vec3 beyond = max(q, vec3(0.0f));
    float outside = length(beyond);
    vec3 face = q.x >= q.y && q.x >= q.z ? vec3(1.0f, 0.0f, 0.0f)
                : q.y >= q.z             ? vec3(0.0f, 1.0f, 0.0f)
                                         : vec3(0.0f, 0.0f, 1.0f);
    bool off = outside > noDirection;
    vec3 n = off ? beyond / outside : face;
    vec3 side = vec3(x.x < 0.0f ? -1.0f : 1.0f, x.y < 0.0f ? -1.0f : 1.0f, x.z < 0.0f ? -1.0f : 1.0f);
    return vec4(n * side, off ? outside : max(q.x, max(q.y, q.z)));
}
vec4 capsuleSurface(vec3 x, vec3 axis, float perLength, vec3 aside, float radius)
{
    vec3 off = x - axis * clamp(dot(x, axis) * perLength, 0.0f, 1.0f);
    float r = length(off);
    return vec4(r > noDirection ? off / r : aside, r - radius);
}
const float contactRadius = 0.0;
void takeRadius(float scale, float lived)
{
}
vec4 struckLast;
vec3 struckVelocity;
const vec4 noSurface = vec4(0.0, 1.0, 0.0, 1e30);
vec4 planeSurface(vec3 origin, vec3 x, vec3 normal)
{
    return vec4(normal, dot(origin, normal) + dot(x, normal));
}
vec4 turnAt(vec4 from, vec4 to, float share)
{
    return normalize(mix(from, to, share));
}
vec4 turnedSurface(vec4 q, vec4 surface)
{
    return vec4(turned(q, surface.xyz), surface.w);
}
vec4 heightSurfaceStored(vec3 x, vec4 cells, ivec2 size, int base)
{
    vec2 p = x.xz * cells.xw;
    if (p.x < 0.0 || p.y < 0.0 || p.x > float(size.x - 1) || p.y > float(size.y - 1)) return noSurface;
    ivec2 cell = min(ivec2(p), size - 2);
    vec2 f = p - vec2(cell);
    int index = base + cell.y * size.x + cell.x;
    vec4 s = mix(mix(sampleAt(index), sampleAt(index + 1), f.x),
                 mix(sampleAt(index + size.x), sampleAt(index + size.x + 1), f.x), f.y);
    vec3 normal = normalize(s.xyz);
    return vec4(normal, (x.y - s.w) * normal.y);
}
float heightAt(vec2 p, ivec2 size, int base)
{
    ivec2 cell = clamp(ivec2(p), ivec2(0), size - 2);
    int index = base + cell.y * size.x + cell.x;
    return bilinear(sampleAt(index).w, sampleAt(index + 1).w, sampleAt(index + size.x).w,
                    sampleAt(index + size.x + 1).w, clamp(p - vec2(cell), 0.0, 1.0));
}
vec4 heightSurfaceSampled(vec3 x, vec4 cells, ivec2 size, int base)
{
    vec2 p = x.xz * cells.xw;
    if (p.x < 0.0 || p.y < 0.0 || p.x > float(size.x - 1) || p.y > float(size.y - 1)) return noSurface;
    float here = heightAt(p, size, base);
    vec2 side = vec2(p.x + 1.0 <= float(size.x - 1) ? 1.0 : -1.0, p.y + 1.0 <= float(size.y - 1) ? 1.0 : -1.0);
    float alongX = heightAt(p + vec2(side.x, 0.0), size, base);
    float alongZ = heightAt(p + vec2(0.0, side.y), size, base);
    vec3 normal = normalize(vec3((here - alongX) * side.x * cells.x, 1.0, (here - alongZ) * side.y * cells.w));
    return vec4(normal, (x.y - here) * normal.y);
}
vec4 distanceSurface(vec3 x, float cell, vec4 last, int base)
{
    vec3 p = x * (1.0 / cell);
    vec3 inside = clamp(p, vec3(0.0), last.xyz);
    vec3 way = p - inside;
    float wayLength = length(way);
    vec3 corner = min(floor(inside), last.xyz - 1.0);
    vec3 f = inside - corner;
    int index = base + int((corner.y * (last.x + 1.0) + corner.x) * (last.z + 1.0) + corner.z);
    vec4 lower = sampleAt(index), upper = sampleAt(index + 1);
    vec4 corners = mix(lower, upper, f.z);
    vec4 climb = upper - lower;
    vec2 alongX = corners.yw - corners.xz;
    vec2 rows = corners.xz + alongX * f.x;
    vec2 climbs = mix(climb.xz, climb.yw, f.x);
    vec3 gradient = vec3(mix(alongX.x, alongX.y, f.y), rows.y - rows.x, mix(climbs.x, climbs.y, f.y)) / cell;
    gradient += 1e-7 * (p / last.xyz - 0.5) + vec3(0.0, 1e-12, 0.0);
    bool beyond = wayLength > 0.0;
    return vec4(normalize(beyond ? way : gradient), beyond ? wayLength * cell + last.w : mix(rows.x, rows.y, f.y));
}
uniform vec4 givenColliderParameters[3];
vec4 colliderParameters[3];
void loadColliderParameters()
{
    colliderParameters[0] = inRegister(givenColliderParameters[0]);
    colliderParameters[1] = inRegister(givenColliderParameters[1]);
    colliderParameters[2] = inRegister(givenColliderParameters[2]);
}
vec4 surfaceAt(vec3 anchor, vec3 position)
{
    Contact c = Contact(position, vec3(0.0));
    vec4 surface = planeSurface(anchor - colliderParameters[1].xyz, c.position, colliderParameters[2].xyz);
    return vec4(surface.xyz, surface.w - max(colliderParameters[0].z, contactRadius));
}
Contact answerTo(vec4 surface, vec3 position, vec3 velocity, Drift drift)
{
    struckLast = vec4(surface.xyz, surface.w < 0.0 ? colliderParameters[0].y : -1.0);
    struckVelocity = vec3(0.0);
    return answer(false, position, velocity, surface.w, surface.xyz, colliderParameters[0].x, colliderParameters[0].y, drift);
}
Contact collideAll(vec3 anchor, vec3 position, vec3 velocity, Drift drift)
{
    return answerTo(surfaceAt(anchor, position), position, velocity, drift);
}
float clearance(vec3 anchor, vec3 position, float time)
{
    return surfaceAt(anchor, position).w;
}
vec4 footing(vec3 anchor, vec3 position, float time)
{
    vec4 surface = surfaceAt(anchor, position);
    return vec4(surface.xyz, abs(surface.w) < restingSlack ? colliderParameters[0].y : -1.0);
}
const bool areTabled = false;
const int turns = 0;
const int mostTurns = 0;
bool nearKnown = false;
vec3 nearPlace;
float nearReach;
void gatherNear(vec3 anchor, vec3 position, float reach)
{
}
const bool collidersMove = false;
const bool areBounded = false;
float margin(vec3 anchor, vec3 position, vec3 velocity, float step, float time)
{
    return -1.0;
}
Contact collideAll(vec3 anchor, vec3 position, vec3 velocity, vec3 drifted, vec3 gravity, Drift drift, float time)
{
    return collideAll(anchor, position, velocity, drift);
}
vec3 dx[VERTICES];
vec3 dv[VERTICES];
const float noHistory = 0.0;
#define DRIFT(acceleration, beyond) Drift(driftOfStep.x, driftOfStep.y, driftOfStep.z, acceleration)
void forgetHistory()
{
}
vec3 wayBeyond(vec3 moved, vec3 gained, vec3 ended)
{
    return vec3(0.0);
}
bool changeHistory(vec3 shift, vec3 change, inout vec3 displacement, inout vec3 gained, vec3 ended)
{
    return false;
}
vec3 acceleration[VERTICES];
#define SPRUNG(i) acceleration[i]
const bool owesKick = SPRINGS;
#define OWED(i) (SPRINGS ? acceleration[i] * (0.5 * substep) : vec3(0.0))
void findFooting(float time)
{
}
void beginSolver()
{
    acceleration[0] = vec3(0.0);
}
void kickBySprings(int step, float kickTime)
{
    if (SPRINGS) {
        w[0] = v[0] + acceleration[0] * kickTime;
        springForces(float(step) * substep);
    }
    letGo(step);
    if (!SPRINGS) return;
    {
        acceleration[0] = isHeld(pinned[0]) ? vec3(0.0) : force[0] * inverseMass[0];
        v[0] += acceleration[0] * kickTime;
    }
}
void advance(int step)
{
    float halfStep = 0.5 * substep;
    kickBySprings(step, step == 0 ? 0.0 : halfStep);
    if (step > 0) thrust(false);
    thrust(false);
    {
        if (SPRINGS) v[0] += acceleration[0] * halfStep;
        probe[0] = x[0] + v[0] * halfStep;
    }
    if (isDirectional) surfaceNormals();
    sampleSubstep((float(step) + 0.5) * substep);
    driftAll();
}
void finishSolver()
{
    kickBySprings(substeps, 0.5 * substep);
    thrust(false);
}
vec3 touchPosition[VERTICES];
vec3 touchVelocity[VERTICES];
vec3 driftedBy[VERTICES];
vec3 beyondBy[VERTICES];
vec3 startPlace[VERTICES];
vec4 struck[VERTICES];
vec3 struckSurface[VERTICES];
float contactTime(int done)
{
    return collidersMove ? float(done) * substep : 0.0;
}
#define PRESSED(i) (SPRINGS && !RIGID_IMPACT ? LOAD(i) + SPRUNG(i) : LOAD(i))
#define DRIFT_OF(i) DRIFT(fallAt(anchor, touchPosition[i]) + PRESSED(i), beyondBy[i])
void beginAnswers()
{
    {
        startPlace[0] = x[0];
        struck[0] = vec4(0.0, 0.0, 0.0, -1.0);
        touchPosition[0] = x[0];
        touchVelocity[0] = v[0] + OWED(0);
        driftedBy[0] = v[0];
        beyondBy[0] = wayBeyond(dx[0], dv[0], v[0]);
    }
}
void acceptAnswers(float time)
{
    bool impact = false;
    {
        if (hasHistory && (touchPosition[0] != x[0] || touchVelocity[0] != v[0]))
            impact = changeHistory(touchPosition[0] - x[0], touchVelocity[0] - v[0], dx[0], dv[0], v[0]) || impact;
        touched = touched || touchPosition[0] != x[0] || touchVelocity[0] != v[0] + OWED(0);
        v[0] = owesKick ? withoutKick(touchVelocity[0], v[0], OWED(0)) : touchVelocity[0];
        x[0] = touchPosition[0];
    }
    if (impact) forgetHistory();
    findFooting(time);
}
bool mayAnswer()
{
    return taken() && !(MAY_BE_HELD && heldByContact);
}
void take(int k, Contact c)
{
    touchPosition[k] = c.position;
    touchVelocity[k] = c.velocity;
    struck[k] = struckLast;
    struckSurface[k] = struckVelocity;
}
void answerAsBody()
{
}
vec3 clearAround;
float clearRadius;
void beginContact()
{
    if (!areBounded) return;
    clearAround = x[0];
    clearRadius = 0.99 * clearance(anchor, clearAround, 0.0) - 1e-4;
}
bool mayTouch()
{
    if (!areBounded) return true;
    float away = 0.0;
    float fastest = 0.0;
    {
        vec3 apart = x[0] - clearAround;
        away = max(away, dot(apart, apart));
        fastest = max(fastest, dot(v[0], v[0]));
    }
    return !(sqrt(away) + sqrt(fastest) * substep < clearRadius);
}
vec4 seen[VERTICES];
bool findContacts(int done)
{
    float least = 1e30;
    touchPosition[0] = x[0];
    {
        if (keepsSurface) seen[0] = surfaceAt(anchor, touchPosition[0]);
        if (!isHeld(pinned[0])) least = min(least, keepsSurface ? seen[0].w : clearance(anchor, touchPosition[0], 0.0));
    }
    return mayAnswer() && least < 0.0;
}
void resolveContacts(int done)
{
    beginAnswers();
    {
        if (!isHeld(pinned[0])) {
            vec4 surface = seen[0];
            if (!keepsSurface) surface = surfaceAt(anchor, touchPosition[0]);
            take(0, answerTo(surface, touchPosition[0], touchVelocity[0], DRIFT_OF(0)));
        }
    }
    answerAsBody();
    acceptAnswers(contactTime(done));
}
#define ELEMENT vec4
vec4 stored(vec4 value)
{
    return value;
}
layout(std430) writeonly buffer NewState { ELEMENT newState[]; };
layout(std430) writeonly buffer NewRecords { vec4 newRecords[]; };
void storeRecord(int molecule)
{
    newRecords[molecule] = recordNow();
}
int ownMolecule()
{
    return int(gl_GlobalInvocationID.x);
}
bool isFirstLane()
{
    return row() == 0;
}
void shareElements(int first, int begin)
{
    for (int e = row(); e < POSITION_ELEMENTS; e += ROWS) {
        vec4 place = element(oldState, first, begin + e);
        vec4 velocity = element(oldState, first, begin + POSITION_ELEMENTS + e);
        for (int c = 0; c < 4; ++c) {
            sharedNumbers[sharedIndex(PLACES, 4 * e + c)] = place[c];
            sharedNumbers[sharedIndex(VELOCITIES, 4 * e + c)] = velocity[c];
        }
    }
    waitForGroup();
}
void loadState(int molecule)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    if (hasHistory) {
        shareElements(first, 2 * POSITION_ELEMENTS);
        {
            dx[0] = sharedVector(PLACES, vertexOf(0));
            dv[0] = sharedVector(VELOCITIES, vertexOf(0));
        }
        waitForGroup();
    }
    shareElements(first, 0);
    {
        x[0] = sharedVector(PLACES, vertexOf(0));
        v[0] = sharedVector(VELOCITIES, vertexOf(0));
    }
    loadInertia();
    if (!isMortal) return;
    vec2 life = packedLife(oldState, first);
    age = life.x;
    span = life.y;
}
void keepState(int molecule)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    {
        x[0] = packedVertex(oldState, first, 0, vertexOf(0));
        v[0] = packedVertex(oldState, first, POSITION_ELEMENTS, vertexOf(0));
        if (hasHistory) dx[0] = packedVertex(oldState, first, 2 * POSITION_ELEMENTS, vertexOf(0));
        if (hasHistory) dv[0] = packedVertex(oldState, first, 3 * POSITION_ELEMENTS, vertexOf(0));
    }
}
vec4 sharedElement(int array, int e)
{
    vec4 values;
    for (int c = 0; c < 4; ++c) {
        values[c] = 4 * e + c < 3 * MOLECULE_VERTICES ? sharedNumbers[sharedIndex(array, 4 * e + c)] : 0.0;
    }
    return values;
}
void storeElement(int first, int e, vec4 value)
{
    newState[first + e * BLOCK] = stored(value);
}
void storeState(int molecule)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    waitForGroup();
    {
        share(PLACES, 0, x[0]);
        share(VELOCITIES, 0, v[0]);
    }
    waitForGroup();
    for (int e = row(); e < POSITION_ELEMENTS; e += ROWS) {
        vec4 place = sharedElement(PLACES, e);
        vec4 velocity = sharedElement(VELOCITIES, e);
        if (isMortal && STATE_ELEMENTS % 2 == 0 && e == POSITION_ELEMENTS - 1) {
            place.w = age;
            velocity.w = span;
        }
        storeElement(first, e, place);
        storeElement(first, POSITION_ELEMENTS + e, velocity);
    }
    if (hasHistory) {
        waitForGroup();
        {
            share(PLACES, 0, dx[0]);
            share(VELOCITIES, 0, dv[0]);
        }
        waitForGroup();
        for (int e = row(); e < POSITION_ELEMENTS; e += ROWS) {
            storeElement(first, 2 * POSITION_ELEMENTS + e, sharedElement(PLACES, e));
            storeElement(first, 3 * POSITION_ELEMENTS + e, sharedElement(VELOCITIES, e));
        }
    }
    if (isMortal && STATE_ELEMENTS % 2 == 1 && isFirstLane()) storeElement(first, STATE_ELEMENTS - 1, vec4(age, span, 0.0, 0.0));
}
void run()
{
    beginContact();
    for (int done = 0; done < substeps; ++done) {
        advance(done);
        if (mayTouch() && findContacts(done + 1)) resolveContacts(done + 1);
    }
}
void loadParameters()
{
    loadUniforms();
    loadColliderParameters();
}
void writeNormals(int molecule)
{
}
void watch()
{
}
bool comesTooLate()
{
    return false;
}
void growOlder(int molecule)
{
}
vec3 latticeNear(vec3 p)
{
    return floor(p * 16.0f + 0.5f) * 0.0625f;
}
vec3 anchorShift(vec3 p)
{
    if (abs(p.x) <= 1.0f && abs(p.y) <= 1.0f && abs(p.z) <= 1.0f) return vec3(0.0f);
    return latticeNear(p);
}
vec3 cutShort()
{
    return vec3(uintBitsToFloat(0x7f800000u));
}
bool followAnchor()
{
    vec3 shift = anchorShift(firstPlace());
    x[0] -= shift;
    anchor += shift;
    return shift != vec3(0.0);
}
const int turnsLeft = LANE_A_VERTEX ? 64 : 0;
bool loopsEndEarly()
{
    bool early = areTabled && turns > mostTurns;
    if (!isSoftware) return early;
    int taken = 0;
    do {
        ++taken;
    } while (taken <= substeps + turnsLeft);
    return early || taken <= substeps + turnsLeft;
}
uniform bool probes;
vec3 gained[VERTICES];
void main()
{
    if (ISSUED_AHEAD && comesTooLate()) return;
    int molecule = ownMolecule();
    loadState(molecule);
    loadParameters();
    loadRecord(molecule);
    loadLoads(molecule);
    float mover = RESTS ? moverOf(molecule) : AWAKE;
    bool rests = RESTS && isResting(mover);
    bool probed = mover == COME_TO_REST || (RESTS && probes && rests);
    if (rests && !probed && !LANE_A_VERTEX) substeps = 0;
    bool isCutShort = MAY_BE_CUT && x[0] == cutShort();
    if (isCutShort && !LANE_A_VERTEX) substeps = 0;
    bool wasReleased = released;
    bool moved = ANCHORS_MOVE && followAnchor();
    takeRadius(scale, min((age + frameDuration) / max(span, 1e-9), 1.0));
    beginSolver();
    sampleFrame();
    run();
    finishSolver();
    if (MAY_BE_CUT) isCutShort = isCutShort || loopsEndEarly();
    if (rests) {
        gained[0] = probed ? v[0] : vec3(0.0);
        keepState(molecule);
        v[0] = gained[0];
        moved = false;
    }
    if (isCutShort) x[0] = cutShort();
    bool wasTaken = taken();
    growOlder(molecule);
    if (!wasTaken) {
        keepState(molecule);
        moved = false;
    }
    storeState(molecule);
    if (wasTaken) watch();
    if (isFirstLane() && (moved || released != wasReleased)) storeRecord(molecule);
    writeNormals(molecule);
}
