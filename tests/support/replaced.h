// A text with one piece of it, the first that reads so and which must be there, exchanged.
#pragma once

#include <string>

#include "support/catch.h"

inline std::string replaced(std::string text, const std::string& part, const std::string& with) {
    const size_t at = text.find(part);
    INFO(part);
    REQUIRE(at != std::string::npos);
    return text.replace(at, part.size(), with);
}
