// Reads clouds of points as text: a point a line, x y z, then a normal or a colour.
#include <algorithm>

#include "core/file.h"
#include "core/srgb.h"
#include "geometry/model_reader.h"
#include "geometry/obj_text.h"

namespace shoal {

namespace {

// Three numbers behind a place are a normal where its length is 1, and a colour of bytes otherwise.
bool isUnit(const glm::dvec3& v) {
    return std::abs(glm::length(v) - 1) < 0.01;
}

glm::dvec3 colorOfBytes(const glm::dvec3& bytes) {
    return linearOfSrgb(glm::clamp(bytes / 255.0, 0.0, 1.0));
}

}  // namespace

Mesh readXyz(const ModelFile& model) {
    const std::string text = readFile(model.name);
    model.opened(text.size());
    Mesh mesh;
    std::vector<double> numbers;
    std::vector<glm::dvec3> colors;
    bool anyColor = false;
    int line = 0;
    for (size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
        end = std::min(text.find('\n', begin), text.size());
        ++line;
        const auto fail = [&](const char* what) {
            return Error(Location{model.name}, "line ", line, ": ", what);
        };
        numbers.clear();
        const std::string_view whole(text.data() + begin, end - begin);
        if (!readNumbers(whole.substr(0, whole.find('#')), numbers))
            throw fail("expected the numbers of a point, x y z");
        if (numbers.empty()) continue;
        if (numbers.size() < 3) throw fail("expected three numbers or more, x y z");
        const glm::dvec3 position(numbers[0], numbers[1], numbers[2]);
        if (!isWithinReach(position)) throw fail("a point is not finite, or too far away");
        mesh.positions.push_back(position);
        mesh.normals.emplace_back(0);
        colors.emplace_back(1);
        if (numbers.size() < 6) continue;
        const glm::dvec3 more(numbers[3], numbers[4], numbers[5]);
        if (isUnit(more))
            mesh.normals.back() = glm::normalize(more);
        else if (isFinite(more))
            anyColor = true, colors.back() = colorOfBytes(more);
    }
    if (anyColor) mesh.colors = std::move(colors);
    return mesh;
}

}  // namespace shoal
