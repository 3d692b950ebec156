// Measures an expert's CPU code of the euler method: scalar, AVX2 and AVX-512, and a plain copy of the same
// state. Reports only, in ns per molecule and frame. Every case runs the same 10 frames once a round, round
// after round, so that a machine whose speed drifts drifts for all alike. Minima take each frame at its
// fastest round, and the mean of those; the median is of all frames. `cpu` is the processor time of the
// slowest thread, which other programs lengthen less than the clock on the wall; `times scalar` compares it.
//
// Two states: falling (frames 3 to 12 of a fall from up to 6 m: some have landed) and landed (after 4 s, when
// nearly every vertex touches the ground in every substep).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "app/bullet_baseline.h"
#include "bench/baseline.h"
#include "bench/baseline_threads.h"
#include "molecule/molecule_file.h"
#include "reference/discrete.h"

using namespace shoal;
using namespace shoal::bench;

namespace {

constexpr size_t framesPerRound = 10;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

struct Result {
    std::string what;
    // s, per frame of a round
    std::vector<double> leastWall = std::vector<double>(framesPerRound, 1e30), leastCpu = leastWall;
    std::vector<double> walls{};  // s, of all frames

    void add(size_t frame, double wall, double cpu) {
        leastWall[frame] = std::min(leastWall[frame], wall);
        leastCpu[frame] = std::min(leastCpu[frame], cpu);
        walls.push_back(wall);
    }
    double wall() const { return sum(leastWall) / framesPerRound; }
    double cpu() const { return sum(leastCpu) / framesPerRound; }
    double medianWall() const {
        std::vector<double> sorted = walls;
        std::sort(sorted.begin(), sorted.end());
        return sorted[sorted.size() / 2];
    }
};

// The state from one place to another, each thread its share: what memory allows at best.
class Copy {
  public:
    Copy(size_t bytes, int threads) : from_(bytes, 1), to_(bytes, 0), team_(threads) {}

    void frame() {
        team_.run([this](int index) {
            const size_t first = from_.size() * size_t(index) / size_t(team_.count());
            const size_t last = from_.size() * size_t(index + 1) / size_t(team_.count());
            std::memcpy(to_.data() + first, from_.data() + first, last - first);
        });
    }

    double processorTime() const { return team_.slowest(); }

