// One of every kind of field, force and collider, with what is known of it, for the tests that go through all
// kinds: files, generated text, both execution paths against the reference, and the reference against closed
// forms.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/description.h"
#include "reference/problem.h"
#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "scene/force_kinds.h"
#include "support/shapes.h"

namespace shoal::test {

// A closed form: the velocity, or the acceleration, at a place at time 0.
struct Known {
    glm::dvec3 x{0}, value{0};
};

// A force or a field as a file gives it: written and read again. What the description leaves out becomes its
// default.
template <typename Thing>
Thing readBack(const Thing& thing) {
    const JsonValue written = describe(&thing).write(thing);
    JsonReader reader(written, "written.json");
    Thing out;
    describe(&out).read(reader, out);
    reader.finish();
    return out;
}

// u = (2 + 0.8 z, 0.5 x - 0.1 x z, 0.3 y) with z up, without its product x z, which no shear has.
inline ShearField shear() {
    ShearField out;
    out.velocity = {2, 0, 0};
    out.gradient = glm::dmat3(0);
    out.gradient[1][0] = 0.8;   // d ux / d y
    out.gradient[0][2] = -0.5;  // d uz / d x
    out.gradient[2][1] = -0.3;  // d uy / d z
    return out;
}

struct KindOfField {
    FieldShape shape;
    std::optional<Known> known = {};
};

inline std::vector<KindOfField> kindsOfField() {
    GustField gust;
    gust.direction = {2, 0.2, -1};
    gust.speed = 3;
    VortexField vortex;
    vortex.origin = {1, 0, 0.5};
    vortex.lift = 1;
    AbcField abc;
    abc.origin = {0.3, 0.1, 0};
    TaylorGreenField cells;
    cells.wavelength = 3;
    CurlNoiseField eddies;
    eddies.octaves = 2;
    eddies.seed = 8;
    GustField computedGust = gust;
    CurlNoiseField computedEddies = eddies;
    computedGust.noise = computedEddies.noise = NoiseForm::computed;
    GridField grid;
    grid.resolution = {3, 4, 5};
    grid.low = {-2, -1, -2};
    grid.high = {2, 4, 2};
    for (int i = 0; i < 60; ++i)
        grid.values.emplace_back(0.3f * float(i % 5) - 0.5f, 0.1f * float(i % 11),
                                 0.2f * float(i % 7) - 0.6f);
    GridField film = grid;  // evenly in time, and not
    film.times = {0.004, 0.02, 0.05};
    film.values.resize(180);
    for (size_t i = 60; i < 180; ++i)
        film.values[i] = film.values[i - 60] * 1.5f - glm::vec3(0.1f, 0, 0.2f);
    GridField loop = film;
    loop.times = {0, 0.01, 0.02};
    loop.repeats = true;
    WavesField waves;
    waves.depth = 3;
    waves.trains = {{{1, 0, 0.5}, 0.3, 4, 0.2}, {{-1, 0, 1}, 0.1, 2, 1}};
    const HurricaneField storm{{0.5, -1, 0.2}, 4, 0.7, 1.4, 0.3, 6, 0.1};
    return {{UniformField{{1, 0.2, -0.5}}, Known{{9, 9, 9}, {1, 0.2, -0.5}}},
            {gust},
            {shear(), Known{{1, 2, 3}, {3.6, -0.9, -0.5}}},
            {vortex, Known{{2, 7, 0.5}, {0, 0.5, -3}}},
            {abc, Known{{0.3, 0.1, 0}, {1, 1, 1}}},
            {cells, Known{{0, 0.75, 0}, {1, 0, 0}}},
            {eddies},
            {grid},
            {OscillatingField{{1, -0.4, 2}, 3, 0.6}},
            {film},
            {loop},
            {waves},
            {storm},
            {computedGust},
            {computedEddies}};
}

inline std::vector<Field> everyField() {
    std::vector<Field> out;
    for (KindOfField& kind : kindsOfField())
        out.push_back(field(std::move(kind.shape)));
    out[9].weight = 0.2, out[10].weight = 0.2;
    for (const size_t noise : {1, 6, 13, 14})  // by table and computed
        out[noise].weight = 0.5;
    out[0].weight = 0.8;
    out[2].weight = 0.5;
    out[3].box = Box{{-1.5, -5, -1.5}, {1.5, 6, 1.5}};
    return out;
}

struct KindOfForce {
    ForceShape shape;
    std::optional<Known> known = {};
};

inline std::vector<KindOfForce> kindsOfForce() {
    const AttractForce star{.position = {0, 1, 0}, .strength = 9, .radius = 0, .most = 1e4};
    AttractForce even{.position = {0, 0, 5}, .strength = -2, .radius = 6};
    even.falloff = AttractForce::Falloff::constant;
    return {{star, Known{{0, 1, 2}, {0, 0, -2.25}}},
            {VortexLineForce{.position = {1, 0, 2}, .pull = 2, .turn = 3}, Known{{2, 7, 2}, {-1, 0, -1.5}}},
            {ThrustForce{0.8, 4}},
            {ThrustForce{-0.2, 1}},
            {WindForce{{0.5, 0, 1}}},
            {even, Known{{0, 0, 1}, {0, 0, -2}}}};
}

inline std::vector<Force> everyForce() {
    std::vector<Force> out;
    for (KindOfForce& kind : kindsOfForce())
        out.emplace_back().shape = std::move(kind.shape);
    return out;
}

struct KindOfCollider {
    ColliderShape shape;
    glm::dvec3 x{0}, normal{0};  // a place, and the closed form there
    double distance = 0;         // m
};

inline std::vector<KindOfCollider> kindsOfCollider() {
    HeightFieldCollider stored;
    stored.columns = stored.rows = 2;
    stored.high = {1, 1};
    stored.heights.resize(4);
    HeightFieldCollider sampled = stored;
    sampled.sampledNormals = true;
    DistanceFieldCollider wall;  // x = 0.5, solid below it
    wall.field.grid.size = {2, 2, 2};
    wall.field.distances = {-0.5f, 0.5f, -0.5f, 0.5f, -0.5f, 0.5f, -0.5f, 0.5f};
    return {{PlaneCollider{{0, 1, 0}, {0, 0, 2}}, {5, 5, 3}, {0, 0, 1}, 3},
            {SphereCollider{}, {0, 0, 2.5}, {0, 0, 1}, 1.5},
            {stored, {0.5, 0.25, 0.4}, {0, 1, 0}, 0.25},
            {sampled, {0.5, -0.25, 0.4}, {0, 1, 0}, -0.25},
            {BoxCollider{}, {0.4, 0, 0}, {1, 0, 0}, -0.1},
            {BoxCollider{{0, 0, 0}, {1, 2, 3}, {0.5, 0.5, 0.5, 0.5}}, {0, 0, 1.5}, {0, 0, 1}, 0.5},
            {CapsuleCollider{{0, 0, 0}, {2, 0, 0}, 0.5}, {1, 0, 2}, {0, 0, 1}, 1.5},
            {wall, {0.75, 0.5, 0.5}, {1, 0, 0}, 0.25}};
}

inline reference::Problem fallInShear(const Molecule& molecule) {
    reference::Problem out{.molecule = &molecule, .gravity = {0, -9.81, 0}, .drag = {1, 1}};
    out.fields.push_back(field(shear()));
    return out;
}

inline reference::State fallInShearStart(const reference::Problem& problem) {
    return restState(problem, {.rotation = turned()}, {0.5, 0, 0}, yUp(0.6, -0.9, 0.4));
}

}  // namespace shoal::test
