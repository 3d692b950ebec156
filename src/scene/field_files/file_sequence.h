// Numbered files: "wind-####.vti" with first, last and step stands for wind-0000.vti, wind-0001.vti, ...
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json.h"

namespace shoal {

struct FileSequence {
    std::vector<std::string> files;  // one where the name is not a pattern
    std::vector<double> times;  // s, rising, one a file; empty where there is one file without "sequence"
    bool repeats = false;
};

// "file" and "sequence" of an object. Without "first" and "last" they are the lowest and highest number in
// the folder. Error, located: no such file, a number missing in between, a pattern without "sequence" or the
// other way round, fewer than two files, times that do not rise or are not one a file.
FileSequence readFileSequence(JsonReader& reader);

// The files that are there of a name with # for the number, in its order; none where it is no such name.
std::vector<std::string> numberedFiles(const std::filesystem::path& path);
// Error: a frame that does not come after the one before.
void checkTimes(double before, double time, const Location& where);

}  // namespace shoal
