#include <cmath>

#include "bench/particles.h"
#include "core/error.h"
#include "scene/field_kinds.h"
#include "scene/known_colliders.h"

namespace shoal::bench {

namespace {

using What = ParticleCase::What;

// UberFlow's table 2, frames a second at 512 x 512 and 1024 x 1024.
struct Published {
    double middle, large;
    double forSide(int side) const { return side == 512 ? middle : side == 1024 ? large : 0; }
};
constexpr Published motionOnly{320, 120}, heightField{96, 42}, sorted{8, 1.4}, contacts{31, 7}, onCpu{2, 0.4};

class Cases {
  public:
    std::vector<ParticleCase> all;

    void side(int side) {
        side_ = side;
        motion(false);
        motion(true);
        sort();
        contact();
        births(0.01);
        births(0.2);
        drawn();
    }
    void shares(int side) {
        side_ = side;
        for (const bool heights : {false, true}) {
            for (const int substeps : {1, 4}) {
                begin(concat(heights ? "share of a quad over a height field" : "share of a quad", ", ",
                             substeps, substeps == 1 ? " substep" : " substeps"));
                for (const bool quads : {false, true}) {
                    ParticleCase& particleCase = add(quads ? "quads" : "points");
                    particleCase.quads = quads;
                    particleCase.heights = heights;
                    particleCase.substeps = substeps;
                    particleCase.frameRate = 120;  // stable for the quads
                }
            }
        }
    }

  private:
    void begin(const std::string& group) { group_ = concat(group, ", ", side_, " x ", side_); }
    ParticleCase& add(const std::string& label) {
        ParticleCase& out = all.emplace_back();
        out.group = group_;
        out.label = label;
        out.side = side_;
        return out;
    }
    ParticleCase& loop() {
        ParticleCase& out = add("loop on the CPU and upload");
        out.what = What::cpuLoop;
        return out;
    }

    void motion(bool heights) {
        begin(heights ? "height field" : "motion");
        const size_t first = all.size();
        std::vector<SolverKind> kinds = {SolverKind::leapfrog, SolverKind::euler};
        if (!heights) kinds.insert(kinds.end(), {SolverKind::verlet, SolverKind::rk4});
        for (const SolverKind kind : kinds) {
            ParticleCase& particleCase = add(concat("fused, ", name(kind)));
            particleCase.solver = kind;
            particleCase.path = Path::fused;
            if (kind == SolverKind::euler)
                particleCase.published = (heights ? heightField : motionOnly).forSide(side_);
        }
        ParticleCase& inPlace = add("fused, leapfrog, in place");
        inPlace.path = Path::fused;
        inPlace.inPlace = true;
        add("fragments, leapfrog").path = Path::fragments;
        loop();
        add("copy of the state").what = What::copy;
        for (size_t i = first; i < all.size(); ++i)
            all[i].heights = heights;
    }
    void sort() {
        begin("sort");
        add("motion, radix sort").sort = SortMethod::radix;
        ParticleCase& bitonic = add("motion, bitonic sort");
        bitonic.sort = SortMethod::bitonic;
        bitonic.published = sorted.forSide(side_);
        ParticleCase& spread = add("motion, odd-even merge over 20 frames");
        spread.sort = SortMethod::oddEvenMerge;
        spread.spreadFrames = 20;
        ParticleCase& cpu = add("loop on the CPU, std::sort and upload");
        cpu.what = What::cpuLoop;
        cpu.sort = SortMethod::cpu;
        cpu.published = onCpu.forSide(side_);
    }
    void contact() {
        begin("contact");
        for (const Path path : {Path::fused, Path::fragments}) {
            ParticleCase& particleCase = add(concat(name(path), ", motion and contact"));
            particleCase.path = path;
            particleCase.contact = true;
            particleCase.published = contacts.forSide(side_);
        }
    }
    void births(double turnover) {
        begin(concat("births, ", 100 * turnover, " % a frame"));
        const size_t first = all.size();
        for (const Allocator allocator :
             {Allocator::gpu, Allocator::ring, Allocator::stack, Allocator::heap}) {
            for (const Path path : {Path::fused, Path::fragments}) {
                ParticleCase& particleCase = add(concat(name(path), ", allocator ", name(allocator)));
                particleCase.path = path;
                particleCase.allocator = allocator;
            }
        }
        loop();
        for (size_t i = first; i < all.size(); ++i)
            all[i].turnover = turnover;
    }
    void drawn() {
        begin("drawn");
        for (const ParticleShape shape :
             {ParticleShape::points, ParticleShape::sprites, ParticleShape::quads})
            add(name(shape)).drawn = shape;
    }

