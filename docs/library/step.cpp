// A scene made in code, without a file: stepped, changed while it runs, and read back.
#include <shoal/shoal.h>

#include <cmath>
#include <cstdio>

// Two masses and a spring.
static shoal::Molecule pair() {
    shoal::Molecule out;
    out.name = "pair";
    for (const double x : {0.0, 0.5})
        out.vertices.push_back({.position = {x, 0, 0}, .mass = 0.1});
    out.springs.push_back({.a = 0, .b = 1, .stiffness = 50, .damping = 0.1});
    return out;
}

int main() {
    try {
        shoal::Scene scene;
        scene.gravity = {0, -9.81, 0};
        scene.groups.push_back(shoal::groupOf(pair(), {{0, 4, 0}, {1, 4, 0}}));
        scene.colliders.push_back(shoal::colliderOf(shoal::PlaneCollider{}));

        shoal::gpu::Context context({.shaders = SHADERS});
        shoal::Simulation simulation(context, shoal::compile(scene));
        for (int i = 0; i < 30; ++i)
            simulation.frame();
        const double fell = 4 - simulation.snapshot(0).positions[0].y;
        simulation.parameters.gravity = {0, 9.81, 0};
        for (int i = 0; i < 30; ++i)
            simulation.frame();
        simulation.check();
        const shoal::Snapshot state = simulation.snapshot(0);  // double precision, world coordinates
        std::printf("fell %.3f m in half a second, then slowed down to %.2f m/s\n", fell,
                    state.velocities[0].y);
        return fell > 1.1 && fell < 1.3 && std::abs(state.velocities[0].y) < 0.2 ? 0 : 1;
    } catch (const shoal::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
