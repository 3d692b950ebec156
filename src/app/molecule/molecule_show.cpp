// `shoal molecule show`: a molecule on one sheet: rest shape, springs, pins, normals, and its slowest
// motions.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "app/line/commands.h"
#include "app/molecule/canvas.h"
#include "app/molecule/molecule_report.h"
#include "core/error.h"
#include "core/printable.h"
#include "molecule/analysis.h"
#include "molecule/molecule_file.h"
#include "window/edit_widgets.h"
#include "window/editor/overlay.h"
#include "window/editor/stage.h"

namespace shoal::app {

using window::EditorStage, window::Projector, window::StageSettings;

namespace {

constexpr size_t sheetColumns = 2, sheetRows = 3;
const glm::vec4 pale(0.92f, 0.96f, 0.9f, 1), warm(0.98f, 0.72f, 0.3f, 1), pinColor(1, 0.5f, 0.35f, 1),
    normalColor(0.4f, 0.75f, 1, 0.9f);

glm::vec4 colorOf(double strain) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(window::strainColor(strain, 1));
    return {c.x, c.y, c.z, 0.9f};
}

class Sheet {
  public:
    Sheet(gpu::Context& context, const Molecule& molecule, int width, int height)
        : molecule_(molecule),
          stage_(context),
          side_(height),
          small_{(width - height) / int(sheetColumns), height / int(sheetRows)},
          image_{width, height, 4, std::vector<uint8_t>(size_t(width) * size_t(height) * 4, 255)} {
        StageSettings settings;
        settings.around = StageSettings::Around::still;
        settings.floorShows = false;
        // Nothing moves: an explicit solver must hold its substep stable all the same.
        const double stable = analyse(molecule, false).stableStepLeapfrog;
        settings.substeps = int(std::clamp(std::ceil(1.02 / 60 / stable), 1.0, double(maxSubsteps)));
        stage_.show(molecule, settings);
        glm::dvec3 low(1e300), high(-1e300);
        for (const Vertex& vertex : molecule.vertices) {
            low = glm::min(low, vertex.position);
            high = glm::max(high, vertex.position);
        }
        view_.fieldOfView = 0.6;
        view_.target = (low + high) / 2.0;
        // of points, the balls that are drawn count
        const double ball = molecule.triangles.empty() ? 1.2 * molecule.material.pointSize : 0;
        const double size = std::max(glm::length(high - low), ball);
        view_.eye = view_.target + glm::normalize(glm::dvec3(0.8, 0.5, 1)) * (2.0 * size);
    }

    Image draw() {
        drawRest();
        const std::vector<Mode> modes = modesOf(molecule_, molecule_.hasPins(), sheetColumns * sheetRows);
        for (size_t i = 0; i < sheetColumns * sheetRows; ++i) {
            const glm::ivec2 corner(side_ + int(i % sheetColumns) * small_.x,
                                    int(i / sheetColumns) * small_.y);
            Canvas canvas(image_, corner, small_ - 2);
            if (i < modes.size()) {
                drawMode(canvas, modes[i]);
                continue;
            }
            stage_.rest();
            for (int y = 0; y < small_.y; ++y)
                canvas.line({0, y}, {small_.x, y}, 1, {0.2f, 0.22f, 0.24f, 1});
        }
        return std::move(image_);
    }

  private:
    std::optional<glm::vec2> place(const Projector& projector, const glm::dvec3& point) const {
        const std::optional<ImVec2> p = projector.place(point);
        return p ? std::optional(glm::vec2(p->x, p->y)) : std::nullopt;
    }

    void drawSprings(Canvas& canvas, const Projector& projector, const std::vector<glm::dvec3>& x,
                     float width, double strainShown) const {
        for (const Spring& s : molecule_.springs) {
            const auto a = place(projector, x[size_t(s.a)]), b = place(projector, x[size_t(s.b)]);
            if (!a || !b) continue;
            const double strain = glm::distance(x[size_t(s.a)], x[size_t(s.b)]) / molecule_.restLength(s) - 1;
            const glm::vec4 color = colorOf(strain / strainShown);
            canvas.line(*a, *b, width, color);
            if (s.actuation && s.actuation->amplitude > 0) canvas.dot((*a + *b) * 0.5f, 2 * width, color);
        }
    }

