#include "scene/field_files/field_file.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

#include "core/error.h"
#include "core/file.h"
#include "scene/json/reader.h"

namespace shoal {

namespace fs = std::filesystem;

namespace {

constexpr int mostFiles = 10000;

// "wind-", 4, ".vti"
struct Pattern {
    fs::path folder;
    std::string before, after;
    size_t digits = 0;  // at least

    std::string file(int number) const {
        std::string text = std::to_string(number);
        if (text.size() < digits) text.insert(0, digits - text.size(), '0');
        return (folder / (before + text + after)).string();
    }

    // The number of a file's name, or -1.
    int numberOf(const std::string& name) const {
        if (name.size() < before.size() + digits + after.size() || !name.starts_with(before) ||
            !name.ends_with(after))
            return -1;
        const char *first = name.data() + before.size(), *last = name.data() + name.size() - after.size();
        int number = -1;
        const auto [stop, code] = std::from_chars(first, last, number);
        const bool whole = code == std::errc() && stop == last && number >= 0;
        return whole && file(number) == (folder / name).string() ? number : -1;
    }
};

// Nothing where the name has no run of #, or several.
std::optional<Pattern> patternOf(const fs::path& path) {
    const std::string name = path.filename().string();
    const size_t first = name.find('#'), last = name.rfind('#');
    if (first == std::string::npos || name.find_first_not_of('#', first) < last) return {};
    return Pattern{path.parent_path(), name.substr(0, first), name.substr(last + 1), last - first + 1};
}

// Returns the numbers of the files that are there, ascending.
std::vector<int> numbersIn(const Pattern& pattern) {
    std::vector<int> out;
    std::error_code code;
    const fs::path folder = pattern.folder.empty() ? fs::path(".") : pattern.folder;
    if (!mayOpen(folder)) return out;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
        if (const int number = pattern.numberOf(entry.path().filename().string()); number >= 0)
            out.push_back(number);
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<double> timesOf(const FileSequence& sequence, size_t count, const Where& where) {
    std::vector<double> times = sequence.times;
    if (where.given("times") && times.size() != count)
        throw Error(where.locate("times"), "expected ", count, " times, one a file, found ", times.size());
    for (size_t i = 1; i < times.size(); ++i)
        checkTimes(times[i - 1], times[i], where.locate("times"));
    if (!times.empty()) return times;
    where.require("frameRate");
    for (size_t i = 0; i < count; ++i)
        times.push_back(sequence.start + double(i) / *sequence.frameRate);
    return times;
}

std::vector<std::string> oneFile(const GridSource& source, const Where& where) {
    std::error_code code;
    if (source.file.find('#') != std::string::npos &&
        !fs::exists(fs::path(where.here().file).parent_path() / source.file, code))
        throw Error(where.locate("file"),
                    "numbered files need \"sequence\", with their \"frameRate\" at least");
    return {needFile(where, "file", source.file)};
}

}  // namespace

void checkTimes(double before, double time, const Location& where) {
    if (!(time - before >= leastPositive))
        throw Error(where, "expected rising times, found ", before, " and then ", time);
}

TimedFiles filesOf(const GridSource& source, const Where& where) {
    if (!source.sequence) return {oneFile(source, where), {}};
    const FileSequence& sequence = *source.sequence;
    const Where inner = where.in("sequence");
    const std::optional<Pattern> pattern =
        patternOf((fs::path(where.here().file).parent_path() / source.file).lexically_normal());
    if (!pattern)
        throw Error(where.locate("file"), "expected one run of # in the file's name, in place of the number");
    std::vector<int> numbers;
    if (!sequence.first || !sequence.last) {
        numbers = numbersIn(*pattern);
        if (numbers.empty())
            throw Error(where.locate("file"), "no such files: " + pattern->file(0) + " and so on");
    }
    const int first = sequence.first ? *sequence.first : numbers.front(),
              last = sequence.last ? *sequence.last : numbers.back(), step = sequence.step;
    if (last <= first || (last - first) % step != 0 || (last - first) / step >= mostFiles)
        throw Error(inner.given("last") ? inner.locate("last") : inner.here(), "expected 2 to ", mostFiles,
                    " files from first to last, found numbers from ", first, " to ", last, " in steps of ",
                    step);
    TimedFiles out;
    for (int number = first; number <= last; number += step) {
        out.files.push_back(pattern->file(number));
        std::error_code code;
        if (!fs::is_regular_file(out.files.back(), code))
            throw Error(where.locate("file"), "no such file: ", out.files.back(), ", of the numbers ", first,
                        " to ", last);
        if (number > last - step) break;  // the next might overflow
    }
    out.times = timesOf(sequence, out.files.size(), inner);
    return out;
}

std::vector<std::string> numberedFiles(const fs::path& path) {
    std::vector<std::string> out;
    const std::optional<Pattern> pattern = patternOf(path);
    if (!pattern) return out;
    for (const int number : numbersIn(*pattern))
        out.push_back(pattern->file(number));
    return out;
}

}  // namespace shoal
