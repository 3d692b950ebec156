// The two paths agree: from the same state, one frame on each. And each repeats itself to the bit.
#include <algorithm>
#include <cmath>

#include "gl/feature_scenes.h"
#include "support/catch.h"

namespace shoal {

using test::FeatureScene;

namespace {

constexpr const char* shaders = SHOAL_SOURCE_DIR "/shaders";

Simulation on(Path path, const Plan& plan) {
    return Simulation(testContext(), shaders, plan, {.path = path});
}

// What one frame on each path, from one state, has come to. Where a vertex touches something or pins let go,
// a rounding decides in which substep: such molecules may be further apart, and are counted. (On Mesa's
// rasteriser none is.)
struct Comparison {
    int molecules = 0, contacts = 0, releases = 0;
    int excepted = 0;                  // beyond the tolerance, with a contact or a release
    int wrong = 0;                     // beyond the tolerance without
    double largest = 0, exempted = 0;  // deviations in molecule sizes, of the others and of the excepted
    double velocity = 0;               // likewise times the frame's duration, of the others
    double normal = 0;                 // of the others
};

// 1e-5 of a molecule's size; one rounding of a position, up to 1 m from its anchor, is 6e-8 m, and each of
// the frame's substeps makes a few. Velocities count as far as they carry in a frame.
constexpr double tolerance = 1e-5;

void compareGroup(const GroupPlan& group, const GroupState& before, const Snapshot& fused,
                  const Snapshot& pingPong, const GroupState& withContact, const GroupState& without,
                  double duration, Comparison& out) {
    const size_t vertices = size_t(group.vertexCount);
    for (size_t m = 0; m < size_t(group.count); ++m) {
        double position = 0, velocity = 0, normal = 0;
        bool contact = false;
        const double size = group.size * double(group.constants.scales[m]);
        for (size_t i = m * vertices; i < (m + 1) * vertices; ++i) {
            position = std::max(position, glm::length(fused.positions[i] - pingPong.positions[i]) / size);
            velocity = std::max(velocity,
                                glm::length(fused.velocities[i] - pingPong.velocities[i]) * duration / size);
            normal = std::max(normal, double(glm::length(fused.normals[i] - pingPong.normals[i])));
            // A pass that finds no contact hands on what it read: whatever differs in a bit was touched.
            contact |= withContact.positions[i] != without.positions[i] ||
                       withContact.velocities[i] != without.velocities[i];
        }
        const bool release = !before.released[m] && (fused.released[m] || pingPong.released[m]);
        ++out.molecules;
        out.contacts += contact;
        out.releases += release;
        const bool apart =
            !(position <= tolerance && velocity <= tolerance) || fused.released[m] != pingPong.released[m];
        if (apart && (contact || release)) {
            ++out.excepted;
            out.exempted = std::max(out.exempted, position);
            continue;
        }
        out.wrong += apart;
        out.largest = std::max(out.largest, position);
        out.velocity = std::max(out.velocity, velocity);
        out.normal = std::max(out.normal, normal);
    }
}

class Agreement {
  public:
    explicit Agreement(const Scene& scene)
        : plan_(compile(scene)),
          fused_(on(Path::fused, plan_)),
          pingPong_(on(Path::pingPong, plan_)),
          withoutContact_(on(Path::pingPong, planWithoutColliders(scene))) {}

    // The deviations of one frame from the state at the frame given, which is reached on the fused path.
    Comparison at(int frame) {
        test::run(fused_, frame - fused_.frames());
        const SavedState saved = fused_.save();
        for (Simulation* other : {&pingPong_, &withoutContact_}) {
            other->load(saved);
            other->frame();
        }
        fused_.frame();
        const SavedState touched = pingPong_.save(), untouched = withoutContact_.save();
        Comparison out;
        for (size_t g = 0; g < plan_.groups.size(); ++g)
            compareGroup(plan_.groups[g], saved.groups[g], fused_.snapshot(g), pingPong_.snapshot(g),
                         touched.groups[g], untouched.groups[g], fused_.parameters.frameTime, out);
        return out;
    }

