// Catch2 of either major version behind one include: Debian 12 has 2.13, newer systems have 3. What tests use
// of the namespace Catch stands here, so that they use no name of one version alone; tests/catch_names.py
// holds them to that.
#pragma once

#include <string>

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;  // which the older version declares there
namespace Catch {
using Generators::from_range;
using Matchers::StartsWith;
using Matchers::VectorContains;
inline auto Contains(const std::string& part) {
    return Matchers::ContainsSubstring(part);
}
}  // namespace Catch
#else
#include <catch2/catch.hpp>
namespace Catch {
using Detail::Approx;
using Generators::from_range;
using Matchers::Contains;
using Matchers::StartsWith;
using Matchers::VectorContains;
}  // namespace Catch
#endif
