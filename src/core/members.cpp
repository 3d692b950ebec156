#include "core/members.h"

#include <cmath>

namespace shoal {

bool CheckMembers::fine(double value, Range range) const {
    return std::abs(value) <= largest_ && contains(range, value);
}

void CheckMembers::refuse(const std::string& key, double value, Range range) const {
    const Location where = where_->at(key);
    if (std::isfinite(value) && std::abs(value) > largest_)
        throw Error(where, concat("expected a number within ", largest_, " of 0, found ", value));
    needWithin(where, value, range);
}

void CheckMembers::number(const std::string& key, double value, Range range) const {
    if (!fine(value, range)) refuse(key, value, range);
}

void CheckMembers::number(const std::string& key, int value, Range range) const {
    if (!contains(range, value)) needWithin(where_->at(key), value, range);
}

void CheckMembers::number(const std::string& key, const std::optional<double>& value, Range range) const {
    if (value) number(key, *value, range);
}

void CheckMembers::number(const std::string& key, const glm::dvec2& value, Range range) const {
    for (int i = 0; i < 2; ++i)
        if (!fine(value[i], range)) refuse(concat(key, "[", i, "]"), value[i], range);
}

void CheckMembers::number(const std::string& key, const glm::dvec3& value, Range range) const {
    for (int i = 0; i < 3; ++i)
        if (!fine(value[i], range)) refuse(concat(key, "[", i, "]"), value[i], range);
}

void CheckMembers::number(const std::string& key, const std::optional<glm::dvec3>& value, Range range) const {
    if (value) number(key, *value, range);
}

}  // namespace shoal
