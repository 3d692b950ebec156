// The text that a driver gets of one kernel of each form and of one pass of contact in both, kept as files,
// so that whoever reads a change sees what it does to them. SHOAL_UPDATE_SHADERS=1 writes them anew.
#include "core/file.h"
#include "gpu/array_table.h"
#include "gpu/shader_source.h"
#include "scene/collider_kinds.h"
#include "simulate/contact/facts.h"
#include "simulate/fused_kernel.h"
#include "support/catch.h"
#include "support/shapes.h"

using namespace shoal;

namespace {

const std::string shaders = SHOAL_SOURCE_DIR "/shaders";

void compare(const std::string& name, const std::string& text) {
    const std::string file = concat(SHOAL_SOURCE_DIR "/tests/golden/", name, ".glsl");
    if (!environment("SHOAL_UPDATE_SHADERS").empty()) writeFile(file, text);
    CAPTURE(name);
    CHECK(readFile(file) == text);
}

std::string kernelOf(const KernelOptions& options) {
    Scene scene;
    Group& group = scene.groups.emplace_back();
    group.name = "pairs";
    group.count = 1;
    group.molecule = test::pair(1, 2, 100, 1);
    scene.solver.kind = SolverKind::leapfrog;
    scene.colliders.emplace_back().shape = PlaneCollider{};
    return kernelShader(shaders, compile(scene), 0, options);
}

}  // namespace

TEST_CASE("kernels have the text that is kept", "[golden-shaders]") {
    compare("kernel_lane_a_molecule", kernelOf({.lanes = Lanes::molecule}));
    compare("kernel_lane_a_vertex", kernelOf({.lanes = Lanes::vertex}));
    compare("kernel_fragments", kernelOf({.targets = 8}));
}

TEST_CASE("a pass of contact has the text that is kept, in both forms", "[golden-shaders]") {
    using Form = gpu::ArrayTable::Form;
    const auto solve = [](Form form, const std::vector<std::string>& more, const char* header) {
        const ContactFacts facts = {.textures = form == Form::textures, .remembers = true};
        const gpu::ArrayTable table(shaders + "/contact/arrays.txt", form, facts.names());
        std::vector<std::string> defines = facts.defines();
        defines.insert(defines.end(), {"LIST 24", "MOST_COLLIDERS 3"});
        defines.insert(defines.end(), more.begin(), more.end());
        return gpu::resolveShader(shaders, "contact/response/solve.pass.glsl", defines, {}, header, &table)
            .text;
    };
    compare("contact_solve_buffers", solve(Form::buffers, {}, gpu::header430()));
    compare("contact_solve_textures", solve(Form::textures, {"TEXTURES", "ROW_BITS 6"}, gpu::header330()));
}
