// Finds which of some files have changed, by looking at their sizes and times a few times a second: works the
// same on every system and file system, and for editors that write another file and rename it.
//
// A change counts once the file has stood still between two looks, so that nobody reads half of one; a file
// that is gone counts only after a while, because some editors move the old one away first.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace shoal {

class FileWatch {
  public:
    static constexpr double interval = 0.2;   // s, between two looks
    static constexpr double goneAfter = 2.0;  // s, that a missing file may be on its way

    // Watches these files from now on. Their present state is no change, except of those watched before.
    void watch(const std::vector<std::string>& files);

    // Looks, unless the last look is too near; `time` (s) grows. Each change is told once.
    std::vector<std::string> changed(double time);

    // As the file is now is no change: one's own writing.
    void accept(const std::string& file);

    size_t size() const { return files_.size(); }

  private:
    struct Stamp {
        bool exists = false;
        uint64_t bytes = 0;
        int64_t time = 0;  // in the file system's clock
        bool operator==(const Stamp&) const = default;
    };
    struct Watched {
        Stamp known, seen;
        double since = 0;  // s: `seen` stands
    };
    static Stamp stampOf(const std::string& file);

    std::map<std::string, Watched> files_;
    double lookedAt_ = -1e9;  // s
};

}  // namespace shoal
