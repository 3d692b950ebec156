// Errors that a user can cause: one exception type that knows where in which file the mistake is.
//
// A mistake that a user can make throws `Error`; one that only we can make breaks a contract
// (core/contract.h).
// Errors are exceptions rather than return values so that a handle's constructor can fail like everything
// else. Nothing half-built survives: every writer finishes under a temporary name first (core/file.h).
#pragma once

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shoal {

// A place in a file. Lines and columns count from 1; 0 means "not known".
struct Location {
    std::string file;
    int line = 0;
    int column = 0;
    std::string path = {};  // JSON path such as $.springs[3].a, empty outside JSON

    bool empty() const { return file.empty(); }
};

// The line and column of a byte of a text.
Location locate(std::string_view text, size_t position, const std::string& file);

// "file:line:column: " with the parts that are known; empty for an empty location.
std::string prefix(const Location& location);

// Puts its arguments behind one another: concat("expected ", 3, " values").
template <typename... Parts>
std::string concat(const Parts&... parts) {
    std::ostringstream out;
    (out << ... << parts);
    return out.str();
}

// Puts texts behind one another with another between them.
std::string joined(const std::vector<std::string>& texts, std::string_view between);

// Puts its arguments into a format of std::printf.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);
std::string mebibytes(size_t bytes);  // "1.50 MiB"

// what() is "file:line:column: message (at $.json.path)".
class Error : public std::runtime_error {
  public:
    explicit Error(std::string message) : Error(Location{}, std::move(message)) {}
    Error(Location location, std::string message);
    // The parts of a message, as concat() puts them together.
    template <typename A, typename B, typename... More>
    Error(Location location, const A& a, const B& b, const More&... more)
        : Error(std::move(location), concat(a, b, more...)) {}
    template <typename B, typename... More>
    Error(const char* a, const B& b, const More&... more) : Error(Location{}, concat(a, b, more...)) {}

    const Location& location() const { return location_; }
    const std::string& message() const { return message_; }

  private:
    Location location_;
    std::string message_;
};

// Something worth telling that does not stop the work.
struct Warning {
    Location location;
    std::string message;
};
std::string text(const Warning& warning);

// Counts in messages: "1 spring", "2 springs".
inline std::string many(int64_t count, const char* singular, const char* several) {
    return std::to_string(count) + " " + (count == 1 ? singular : several);
}

// The candidate nearest to `word` by edit distance, or empty when none is near enough to be a misspelling.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);
// " (did you mean "x"?)" or, when nothing is near, " (expected one of a, b, c)".
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace shoal