  private:
    static Plan planWithoutColliders(Scene scene) {
        scene.colliders.clear();
        return compile(scene);
    }
    Plan plan_;
    Simulation fused_, pingPong_, withoutContact_;
};

bool canFuse() {
    if (testContext().info().computeShaders) return true;
    WARN("skipped: the fused path needs OpenGL 4.3");
    return false;
}

}  // namespace

TEST_CASE("the two paths agree on every scene", "[fused][agreement]") {
    if (!canFuse()) return;
    std::vector<FeatureScene> scenes = test::shippedScenes(300);
    REQUIRE(scenes.size() >= 2);
    for (FeatureScene& one : test::featureScenes())
        scenes.push_back(std::move(one));
    Comparison all;
    for (const FeatureScene& one : scenes) {
        Agreement agreement(one.scene);
        for (const int frame : {0, 60, 120}) {
            const Comparison c = agreement.at(frame);
            UNSCOPED_INFO(one.name << ", frame " << frame << ": " << c.molecules << " molecules, "
                                   << c.contacts << " with contact, " << c.releases << " released, "
                                   << c.excepted << " excepted (up to " << c.exempted << "); others apart by "
                                   << c.largest << ", velocities " << c.velocity << ", normals " << c.normal);
            CHECK(c.wrong == 0);
            CHECK(c.excepted < 0.05 * c.molecules);
            all.contacts += c.contacts;
            all.releases += c.releases;
        }
    }
    CHECK(all.contacts > 100);
    CHECK(all.releases > 5);
}

TEST_CASE("a run repeats itself, starts again and goes on from a saved state, bit for bit",
          "[fused][agreement]") {
    if (!canFuse()) return;
    for (const FeatureScene& one : test::featureScenes()) {
        // what differs between scenes here is the layout and what is carried on: a share of them will do
        if (one.name.find("field") == 0 || one.name.find("euler") != std::string::npos) continue;
        const Plan plan = compile(one.scene);
        for (const Path path : {Path::fused, Path::pingPong}) {
            INFO(one.name << " on the " << name(path) << " path");
            Simulation first = on(path, plan), other = on(path, plan);
            test::run(first, 7);
            const SavedState middle = first.save();
            test::run(first, 6);
            const uint64_t end = first.hash();

            test::run(other, 13);
            CHECK(other.hash() == end);
            other.restart();
            CHECK(other.hash() != end);
            test::run(other, 13);
            CHECK(other.hash() == end);

            Simulation third = on(path, plan);
            third.load(middle);
            CHECK(third.frames() == 7);
            CHECK(third.time() == middle.time);
            CHECK(third.save().groups == middle.groups);
            for (size_t g = 0; g < plan.groups.size(); ++g)
                CHECK(third.snapshot(g).normals.size() == plan.groups[g].start.positions.size());
            test::run(third, 6);
            CHECK(third.hash() == end);
            CHECK(third.time() == first.time());
        }
    }
}

TEST_CASE("a state crosses from one path to the other and back without a bit lost", "[fused][agreement]") {
    if (!canFuse()) return;
    for (const int count : {1, 31, 64, 1030}) {
        Scene scene = test::swarm(test::sheet(3, 3, true), count, SolverKind::leapfrog, {1e5, 2, 0});
        scene.gravity = {0, -9.81, 0};
        scene.groups[0].release = Release{{}, 5.0, 0};
        test::setStableSubsteps(scene);
        const Plan plan = compile(scene);
        Simulation fused = on(Path::fused, plan), pingPong = on(Path::pingPong, plan);
        CHECK(fused.save().groups == pingPong.save().groups);  // the same start
        CHECK(fused.save().groups[0] == plan.groups[0].start);
        test::run(fused, 5);
        const SavedState saved = fused.save();
        const auto released = std::count(saved.groups[0].released.begin(), saved.groups[0].released.end(), 1);
        if (count > 1) CHECK((released > 0 && released < count));
        pingPong.load(saved);
        CHECK(pingPong.save().groups == saved.groups);
        CHECK(pingPong.hash() == fused.hash());
        fused.restart();
        fused.load(pingPong.save());
        CHECK(fused.save().groups == saved.groups);
        CHECK(fused.frames() == 5);
    }
}

}  // namespace shoal