    int side_ = 0;
    std::string group_;
};

}  // namespace

std::vector<ParticleCase> particleCases(bool quick) {
    Cases out;
    out.shares(quick ? 128 : 1024);
    if (quick) {
        out.side(128);
        return out.all;
    }
    out.side(512);
    out.side(1024);
    return out.all;
}

static void addBirths(const ParticleCase& particleCase, Group& group) {
    const double born = particleCase.turnover * particleCase.count(), frames = 1 / particleCase.turnover;
    Lifecycle& life = group.life.emplace();
    life.allocator = *particleCase.allocator;
    life.capacity = particleCase.count() + particleCase.count() / 4;
    life.life = glm::dvec2(0.5, 1.5) * frames / particleCase.frameRate;
    Emitter& emitter = life.emitters.emplace_back();
    emitter.from = Emitter::From::box;
    emitter.box = group.place.box;
    emitter.rate = born * particleCase.frameRate;
    emitter.speed = {0, 1};
    emitter.spread = 3;
    group.count = 0;
}

// Gentle hills, about 1.5 m below the origin.
static HeightFieldCollider hills() {
    HeightFieldCollider out;
    out.columns = out.rows = 128;
    out.low = {-8, -8};
    out.high = {8, 8};
    for (int row = 0; row < out.rows; ++row)
        for (int column = 0; column < out.columns; ++column)
            out.heights.push_back(float(0.4 * std::sin(0.15 * column) * std::sin(0.11 * row) - 1.5));
    return out;
}

Scene particleScene(const ParticleCase& particleCase, const Molecule& point, const Molecule& quad) {
    Scene scene;
    scene.name = particleCase.label;
    scene.frameRate = particleCase.frameRate;
    scene.gravity = {0, -9.81, 0};
    scene.solver.kind = particleCase.solver;
    scene.solver.substeps = particleCase.substeps;
    scene.contact.steps = 1;
    scene.fields.emplace_back().shape = UniformField{{2, 0, 0.5}};
    if (particleCase.heights) scene.colliders.emplace_back().shape = hills();
    Group group;
    group.name = particleCase.quads ? "quads" : "points";
    group.molecule = particleCase.quads ? quad : point;
    group.count = particleCase.quads ? particleCase.count() / 4 : particleCase.count();
    group.held = false;
    group.place.box = {glm::dvec3(-6, -1, -6), glm::dvec3(5, 6, 5)};
    group.drag = {1, 1};
    if (particleCase.contact) {  // a fifth of a sphere in a cell
        const glm::dvec3 size = group.place.box.high - group.place.box.low;
        const double cell = std::cbrt(size.x * size.y * size.z * 0.2 / group.count);
        group.contact.emplace().radius = cell / 4.2;
    }
    if (particleCase.allocator) addBirths(particleCase, group);
    if (particleCase.drawn) {
        ParticleType& type = group.particle.emplace();
        type.shape = *particleCase.drawn;
        type.blend = Blend::additive;
        group.molecule = moleculeOf(type);
    }
    scene.groups.push_back(group);
    scene.light.shadows = false;
    scene.camera.eye = {0, 3, 16};
    scene.camera.target = {0, 1, 0};
    return scene;
}

}  // namespace shoal::bench