    void drawVertices(Canvas& canvas, const Projector& projector, const std::vector<glm::dvec3>& x,
                      float size) const {
        for (size_t v = 0; v < x.size(); ++v) {
            const auto p = place(projector, x[v]);
            if (!p) continue;
            if (molecule_.vertices[v].pinned)
                canvas.square(*p, size, pinColor);
            else
                canvas.dot(*p, size, pale);
        }
    }

    void drawNormals(Canvas& canvas, const Projector& projector, const std::vector<glm::dvec3>& x) const {
        for (const Triangle& t : molecule_.triangles) {
            const glm::dvec3 &a = x[size_t(t.a)], &b = x[size_t(t.b)], &c = x[size_t(t.c)];
            const glm::dvec3 n = glm::cross(b - a, c - a), middle = (a + b + c) / 3.0;
            if (glm::length(n) < 1e-30) continue;
            const auto from = place(projector, middle),
                       to = place(projector, middle + glm::normalize(n) * (0.07 * molecule_.size()));
            if (!from || !to) continue;
            canvas.line(*from, *to, 1.5f, normalColor);
            canvas.dot(*to, 2, normalColor);
        }
    }

    void drawRest() {
        Canvas canvas(image_, {0, 0}, {side_ - 2, side_});
        stage_.rest();
        canvas.paste(stage_.picture(view_, side_, side_));
        const Projector projector(view_, ImVec2(float(side_), float(side_)));
        drawSprings(canvas, projector, stage_.positions(), 1.6f, 0.05);
        drawNormals(canvas, projector, stage_.positions());
        drawVertices(canvas, projector, stage_.positions(), 4);
        const Analysis analysis = analyse(molecule_, false);
        const int pins = int(std::count_if(molecule_.vertices.begin(), molecule_.vertices.end(),
                                           [](const Vertex& v) { return v.pinned; }));
        canvas.text({14, 12}, molecule_.name, pale, 2);
        std::vector<std::string> lines = {
            concat(many(analysis.vertices, "vertex", "vertices"), ", ",
                   many(analysis.springs, "spring", "springs"), ", ",
                   many(analysis.triangles, "triangle", "triangles")),
            concat(window::plain(analysis.totalMass), " kg, ", window::plain(molecule_.size()), " m")};
        if (pins > 0) lines.push_back(concat(pins, " pinned (squares)"));
        if (!molecule_.skin.empty())
            lines.push_back(
                concat("skin of ", many(int64_t(molecule_.skin.triangles.size()), "triangle", "triangles")));
        for (size_t i = 0; i < lines.size(); ++i)
            canvas.text({14, 44 + 18 * int(i)}, lines[i], pale);
    }

    void drawMode(Canvas& canvas, const Mode& mode) {
        const double reach = 0.14 * molecule_.size();
        stage_.wobble(mode, reach);
        View near = view_;
        near.eye = near.target + 0.85 * (near.eye - near.target);
        canvas.paste(stage_.picture(near, small_.x, small_.y));
        const Projector projector(near, ImVec2(float(small_.x), float(small_.y)));
        std::vector<glm::dvec3> rest;
        for (const Vertex& vertex : molecule_.vertices)
            rest.push_back(vertex.position);
        for (const Spring& s : molecule_.springs) {
            const auto a = place(projector, rest[size_t(s.a)]), b = place(projector, rest[size_t(s.b)]);
            if (a && b) canvas.line(*a, *b, 1, {1, 1, 1, 0.12f});
        }
        drawSprings(canvas, projector, stage_.positions(), 1.2f, 0.1);
        drawVertices(canvas, projector, stage_.positions(), 2.5f);
        if (mode.frequency > 0)
            canvas.text({8, 8}, concat(window::plain(mode.frequency / (2 * std::numbers::pi)), " Hz"), pale);
        else
            canvas.text({8, 8}, "soft: nothing resists it", warm);
    }

    const Molecule& molecule_;
    EditorStage stage_;
    int side_;
    glm::ivec2 small_;
    Image image_;
    View view_;
};

}  // namespace

Image moleculeSheet(gpu::Context& context, const Molecule& molecule, int width, int height) {
    return Sheet(context, molecule, width, height).draw();
}

int moleculeShowCommand(const Options& options) {
    const Molecule molecule = readMolecule(options.files.front());
    gpu::Context context(hiddenContext(options));
    writePng(options.capture, moleculeSheet(context, molecule, options.width, options.height));
    std::cout << "picture: " << printable(options.capture) << "\n";
    return 0;
}

}  // namespace shoal::app
