// The camera of the windows: its eye stays above the ground.
#include <cmath>

#include "scene/known_colliders.h"
#include "support/catch.h"
#include "window/orbit_camera.h"

using namespace shoal;
using namespace shoal::window;

namespace {

Scene hilly() {
    Scene scene;
    Collider plane{"floor", "", PlaneCollider{{0, -1, 0}, glm::normalize(glm::dvec3(0, 1, 0.5))}};
    Collider wall{"wall", "", PlaneCollider{{0, 9, 0}, {1, 0, 0}}};
    HeightFieldCollider hill;
    hill.columns = hill.rows = 2;
    hill.low = {2, 2};
    hill.high = {4, 4};
    hill.level = 1;
    hill.heights = {0, 1, 2, 5};
    scene.colliders = {plane, wall, Collider{"hill", "", hill}};
    return scene;
}

View start() {
    View view;
    view.eye = {0, 1, 5};
    view.target = {0, 0.5, 0};
    return view;
}

}  // namespace

TEST_CASE("the ground is the highest of what faces up", "[orbit-camera]") {
    const Scene scene = hilly();
    CHECK(groundHeight(scene, 0, 0) == Approx(-1));
    CHECK(groundHeight(scene, 0, 2) == Approx(-2));
    CHECK(groundHeight(scene, 2, 2) == Approx(1));
    CHECK(groundHeight(scene, 4, 4) == Approx(6));
    CHECK(groundHeight(scene, 3, 3) == Approx(6));  // no lower than the surface
    CHECK(groundHeight(scene, 5, 3) == Approx(-1 - 1.5));
    CHECK(std::isinf(groundHeight(Scene(), 0, 0)));
}

TEST_CASE("however it is moved, the eye stays above the ground", "[orbit-camera]") {
    const auto slope = [](double x, double) { return 0.3 * x; };
    OrbitCamera camera(start());
    camera.standOn(slope);
    for (int step = 0; step < 400; ++step) {
        if (step % 4 == 0) camera.turn(0.13, -0.4);
        if (step % 4 == 1) camera.pan(0.02, step < 200 ? -0.03 : 0.03);
        if (step % 4 == 2) camera.zoom(step % 3 - 1);
        if (step % 4 == 3) camera.lookFrom(step, -0.5);
        const glm::dvec3 eye = camera.view().eye;
        REQUIRE(eye.y > slope(eye.x, eye.z));
    }
}

TEST_CASE("a turn that the ground has stopped goes back at once", "[orbit-camera]") {
    OrbitCamera camera(start());
    camera.standOn([](double, double) { return 0.0; });
    for (int i = 0; i < 10; ++i)
        camera.turn(0, -0.5);
    const double lowest = camera.view().eye.y;
    CHECK(lowest > 0);
    camera.turn(0, 0.02);
    CHECK(camera.view().eye.y > lowest + 0.2);
}

TEST_CASE("a scene that is seen from below the ground, or has none, is seen from anywhere",
          "[orbit-camera]") {
    for (const bool ground : {true, false}) {
        OrbitCamera camera(start());
        if (ground) camera.standOn([](double, double) { return 3.0; });
        CHECK(glm::distance(camera.view().eye, start().eye) < 1e-9);
        camera.turn(0, -1);
        CHECK(camera.view().eye.y < -4);
    }
}
