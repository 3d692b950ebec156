// Shoal inside another program: simulated in its context of OpenGL, and drawn into its framebuffer.
#include <GL/glew.h>
#include <shoal/shoal.h>

#include <cstdio>
#include <vector>

#include "own_context.h"

int main() {
    try {
        OwnContext own;  // of the engine; it stays current
        shoal::gpu::ContextOptions options;
        options.shaders = SHADERS;
        options.loader = eglGetProcAddress;
        shoal::gpu::Context context(options);

        shoal::Scene scene = shoal::readScene(SHADERS "/../models/hello/hello.scene.json");
        scene.groups[0].color = glm::dvec3(0.8, 0.05, 0.05);
        const shoal::Plan plan = shoal::compile(scene);
        constexpr int width = 320, height = 180;
        shoal::Renderer renderer(context, scene, plan, {.width = width, .height = height});
        shoal::Simulation simulation(context, plan);

        GLuint texture = 0, framebuffer = 0;  // the engine's
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        for (int i = 0; i < 20; ++i)
            simulation.frame();
        renderer.draw(simulation.state(), shoal::View::fromCamera(scene.camera, simulation.time()));
        renderer.present(width, height, framebuffer);

        std::vector<unsigned char> pixels(size_t(width) * height * 4);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        int red = 0;
        for (size_t i = 0; i < pixels.size(); i += 4)
            red += pixels[i] > 2 * pixels[i + 1] && pixels[i] > 60;
        std::printf("%d red pixels of %d in the engine's framebuffer\n", red, width * height);
        return red > 200 && red < width * height / 2 && glGetError() == GL_NO_ERROR ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
