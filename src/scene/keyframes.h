// Checks rules that all paths along keyframes keep to. Errors are thrown at `where`.
#pragma once

#include "core/error.h"

namespace shoal {

inline void needTwoKeyframes(size_t count, const Location& where) {
    if (count < 2) throw Error(where, "expected at least two keyframes, found ", count);
}

inline void checkRises(double time, double before, const Location& where) {
    if (!(time > before))
        throw Error(where, "expected a time after that of the keyframe before, ", before, " s, found ", time);
}

}  // namespace shoal
