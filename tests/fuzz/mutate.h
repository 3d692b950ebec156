// Damages files as accidents and attackers do. The same random numbers give the same damage.
#pragma once

#include <cstddef>
#include <string>

#include "core/random.h"

namespace shoal::test {

// In [0, count), 0 where count is 0.
size_t below(Random& random, size_t count);

// Text: bits flipped, cut short, pieces left out, repeated or exchanged, numbers and nesting at the limits.
std::string mutateText(const std::string& text, Random& random);
// Binary files: bits flipped, cut short, pieces left out or repeated, whole numbers at the limits.
std::string mutateBytes(std::string bytes, Random& random);

}  // namespace shoal::test
