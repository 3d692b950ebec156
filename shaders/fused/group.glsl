// A workgroup for several molecules, its lanes spread over their vertices (fused/gather.glsl), for molecules that do not fit
// one lane's registers. For fused/frame.glsl.
#include "fused/buffers.glsl"

// One of the molecule's lanes does what is to be done once.
bool isFirstLane()
{
    return row() == 0;
}

// Loads an array of the state from 4-vector `begin` on, and the one behind it, through shared memory, so that every
// 4-vector is read once.
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
        for (int i = 0; i < VERTICES; ++i) {
            dx[i] = sharedVector(PLACES, vertexOf(i));
            dv[i] = sharedVector(VELOCITIES, vertexOf(i));
        }
        waitForGroup();
    }
    shareElements(first, 0);
    for (int i = 0; i < VERTICES; ++i) {
        x[i] = sharedVector(PLACES, vertexOf(i));
        v[i] = sharedVector(VELOCITIES, vertexOf(i));
    }
    loadInertia();
    if (!isMortal) return;
    vec2 life = packedLife(oldState, first);
    age = life.x;
    span = life.y;
}

// The molecule is stored as it was.
void keepState(int molecule)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    for (int i = 0; i < VERTICES; ++i) {
        x[i] = packedVertex(oldState, first, 0, vertexOf(i));
        v[i] = packedVertex(oldState, first, POSITION_ELEMENTS, vertexOf(i));
        if (hasHistory) dx[i] = packedVertex(oldState, first, 2 * POSITION_ELEMENTS, vertexOf(i));
        if (hasHistory) dv[i] = packedVertex(oldState, first, 3 * POSITION_ELEMENTS, vertexOf(i));
    }
}

// 4-vector e of an array, with zeros behind the vertices.
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
    for (int i = 0; i < VERTICES; ++i) {
        share(PLACES, i, x[i]);
        share(VELOCITIES, i, v[i]);
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
        for (int i = 0; i < VERTICES; ++i) {
            share(PLACES, i, dx[i]);
            share(VELOCITIES, i, dv[i]);
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
