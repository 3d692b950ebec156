// Takes the branches that #if, #ifdef and #else leave out of a shader's text, so that people read, and
// drivers compile, only what is used.
//
// Understood: #define NAME [value], #undef NAME, #ifdef, #ifndef, #else, #endif and #if with defined(NAME),
// !, && and
// || without brackets. A name counts as defined from its #define on. Defines without a value go, too; all
// else stays.
#pragma once

#include "gpu/shader_source.h"

namespace shoal::gpu {

// Lines keep their origin. Error, located: a condition of another form, or one that does not end.
void resolveConditions(ShaderSource& source);

}  // namespace shoal::gpu
