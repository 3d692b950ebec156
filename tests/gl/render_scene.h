// Small scenes for the tests of pictures: one square molecule before an empty sky.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "compile/plan.h"
#include "gl/gl_test.h"
#include "render/renderer.h"
#include "simulate/simulation.h"

namespace shoal::test {

// A square in the xy plane around its own origin, facing +Z.
inline Molecule squareMolecule(double side) {
    Molecule out;
    out.name = "square";
    const double h = side / 2;
    for (const glm::dvec2 uv : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)})
        out.vertices.push_back(
            {.position = {(2 * uv.x - 1) * h, (2 * uv.y - 1) * h, 0}, .uv = uv, .mass = 1e-3});
    out.triangles = {{0, 1, 2}, {0, 2, 3}};
    out.material.color = {0.6, 0.1, 0.1};
    return out;
}

// Squares at the places given, seen from 3 m along +Z; the sun stands behind the camera.
inline Scene sceneOfSquares(const std::vector<glm::dvec3>& places, double side = 0.4) {
    Scene scene;
    scene.name = "squares";
    Group group;
    group.name = "squares";
    group.molecule = squareMolecule(side);
    group.count = int(places.size());
    group.place.kind = Placement::Kind::list;
    group.place.turn = Placement::Turn::none;
    for (const glm::dvec3& place : places)
        group.place.items.push_back({.position = place});
    scene.groups.push_back(std::move(group));
    scene.camera.eye = {0, 0, 3};
    scene.camera.target = {0, 0, 0};
    scene.light.direction = {0, -0.3, -1};
    return scene;
}

struct Shown {
    Image image;
    gpu::Traffic moved;  // by the drawing alone
    bool stateUnchanged = true;
};

// The scene after some frames, 160 x 120 unless told otherwise.
inline Shown show(const Scene& scene, int frames = 1, RenderOptions options = {.width = 160, .height = 120},
                  double time = 0) {
    gpu::Context& context = testContext();
    const Plan plan = compile(scene);
    Renderer renderer(context, scene, plan, options);
    Simulation simulation(context, plan, {.path = testPath()});
    for (int i = 0; i < frames; ++i)
        simulation.frame();
    Shown out;
    const uint64_t before = simulation.hash();
    const gpu::Traffic start = context.traffic();
    renderer.draw(simulation.state(), View::fromCamera(scene.camera, time));
    out.moved = context.traffic() - start;
    out.stateUnchanged = simulation.hash() == before;
    out.image = renderer.capture();
    context.checkErrors("after a picture");
    return out;
}

inline glm::ivec3 pixel(const Image& image, int x, int y) {
    const uint8_t* p = &image.pixels[size_t(y * image.width + x) * 4];
    return {p[0], p[1], p[2]};
}

inline int difference(const glm::ivec3& a, const glm::ivec3& b) {
    const glm::ivec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

inline int brightness(const glm::ivec3& c) {
    return c.x + c.y + c.z;
}

// Where two pictures differ: how many pixels and the middle of them.
struct Changed {
    int count = 0;
    glm::dvec2 centroid{0};  // pixels from the upper left; a pixel's own middle is at + 0.5
    int most = 0;
};

inline Changed changed(const Image& a, const Image& b, int above) {
    Changed out;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const int d = difference(pixel(a, x, y), pixel(b, x, y));
            out.most = std::max(out.most, d);
            if (d <= above) continue;
            ++out.count;
            out.centroid += glm::dvec2(x + 0.5, y + 0.5);
        }
    }
    if (out.count > 0) out.centroid /= double(out.count);
    return out;
}

// The pixels between the edges of what differs from an empty picture.
struct Extent {
    int width = 0, height = 0;
};

inline Extent extentOf(const Image& image, const Image& empty) {
    int left = image.width, right = -1, top = image.height, bottom = -1;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (difference(pixel(image, x, y), pixel(empty, x, y)) > 60) {
                left = std::min(left, x);
                right = std::max(right, x);
                top = std::min(top, y);
                bottom = std::max(bottom, y);
            }
    return {right - left + 1, bottom - top + 1};
}

}  // namespace shoal::test
