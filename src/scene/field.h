// Vector fields: fluid velocity u(x, t) in m/s. They add up, each times its weight, inside its box. The
// kinds: scene/field_kinds.h. SI units, radians.
#pragma once

#include <optional>
#include <string>

#include "core/boxed.h"
#include "scene/placement.h"

namespace shoal {

class Description;

struct FieldShape;  // one of the kinds
extern template class Boxed<FieldShape>;

struct Field {
    std::string name;
    Boxed<FieldShape> shape;
    double weight = 1;
    std::optional<Box> box;  // no effect outside
};

const Description& describe(const Field*);

const char* kindName(const FieldShape& shape);  // its word in files

}  // namespace shoal
