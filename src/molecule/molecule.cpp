#include "molecule/molecule.h"

#include <algorithm>
#include <cmath>

namespace shoal {

const std::vector<std::string>& blendWords() {
    static const std::vector<std::string> words = {"none", "alpha", "additive", "multiplicative"};
    return words;
}

const std::vector<std::string>& sortWords() {
    static const std::vector<std::string> words = {"none", "frame", "spread"};
    return words;
}

const char* name(Blend blend) {
    return blendWords()[size_t(blend)].c_str();
}

const char* name(DrawSort sort) {
    return sortWords()[size_t(sort)].c_str();
}

double Molecule::mass() const {
    double out = 0;
    for (const Vertex& vertex : vertices)
        out += vertex.mass;
    return out;
}

double Molecule::size() const {
    // Every pair is compared only while that is cheap; beyond, the diagonal of the bounding box stands in.
    constexpr size_t allPairs = 4096;
    double squared = 0;
    if (vertices.size() <= allPairs) {
        for (size_t i = 0; i < vertices.size(); ++i)
            for (size_t j = 0; j < i; ++j) {
                const glm::dvec3 d = vertices[i].position - vertices[j].position;
                squared = std::max(squared, glm::dot(d, d));
            }
    } else {
        glm::dvec3 least = vertices[0].position, most = least;
        for (const Vertex& vertex : vertices) {
            least = glm::min(least, vertex.position);
            most = glm::max(most, vertex.position);
        }
        squared = glm::dot(most - least, most - least);
    }
    return squared > 0 ? std::sqrt(squared) : 1;
}

bool Molecule::hasPins() const {
    return std::any_of(vertices.begin(), vertices.end(), [](const Vertex& vertex) { return vertex.pinned; });
}

}  // namespace shoal
