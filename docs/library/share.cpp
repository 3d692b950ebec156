// The state where it lies, without a copy: a compute shader of this program reads the simulation's buffers.
#include <GL/glew.h>
#include <shoal/shoal.h>

#include <cmath>
#include <cstdio>

#include "own_context.h"

// The first vertex of every molecule, m, in world coordinates (simulate/state_view.h has the layout).
static const char* const source = R"(#version 430
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer State { vec4 state[]; };
layout(std430, binding = 1) readonly buffer Anchors { vec4 anchors[]; };
layout(std430, binding = 2) writeonly buffer Places { vec4 places[]; };
uniform int count, stride;
void main()
{
    int m = int(gl_GlobalInvocationID.x);
    if (m >= count) return;
    vec4 first = state[m / 16 * 16 * stride + m % 16];
    places[m] = vec4(first.xyz + anchors[m].xyz, 1.0);
}
)";

int main() {
    try {
        OwnContext own;
        shoal::gpu::ContextOptions options;
        options.shaders = SHADERS;
        options.loader = eglGetProcAddress;
        shoal::gpu::Context context(options);
        const shoal::Scene scene = shoal::readScene(SHADERS "/../models/hello/hello.scene.json");
        shoal::Simulation simulation(context, shoal::compile(scene));
        for (int i = 0; i < 20; ++i)
            simulation.frame();

        const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source);
        GLuint places = 0;
        glGenBuffers(1, &places);
        const shoal::SharedState shared = shoal::sharedState(simulation.state(), 0).at(0);
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, places);
        glBufferData(GL_SHADER_STORAGE_BUFFER, shared.count * 16, nullptr, GL_STATIC_READ);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        glUseProgram(program);
        glUniform1i(glGetUniformLocation(program, "count"), shared.count);
        glUniform1i(glGetUniformLocation(program, "stride"), shared.stride);
        const auto range = [](GLuint binding, GLuint buffer, size_t offset, size_t bytes) {
            glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer, GLintptr(offset), GLsizeiptr(bytes));
        };
        range(0, shared.buffer, shared.offset, shared.bytes);
        range(1, shared.anchors, shared.anchorOffset, shared.anchorBytes);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, places);
        glDispatchCompute(GLuint(shared.count + 63) / 64, 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        std::vector<glm::vec4> found(size_t(shared.count));
        glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, GLsizeiptr(found.size() * 16), found.data());

        const shoal::Snapshot state = simulation.snapshot(0);
        double worst = 0;
        for (size_t m = 0; m < found.size(); ++m)
            worst = std::max(
                worst, glm::distance(glm::dvec3(found[m]), state.positions[m * size_t(state.vertexCount)]));
        std::printf("%zu places read by our own shader, within %.2g m\n", found.size(), worst);
        return found.size() == 20 && worst < 1e-5 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
