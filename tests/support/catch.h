// Catch2 of either major version behind one include: Debian 12 has 2.13, newer systems have 3.
#pragma once

#include <string>

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
namespace Catch {
inline auto Contains(const std::string& part) {
    return Matchers::ContainsSubstring(part);
}
}  // namespace Catch
#else
#include <catch2/catch.hpp>  // Approx is global there
namespace Catch {
using Detail::Approx;
}
#endif
