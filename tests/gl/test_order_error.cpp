// How far from exact the approximate orders of blended molecules are, and what they cost: the tables of
// docs/sorting.md. Hidden, because it measures: shoal-gl "[.order]".
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <random>

#include "gl/blending.h"
#include "render/draw_order.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr RenderOptions pictureSize = {.width = 320, .height = 240, .timing = gpu::PassTimers::Mode::finish};

// Squares at random in a box of 2 m, turned at random.
Scene sceneInBox(int count, double side, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1, 1), angle(0, 6.28);
    std::vector<glm::dvec3> places;
    for (int i = 0; i < count; ++i)
        places.emplace_back(place(random), place(random), place(random));
    Scene scene = sceneOfSquares(places, side);
    for (Placement::Item& item : scene.groups[0].place.items)
        item.rotation =
            glm::angleAxis(angle(random), glm::normalize(glm::dvec3(place(random), 1, place(random))));
    Material& material = scene.groups[0].molecule.material;
    material.blend = Blend::alpha;
    material.opacity = 0.5;
    scene.light.shadows = false;
    return scene;
}

View viewAt(double angle) {
    View view;
    view.eye = {4 * std::sin(angle), 0.5, 4 * std::cos(angle)};
    view.target = {0, 0, 0};
    return view;
}

struct Difference {
    double mean = 0;   // of 255, over pixels and channels
    double share = 0;  // of pixels that differ by more than 8 of 255
};

Difference differenceOf(const Image& a, const Image& b) {
    Difference out;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const glm::ivec3 d = glm::abs(pixel(a, x, y) - pixel(b, x, y));
            out.mean += (d.x + d.y + d.z) / 3.0;
            out.share += std::max({d.x, d.y, d.z}) > 8;
        }
    }
    const double pixels = double(a.width) * a.height;
    return {out.mean / pixels, out.share / pixels};
}

double milliseconds(Renderer& renderer, const char* name) {
    for (const gpu::PassTime& pass : renderer.timers().report())
        if (pass.name == name) return pass.min * 1e3;
    return 0;
}

// Share of all pairs of molecules that stand the wrong way round: inversions, counted by merging.
uint64_t inversions(std::vector<double>& depths, std::vector<double>& scratch, size_t first, size_t end) {
    if (end - first < 2) return 0;
    const size_t middle = (first + end) / 2;
    uint64_t out = inversions(depths, scratch, first, middle) + inversions(depths, scratch, middle, end);
    size_t a = first, b = middle, to = first;
    while (a < middle || b < end) {
        const bool left = b == end || (a < middle && depths[a] >= depths[b]);
        if (!left) out += middle - a;
        scratch[to++] = left ? depths[a++] : depths[b++];
    }
    std::copy(scratch.begin() + long(first), scratch.begin() + long(end), depths.begin() + long(first));
    return out;
}

double wrongPairs(const Scene& scene, const View& view, const std::vector<KeyIndex>& order) {
    const glm::dvec3 forward = glm::normalize(view.target - view.eye);
    std::vector<double> depths, scratch(order.size());
    for (const KeyIndex& one : order)
        depths.push_back(glm::dot(scene.groups[0].place.items[one.index].position - view.eye, forward));
    const double pairs = 0.5 * double(order.size()) * double(order.size() - 1);
    return double(inversions(depths, scratch, 0, depths.size())) / pairs;
}

}  // namespace

TEST_CASE("the error across groups against the number of slabs", "[.order]") {
    const int count = 1000;
    Scene scene = sceneInBox(count, 0.25, 1);
    scene.groups[0].molecule.material.color = {0.8, 0.1, 0.05};
    Group other = sceneInBox(count, 0.25, 2).groups[0];
    other.name = "others";
    other.molecule.material.color = {0.05, 0.2, 0.8};
    scene.groups.push_back(other);
    const Plan plan = compile(scene);
    const Simulation simulation(testContext(), plan, {.path = testPath()});
    const auto picture = [&](int slabs, double& time) {
        RenderOptions options = pictureSize;
        options.slabs = slabs;
        Renderer renderer(testContext(), scene, plan, options);
        for (int i = 0; i < 5; ++i)
            renderer.draw(simulation.state(), viewAt(0.3));
        time = milliseconds(renderer, "blended");
        return renderer.capture();
    };
    double time = 0;
    const Image exact = picture(1024, time);  // a slab for every molecule of one group
    std::printf("slabs  mean of 255  pixels off by > 8  blended ms\n");
    for (const int slabs : {1, 2, 4, 8, 16, 32, 64, 128, 256, 512}) {
        const Difference d = differenceOf(picture(slabs, time), exact);
        std::printf("%5d %12.3f %17.2f%% %11.1f\n", slabs, d.mean, 100 * d.share, time);
    }
}

TEST_CASE("the error of a spread order on a moving camera against its saving", "[.order]") {
    const int count = 16384;
    Scene scene = sceneInBox(count, 0.05, 1);
    Material& material = scene.groups[0].molecule.material;
    material.color = {0.8, 0.1, 0.05};
    material.secondColor = glm::dvec3(0.05, 0.2, 0.8);
    material.sort = DrawSort::frame;
    const double step = 0.5 / 60;  // rad a frame: half a radian a second
    const Plan plan = compile(scene);
    const Simulation simulation(testContext(), plan, {.path = testPath()});
    Renderer exact(testContext(), scene, plan, pictureSize);
    std::printf("frames  wrong pairs  mean of 255  pixels off by > 8  order ms\n");
    for (const int frames : {1, 2, 5, 10, 20, 50, 105}) {
        material.sort = DrawSort::spread;
        material.spreadFrames = frames;
        Renderer renderer(testContext(), scene, plan, pictureSize);
        double wrong = 0, mean = 0, share = 0;
        int taken = 0;
        for (int frame = 0; frame < 3 * frames + 10; ++frame) {
            const View view = viewAt(frame * step);
            renderer.draw(simulation.state(), view);
            // over whole turns of the sort, at up to 30 frames of them
            if (frame < frames + 10 || (frame * 30) % (2 * frames) >= 30) continue;
            exact.draw(simulation.state(), view);
            const Difference d = differenceOf(renderer.capture(), exact.capture());
            wrong += wrongPairs(scene, view, renderer.orderOf(0)->download());
            mean += d.mean;
            share += d.share;
            ++taken;
        }
        std::printf("%6d %11.3f%% %12.3f %17.2f%% %9.2f\n", frames, 100 * wrong / taken, mean / taken,
                    100 * share / taken, milliseconds(renderer, "order"));
    }
    std::printf("sorted in every frame: order %.2f ms, blended %.1f ms\n", milliseconds(exact, "order"),
                milliseconds(exact, "blended"));
}
