#include "scene/selection.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/describe.h"
#include "geometry/mesh.h"

namespace shoal {

const Description& describe(const Selection*) {
    using S = Selection;
    static const auto rule = [](const S& select, const Where& where) {
        if (select.minHeight && select.maxHeight && *select.minHeight > *select.maxHeight)
            throw Error(where.locate("maxHeight"), "expected maxHeight of at least minHeight (",
                        *select.minHeight, "), found ", *select.maxHeight);
    };
    static const Description description =
        Describe<S>("select", "Which part of a model; all that is given must hold.")
            .key("object", &S::object,
                 {"the name of an object", "The object of the model's file that it belongs to."})
            .notEmpty()
            .color("color", &S::color,
                   {"", "The vertex colour; OBJ and PLY files have sRGB, which is made linear first."})
            .key("colorTolerance", &S::colorTolerance,
                 {"", "How far each channel of the colour may be off.", Range::atLeast(0)})
            .only("color", {})
            .key("minHeight", &S::minHeight, {"m", "The lowest y."})
            .key("maxHeight", &S::maxHeight, {"m", "The highest y."})
            .key("maxThickness", &S::maxThickness, {"m", "The largest local thickness.", aboveZero()})
            .key("thinnest", &S::thinnest,
                 {"", "The thinnest share of the vertices that meet all else: the smallest branches.",
                  Range{0, 1, true}})
            .rule(rule);
    return description;
}

namespace {

// One flag per welded vertex. (std::vector<bool> would save memory that does not matter here.)
using Mask = std::vector<char>;

size_t matching(const Mask& mask) {
    return static_cast<size_t>(std::count(mask.begin(), mask.end(), 1));
}

std::vector<char> trianglesOf(const Mesh& mesh, const std::string& object) {
    std::vector<char> in(mesh.triangles.size(), object.empty() ? 1 : 0);
    if (object.empty()) return in;
    for (const Mesh::Object& o : mesh.objects)
        if (o.name == object) std::fill_n(in.begin() + o.firstTriangle, o.triangleCount, char{1});
    return in;
}

class Selector {
  public:
    Selector(const Mesh& mesh, const Selection& selection)
        : mesh_(mesh), selection_(selection), inObject_(trianglesOf(mesh, selection.object)) {}

    Selected run() {
        mask_.assign(mesh_.weldedPositions.size(), mesh_.triangles.empty() ? 1 : 0);  // a cloud of points
        for (const glm::ivec3& t : mesh_.triangles)  // vertices without a triangle carry nothing
            for (int i = 0; i < 3; ++i)
                mask_[welded(t[i])] = 1;
        total_ = matching(mask_);

        if (!selection_.object.empty()) keepObject();
        if (selection_.color) keepColor();
        if (selection_.minHeight || selection_.maxHeight) keepHeights();
        if (selection_.maxThickness || selection_.thinnest) thickness_ = localThickness(mesh_, mask_);
        if (selection_.maxThickness)
            keep(concat("maxThickness ", *selection_.maxThickness, " m (of the rest)"),
                 [&](size_t v) { return thickness_[v] <= *selection_.maxThickness; });
        if (selection_.thinnest) keepThinnest();
        return collect();
    }

  private:
    size_t welded(int corner) const { return size_t(mesh_.weld[size_t(corner)]); }

    // Reports how many vertices meet the condition on its own, then narrows the mask.
    void keep(const std::string& condition, const std::function<bool(size_t)>& holds) {
        size_t matched = 0;
        for (size_t v = 0; v < mask_.size(); ++v) {
            const bool held = holds(v);
            matched += held ? 1 : 0;
            if (!held) mask_[v] = 0;
        }
        note(concat(condition, " matched ", matched));
    }

    void note(const std::string& part) { report_ += (report_.empty() ? "" : "; ") + part; }

    void keepObject() {
        Mask in(mask_.size(), 0);
        for (size_t t = 0; t < mesh_.triangles.size(); ++t)
            if (inObject_[t])
                for (int i = 0; i < 3; ++i)
                    in[welded(mesh_.triangles[t][i])] = 1;
        keep("object \"" + selection_.object + "\"", [&](size_t v) { return in[v] != 0; });
    }

    void keepColor() {
        Mask in(mask_.size(), 0);
        for (size_t corner = 0; corner < mesh_.colors.size(); ++corner) {
            const glm::dvec3 off = glm::abs(mesh_.colors[corner] - *selection_.color);
            if (std::max({off.x, off.y, off.z}) <= selection_.colorTolerance + 1e-9)
                in[size_t(mesh_.weld[corner])] = 1;
        }
        keep(mesh_.colors.empty() ? "color (the model has no vertex colours)" : "color",
             [&](size_t v) { return in[v] != 0; });
    }

    void keepHeights() {
        const auto height = [&](size_t v) { return mesh_.weldedPositions[v].y; };
        if (selection_.minHeight)
            keep(concat("minHeight ", *selection_.minHeight, " m"),
                 [&](size_t v) { return height(v) >= *selection_.minHeight; });
        if (selection_.maxHeight)
            keep(concat("maxHeight ", *selection_.maxHeight, " m"),
                 [&](size_t v) { return height(v) <= *selection_.maxHeight; });
    }

    void keepThinnest() {
        std::vector<size_t> candidates;
        for (size_t v = 0; v < mask_.size(); ++v)
            if (mask_[v]) candidates.push_back(v);
        std::sort(candidates.begin(), candidates.end(), [&](size_t a, size_t b) {
            return thickness_[a] != thickness_[b] ? thickness_[a] < thickness_[b] : a < b;
        });
        const double share = *selection_.thinnest * static_cast<double>(candidates.size());
        candidates.resize(std::min(candidates.size(), static_cast<size_t>(std::ceil(share))));
        Mask in(mask_.size(), 0);
        size_t open = 0;
        for (const size_t v : candidates)
            if (std::isfinite(thickness_[v]))
                in[v] = 1;
            else
                ++open;
        mask_ = in;
        note(concat("thinnest ", *selection_.thinnest, " of the rest matched ", matching(in)));
        if (open > 0) report_ += concat(" (", open, " have no thickness: the surface is open there)");
    }

    Selected collect() {
        Selected selected;
        for (size_t v = 0; v < mask_.size(); ++v)
            if (mask_[v]) selected.vertices.push_back(static_cast<int>(v));
        for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
            const glm::ivec3& t = mesh_.triangles[i];
            if (inObject_[i] && mask_[welded(t.x)] && mask_[welded(t.y)] && mask_[welded(t.z)])
                selected.triangles.push_back(static_cast<int>(i));
        }
        selected.report = concat("of ", total_, " vertices", report_.empty() ? "" : ", ", report_);
        return selected;
    }

    const Mesh& mesh_;
    const Selection& selection_;
    std::vector<char> inObject_;  // per triangle
    Mask mask_;
    size_t total_ = 0;
    std::vector<double> thickness_;
    std::string report_;
};

}  // namespace

Selected select(const Mesh& mesh, const Selection& selection) {
    return Selector(mesh, selection).run();
}

double selectedArea(const Mesh& mesh, const Selection& selection) {
    double sum = 0;
    for (const int t : select(mesh, selection).triangles) {
        const auto corner = [&](int i) { return mesh.positions[size_t(mesh.triangles[size_t(t)][i])]; };
        sum += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    return sum;
}

}  // namespace shoal
