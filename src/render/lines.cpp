#include "render/lines.h"

#include <algorithm>

#include "gpu/gl.h"
#include "gpu/shader_source.h"

namespace shoal {

namespace {

struct Corner {
    glm::vec3 place, color;
};
constexpr size_t cornersOfLine = 6;  // two triangles: lines of OpenGL's own are a pixel wide at most

// Half a line's width across it, as seen from the eye, at one of its ends.
glm::vec3 across(const glm::vec3& end, const glm::vec3& along, double width, const Eye& eye) {
    const glm::vec3 side = glm::cross(along, end);
    const float length = glm::length(side);
    if (!(length > 0)) return glm::vec3(0);
    return side * (float(0.5 * width) / eye.pixelsPerMeter * glm::length(end) / length);
}

}  // namespace

LineDrawer::LineDrawer(gpu::Context& context) : context_(&context) {}

void LineDrawer::hold(size_t lines) {
    if (lines <= room_) return;
    room_ = std::max(lines, 2 * room_);
    corners_ = gpu::Buffer(*context_, gpu::Buffer::Use::vertex, nullptr,
                           room_ * cornersOfLine * sizeof(Corner), "lines");
    array_ = gpu::VertexArray(*context_, "lines");
    array_.attribute(0, corners_, 3, sizeof(Corner), 0);
    array_.attribute(1, corners_, 3, sizeof(Corner), sizeof(glm::vec3));
}

void LineDrawer::draw(const std::vector<Line>& lines, double width, const DrawInputs& inputs) {
    if (lines.empty()) return;
    hold(lines.size());
    const glm::dvec3& eye = inputs.eye.origin.exact;
    std::vector<Corner> corners;
    for (const Line& line : lines) {
        const glm::vec3 from(line.from - eye), to(line.to - eye);
        const glm::vec3 a = across(from, to - from, width, inputs.eye),
                        b = across(to, to - from, width, inputs.eye);
        for (const glm::vec3& corner : {from - a, from + a, to + b, from - a, to + b, to - b})
            corners.push_back({corner, line.color});
    }
    corners_.update(gpu::Traffic::Kind::parameters, 0, corners.data(), corners.size() * sizeof(Corner));
    if (!program_)
        program_ = gpu::Program(
            *context_,
            {"render/lines.vert", "render/lines.frag", inputs.lighting.toneDefines(), {}, "lines"});
    program_.use();
    program_.set("toClip", inputs.eye.toClip);
    array_.bind();
    gpu::beginPass();
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(corners.size()));
}

// ---- Springs

SpringLines::SpringLines(gpu::Context& context, const Scene& scene, const Plan& plan) : context_(&context) {
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        const Molecule& molecule = scene.groups[group.index].molecule;
        if (molecule.springs.empty() || group.count == 0) continue;
        std::vector<glm::vec3> ends;
        for (const Spring& spring : molecule.springs) {
            const float rest = float(molecule.restLength(spring));
            for (int corner = 0; corner < 6; ++corner)
                ends.emplace_back(float(spring.a), float(spring.b), rest);
        }
        Drawn drawn{.reader = StateReader(group, g),
                    .count = group.count,
                    .corners = int(ends.size()),
                    .scaled = group.needs.scale || group.needs.phase,
                    .name = group.name,
                    .ends = {context, gpu::Buffer::Use::vertex, std::span<const glm::vec3>(ends), "springs"},
                    .array = gpu::VertexArray(context, "springs"),
                    .programs = {}};
        drawn.array.attribute(0, drawn.ends, 3, sizeof(glm::vec3), 0);
        groups_.push_back(std::move(drawn));
    }
}

void SpringLines::draw(const StateView& state, const DrawInputs& inputs, double strainShown, double width) {
    for (Drawn& group : groups_)
        draw(group, state, inputs, strainShown, width, {});
}

void SpringLines::drawOne(const StateView& state, const DrawInputs& inputs, double strainShown, double width,
                          size_t group, int molecule) {
    for (Drawn& drawn : groups_)
        if (drawn.reader.index == group) draw(drawn, state, inputs, strainShown, width, molecule);
}

const gpu::Program& SpringLines::program(Drawn& group, const StateView& state, const DrawInputs& inputs) {
    gpu::Program& program = group.programs[state.form()];
    if (program) return program;
    gpu::ProgramOptions options{"render/spring_lines.vert",
                                "render/lines.frag",
                                inputs.lighting.toneDefines(),
                                {},
                                group.name + " (springs)"};
    for (const std::string& define : group.reader.defines(state))
        options.defines.push_back(define);
    options.defines.push_back(gpu::constant("SCALED", group.scaled));
    program = gpu::Program(*context_, options);
    return program;
}

void SpringLines::draw(Drawn& group, const StateView& state, const DrawInputs& inputs, double strainShown,
                       double width, std::optional<int> only) {
    const gpu::Program& lines = program(group, state, inputs);
    lines.use();
    inputs.eye.origin.apply(lines);
    lines.set("toClip", inputs.eye.toClip);
    lines.set("strainShown", float(strainShown));
    lines.set("halfWidth", glm::vec2(float(width)) / inputs.eye.size);
    const auto submit = [&](const GroupBuffers::Part* part, int first, int count) {
        const bool here = !only || (*only >= first && *only < first + count);
        if (!here) return;
        group.reader.bind(lines, state, part);
        if (part && group.scaled) lines.texture("constants", part->constant);
        if (state.layers && group.scaled)
            lines.texture("constants", (*state.layers)[group.reader.index].constants());
        lines.set("firstMolecule", only ? *only - first : 0);
        group.array.bind();
        gpu::beginPass();
        glDrawArraysInstanced(GL_TRIANGLES, 0, group.corners, only ? 1 : count);
    };
    if (!state.buffers) return submit(nullptr, 0, group.count);
    for (const GroupBuffers::Part& part : (*state.buffers)[group.reader.index].parts())
        submit(&part, part.first, part.count);
}

}  // namespace shoal
