#include "core/error.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <utility>

#include "core/contract.h"
#include "core/printable.h"

namespace shoal {

Location locate(std::string_view text, size_t position, const std::string& file) {
    const std::string_view before = text.substr(0, position);
    const size_t lineEnd = before.rfind('\n');
    const size_t start = lineEnd == std::string_view::npos ? 0 : lineEnd + 1;
    const auto lines = std::count(before.begin(), before.end(), '\n');
    return {file, int(lines) + 1, int(before.size() - start) + 1};
}

std::string prefix(const Location& location) {
    if (location.file.empty()) return {};
    std::string out = printable(location.file) + ":";
    if (location.line > 0) out += std::to_string(location.line) + ":";
    if (location.line > 0 && location.column > 0) out += std::to_string(location.column) + ":";
    return out + " ";
}

// Messages quote what stands in files; who shows one need not think of that.
static std::string located(const Location& location, const std::string& message) {
    std::string out = prefix(location) + printableLines(message);
    if (!location.path.empty()) out += " (at " + printable(location.path) + ")";
    return out;
}

Error::Error(Location location, std::string message)
    : std::runtime_error(located(location, message)),
      location_(std::move(location)),
      message_(std::move(message)) {}

std::string text(const Warning& warning) {
    return located(warning.location, warning.message);
}

// Damerau's distance (optimal string alignment): letters left out, put in, replaced, or two neighbours
// exchanged.
static size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        before = std::exchange(last, row);
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            row[j + 1] = std::min({row[j] + 1, last[j + 1] + 1, last[j] + (a[i] == b[j] ? 0 : 1)});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
        }
    }
    return row.back();
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
    if (word.size() > 64) return {};
    std::string best;
    size_t bestDistance = std::max<size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        const size_t distance = editDistance(word, candidate);
        if (distance < bestDistance) {
            best = candidate;
            bestDistance = distance;
        }
    }
    return best;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
    const std::string near = nearest(word, candidates);
    if (!near.empty()) return " (did you mean \"" + near + "\"?)";
    return candidates.empty() ? "" : " (expected one of " + joined(candidates, ", ") + ")";
}

std::string joined(const std::vector<std::string>& texts, std::string_view between) {
    std::string out;
    for (const std::string& text : texts) {
        if (&text != &texts.front()) out += between;
        out += text;
    }
    return out;
}

std::string formatted(const char* format, ...) {
    va_list values, again;
    va_start(values, format);
    va_copy(again, values);
    std::string out(size_t(std::max(0, std::vsnprintf(nullptr, 0, format, values))), '\0');
    std::vsnprintf(out.data(), out.size() + 1, format, again);
    va_end(again);
    va_end(values);
    return out;
}

void contractBroken(const char* file, int line, const char* condition) {
    const std::string_view whole(file);
    const size_t source = whole.rfind("src/");  // the folder of the tree says nothing to a reader
    const std::string_view shown = source == std::string_view::npos ? whole : whole.substr(source);
    std::fprintf(stderr, "%.*s:%d: broken contract: %s\n", int(shown.size()), shown.data(), line, condition);
    std::fflush(stderr);
    std::abort();
}

std::string mebibytes(size_t bytes) {
    return formatted("%.2f MiB", double(bytes) / (1 << 20));
}

}  // namespace shoal