  private:
    std::vector<char> from_, to_;
    PinnedThreads team_;
};

struct Case {
    const char* name;
    int count;
    bool landed;
    Molecule molecule = readMolecule(concat(SHOAL_SOURCE_DIR "/molecules/", name, ".json"));
    std::vector<glm::vec3> positions{}, velocities{};
    std::vector<Baseline> forms{};
    std::unique_ptr<Copy> copy{};
    std::vector<Result> results{};  // of the forms, then of the copy
};

BaselineStep workload() {
    constexpr double gamma = 1;  // 1/s
    BaselineStep out;
    out.gravity = {0, -9.81f, 0};
    out.wind = {2, 0, 0.5f};
    out.decay = float(-std::expm1(-gamma * double(out.h)));
    out.phi = float(-std::expm1(-gamma * double(out.h)) / gamma);
    return out;
}

// Above 40 m by 40 m of ground.
void place(Case& one) {
    Scene scene;
    Group& group = scene.groups.emplace_back();
    group.molecule = one.molecule;
    group.count = one.count;
    group.place.box = {{-20, one.molecule.size(), -20}, {20, 6, 20}};
    group.place.turn = Placement::Turn::any;
    const reference::Problem problem{.molecule = &one.molecule};
    for (const Instance& instance : shoal::place(scene, 0)) {
        const reference::State state = restState(problem, instance);
        one.positions.insert(one.positions.end(), state.position.begin(), state.position.end());
        one.velocities.insert(one.velocities.end(), state.velocity.begin(), state.velocity.end());
    }
}

void prepare(Case& one, int threads) {
    place(one);
    for (const Simd simd : {Simd::scalar, Simd::avx2, Simd::avx512}) {
        if (!available(simd)) continue;
        one.forms.emplace_back(one.molecule, one.count, simd, threads);
        one.results.push_back({name(simd)});
    }
    one.copy = std::make_unique<Copy>(one.forms[0].bytesPerMolecule() * size_t(one.count), threads);
    one.results.push_back({"copy"});
    if (!one.landed) return;
    Baseline& fastest = one.forms.back();
    fastest.set(one.positions, one.velocities);
    for (int i = 0; i < 240; ++i)
        fastest.frame(workload());
    fastest.get(one.positions, one.velocities);
}

template <class Form, class... Step>
void time(Result& result, Form& form, const Step&... step) {
    form.frame(step...);
    form.frame(step...);
    for (size_t i = 0; i < framesPerRound; ++i) {
        const double start = now();
        form.frame(step...);
        result.add(i, now() - start, form.processorTime());
    }
}

void runRound(Case& one) {
    for (size_t i = 0; i < one.forms.size(); ++i) {
        one.forms[i].set(one.positions, one.velocities);
        time(one.results[i], one.forms[i], workload());
    }
    time(one.results.back(), *one.copy);
}

void print(const Case& one) {
    const size_t bytes = one.forms[0].bytesPerMolecule();
    std::printf("\n%d %s, %s, %zu bytes a molecule\n", one.count, one.name, one.landed ? "landed" : "falling",
                bytes);
    std::printf("  %-8s %10s %12s %12s %16s\n", "", "cpu: min", "wall: min", "median", "times scalar");
    for (const Result& result : one.results) {
        const auto each = [&](double seconds) { return seconds * 1e9 / one.count; };
        std::printf("  %-8s %10.2f %12.2f %12.2f", result.what.c_str(), each(result.cpu()),
                    each(result.wall()), each(result.medianWall()));
        if (&result == &one.results.back())
            std::printf(" %11.1f GB/s read and written\n", 2 * double(bytes) / each(result.cpu()));
        else
            std::printf(" %16.1f\n", one.results[0].cpu() / result.cpu());
    }
}

// Bullet, on one thread, with one step a frame and with four: few molecules, for it gains nothing from many.
void printBullet() {
    if (!bulletAvailable()) return;
    const Molecule molecule = readMolecule(SHOAL_SOURCE_DIR "/molecules/quad.json");
    constexpr int count = 256;
    std::printf("\n%d quads as soft bodies of Bullet, one thread\n  %-24s %14s %13s %15s\n", count, "",
                "falling: min ns", "landed: min ns", "lowest vertex m");
    for (const int substeps : {1, 4}) {
        for (const auto& [merged, words] : {std::pair{false, "a body each"}, {true, "all in one body"}}) {
            const std::unique_ptr<BulletBaseline> bullet = makeBullet(molecule, count, merged);
            double least[] = {1e30, 1e30};  // s: falling, landed
            for (int i = 0; i < 240; ++i) {
                const double start = now();
                for (int k = 0; k < substeps; ++k)
                    bullet->frame(1.0 / 60 / substeps);
                double& one = least[i >= 120];
                if (i < 12 || i >= 228) one = std::min(one, now() - start);
            }
            std::printf("  %-15s %d a frame %15.0f %14.0f %15.4f\n", words, substeps, least[0] * 1e9 / count,
                        least[1] * 1e9 / count, bullet->lowestHeight());
        }
    }
}

}  // namespace

// Arguments: the number of rounds (default 5); --threads N (default 2).
static int measureAll(int argc, char** argv) {
    int rounds = 5, threads = 2;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc)
            threads = std::max(1, std::atoi(argv[++i]));
        else
            rounds = std::max(1, std::atoi(argv[i]));
    }
    std::printf("4 substeps of 1/240 s a frame, %d pinned threads, %d rounds of %zu frames\n", threads,
                rounds, framesPerRound);
    std::vector<Case> cases;
    for (const bool landed : {false, true}) {
        for (const auto& [molecule, count] :
             {std::pair{"quad", 16384}, {"quad", 131072}, {"cross", 16384}, {"fish", 16384}})
            cases.push_back({molecule, count, landed});
    }
    for (Case& one : cases)
        prepare(one, threads);
    for (int round = 0; round < rounds; ++round) {
        for (Case& one : cases)
            runRound(one);
        std::fprintf(stderr, "round %d of %d\n", round + 1, rounds);
    }
    for (const Case& one : cases)
        print(one);
    printBullet();
    return 0;
}

int main(int argc, char** argv) {
    try {
        return measureAll(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shoal-baseline: %s\n", error.what());
        return 1;
    }
}
