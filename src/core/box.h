// A box along the axes.
#pragma once

#include <glm/glm.hpp>

namespace shoal {

struct Box {
    glm::dvec3 low{-1}, high{1};  // m
    bool operator==(const Box&) const = default;
};

}  // namespace shoal
