// Runs a scene for ten frames with the installed libraries and prints where its first vertex went.
#include <compile/plan.h>
#include <gpu/context.h>
#include <scene/json/scene_file.h>
#include <simulate/simulation.h>

#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    try {
        shoal::gpu::Context context;
        shoal::Simulation simulation(context, SHADERS, shoal::compile(shoal::readScene(argv[1])));
        const glm::dvec3 before = simulation.snapshot(0).positions[0];
        for (int i = 0; i < 10; ++i)
            simulation.frame();
        const glm::dvec3 after = simulation.snapshot(0).positions[0];
        std::printf("fell %.4f m in %.4f s\n", before.y - after.y, simulation.time());
        return before.y > after.y ? 0 : 1;
    } catch (const shoal::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
