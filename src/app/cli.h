// CLI11, whose warnings are not ours.
#pragma once

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#endif
#include <CLI/CLI.hpp>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include <charconv>

#include "core/error.h"

namespace shoal::app {

// Whether all of the text is a T: no sign that an unsigned number would swallow, nothing behind it.
template <typename T>
bool isAll(const std::string& text) {
    T value;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size();
}

inline CLI::Validator kindOf(bool (*test)(const std::string&), const std::string& what) {
    return CLI::Validator(
        [test, what](const std::string& text) {
            return test(text) ? std::string() : concat("expected ", what, ", found \"", text, "\"");
        },
        "");
}

// `option` means something only beside `other`.
inline void needs(CLI::App& command, const char* option, const char* other) {
    command.get_option(option)->needs(command.get_option(other));
}

// `option` stands beside none of the others.
inline void excludes(CLI::App& command, const char* option, std::initializer_list<const char*> others) {
    for (const char* other : others)
        command.get_option(option)->excludes(command.get_option(other));
}

}  // namespace shoal::app
