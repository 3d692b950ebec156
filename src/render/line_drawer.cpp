#include "render/line_drawer.h"

#include <algorithm>

#include "gpu/gl.h"

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

LineDrawer::LineDrawer(gpu::Context& context, std::string shaderRoot)
    : context_(&context), shaderRoot_(std::move(shaderRoot)) {}

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
            *context_, shaderRoot_,
            {"render/lines.vert", "render/lines.frag", inputs.lighting.toneDefines(), {}, "lines"});
    program_.use();
    program_.set("toClip", inputs.eye.toClip);
    array_.bind();
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(corners.size()));
}

}  // namespace shoal
