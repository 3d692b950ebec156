// Colours by speed: at known speeds those of the scale.
#include "gl/render_scene.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

const glm::dvec3 slow(0.05, 0.1, 0.7), middle(0.1, 0.6, 0.2), fast(0.8, 0.3, 0.02);

// A square before the camera, away from which it moves at a speed; it is there for one short frame.
Scene squareAt(double speed, const std::vector<glm::dvec3>& colors) {
    Scene scene = sceneOfSquares({{0, 0, 0}}, 1);
    scene.frameRate = 1e4;
    scene.groups[0].velocity = {0, 0, -speed};
    scene.groups[0].colorBy = ColorScale{.from = 1, .to = 5, .colors = colors};
    return scene;
}

glm::ivec3 shownAt(double speed, const std::vector<glm::dvec3>& colors) {
    return pixel(show(squareAt(speed, colors)).image, 80, 60);
}

// As shaders/render/tone.glsl has it.
glm::dvec3 onScreen(const glm::dvec3& light) {
    const glm::dvec3 x = light * 0.5;
    const glm::dvec3 c =
        glm::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), glm::dvec3(0), glm::dvec3(1));
    return 255.0 * (1.055 * glm::pow(c, glm::dvec3(1 / 2.4)) - 0.055);
}

}  // namespace

TEST_CASE("a molecule has the scale's colour at its speed", "[render][colorBy]") {
    const std::vector<glm::dvec3> colors = {slow, middle, fast};
    const auto plain = [&](const glm::dvec3& c) { return shownAt(1, {c, c}); };
    CHECK(difference(shownAt(0, colors), plain(slow)) <= 1);  // below the first: its colour
    CHECK(difference(shownAt(1, colors), plain(slow)) <= 1);
    CHECK(difference(shownAt(2, colors), plain(0.5 * (slow + middle))) <= 1);
    CHECK(difference(shownAt(3, colors), plain(middle)) <= 1);
    CHECK(difference(shownAt(4.5, colors), plain(0.25 * middle + 0.75 * fast)) <= 1);
    CHECK(difference(shownAt(9, colors), plain(fast)) <= 1);
    CHECK(difference(plain(slow), plain(fast)) > 60);
    CHECK(difference(plain(slow), plain(middle)) > 60);
}

TEST_CASE("a spinning molecule has the colour of its mean velocity", "[render][colorBy]") {
    Scene scene = squareAt(2, {slow, middle, fast});
    scene.groups[0].spin = {0, 0, 40};
    CHECK(difference(pixel(show(scene).image, 80, 60), shownAt(2, {slow, middle, fast})) <= 1);
}

TEST_CASE("points and particles are coloured by their speed as well", "[render][colorBy]") {
    Scene scene = squareAt(3, {slow, middle, fast});
    Molecule& molecule = scene.groups[0].molecule;
    molecule.vertices.resize(1);
    molecule.vertices[0].position = {0, 0, 0};
    molecule.triangles.clear();
    molecule.material.pointSize = 0.6;
    Scene plain = scene;
    plain.groups[0].colorBy->colors = {middle, middle};
    CHECK(difference(pixel(show(scene).image, 80, 60), pixel(show(plain).image, 80, 60)) <= 1);

    // A particle that sends its own light shows the colour itself.
    ParticleType type;
    type.size = {0.6, 0.6};
    type.blend = Blend::none;
    scene.groups[0].particle = type;
    scene.groups[0].molecule = moleculeOf(type);
    const glm::dvec3 wanted = onScreen(middle);
    const glm::ivec3 seen = pixel(show(scene).image, 80, 60);
    for (int c = 0; c < 3; ++c)
        CHECK(seen[c] == Approx(wanted[c]).margin(2));
}
