#include "scene/collider_kinds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/image.h"

namespace shoal {

namespace {

constexpr float nothing = -std::numeric_limits<float>::infinity();

// The level from which floats hold heights that are not below `lowest` well: that of the scene, where it is
// near.
double levelOf(double lowest) {
    constexpr double far = 1024;  // m
    return std::abs(lowest) > far ? std::floor(lowest) : 0;
}

// Raises every sample under the triangle, as seen from above, to the triangle.
void rasterise(HeightFieldCollider& field, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec2 step = (field.high - field.low) / glm::dvec2(field.columns - 1, field.rows - 1);
    const auto flat = [&](const glm::dvec3& p) { return (glm::dvec2(p.x, p.z) - field.low) / step; };
    const glm::dvec2 a2 = flat(a), b2 = flat(b), c2 = flat(c);  // in samples
    const glm::dvec2 ab = b2 - a2, ac = c2 - a2;
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (!(std::abs(area) > 1e-12)) return;  // a wall has no height of its own

    const double edge = 1e-7;  // so that samples on a shared edge or on the border belong to someone
    const glm::dvec2 low = glm::min(a2, glm::min(b2, c2)) - edge,
                     high = glm::max(a2, glm::max(b2, c2)) + edge;
    const int firstColumn = std::max(0, static_cast<int>(std::ceil(low.x)));
    const int lastColumn = std::min(field.columns - 1, static_cast<int>(std::floor(high.x)));
    const int firstRow = std::max(0, static_cast<int>(std::ceil(low.y)));
    const int lastRow = std::min(field.rows - 1, static_cast<int>(std::floor(high.y)));
    for (int row = firstRow; row <= lastRow; ++row)
        for (int column = firstColumn; column <= lastColumn; ++column) {
            const glm::dvec2 p = glm::dvec2(column, row) - a2;
            const double v = (p.x * ac.y - p.y * ac.x) / area, w = (ab.x * p.y - ab.y * p.x) / area;
            if (v < -edge || w < -edge || v + w > 1 + edge) continue;
            const double height = a.y + v * (b.y - a.y) + w * (c.y - a.y);
            float& sample = field.heights[size_t(row) * size_t(field.columns) + size_t(column)];
            sample = std::max(sample, static_cast<float>(height - field.level));
        }
}

}  // namespace

HeightFieldCollider heightFieldFromMesh(const Mesh& mesh, int columns, int rows, int* missed) {
    HeightFieldCollider field;
    field.columns = columns;
    field.rows = rows;
    field.low = {mesh.low.x, mesh.low.z};
    field.high = {mesh.high.x, mesh.high.z};
    field.level = levelOf(mesh.low.y);
    field.heights.assign(size_t(columns) * size_t(rows), nothing);
    const auto position = [&](int vertex) -> const glm::dvec3& { return mesh.positions[size_t(vertex)]; };
    for (const glm::ivec3& t : mesh.triangles)
        rasterise(field, position(t.x), position(t.y), position(t.z));

    const auto holes = std::count(field.heights.begin(), field.heights.end(), nothing);
    if (missed) *missed = static_cast<int>(holes);
    std::replace(field.heights.begin(), field.heights.end(), nothing,
                 static_cast<float>(mesh.low.y - field.level));
    return field;
}

HeightFieldCollider heightFieldFromImage(const HeightImage& image, glm::dvec2 low, glm::dvec2 high,
                                         glm::dvec2 heights) {
    HeightFieldCollider field;
    field.columns = image.width;
    field.rows = image.height;
    field.low = low;
    field.high = high;
    field.level = levelOf(std::min(heights.x, heights.y));
    field.heights.reserve(image.values.size());
    for (const float grey : image.values)
        field.heights.push_back(
            static_cast<float>(glm::mix(heights.x, heights.y, static_cast<double>(grey)) - field.level));
    return field;
}

}  // namespace shoal
