#include "core/file_watch.h"

#include <filesystem>

namespace shoal {

namespace fs = std::filesystem;

FileWatch::Stamp FileWatch::stampOf(const std::string& file) {
    std::error_code code;
    Stamp out;
    const uintmax_t bytes = fs::file_size(file, code);
    if (code) return out;
    const fs::file_time_type time = fs::last_write_time(file, code);
    if (code) return out;
    return {true, uint64_t(bytes), int64_t(time.time_since_epoch().count())};
}

void FileWatch::watch(const std::vector<std::string>& files) {
    std::map<std::string, Watched> next;
    for (const std::string& file : files) {
        const auto before = files_.find(file);
        if (before != files_.end()) {
            next.insert(*before);
            continue;
        }
        const Stamp stamp = stampOf(file);
        next.insert({file, {stamp, stamp, 0}});
    }
    files_ = std::move(next);
}

std::vector<std::string> FileWatch::changed(double time) {
    std::vector<std::string> out;
    if (time - lookedAt_ < interval) return out;
    lookedAt_ = time;
    for (auto& [file, watched] : files_) {
        const Stamp stamp = stampOf(file);
        if (!(stamp == watched.seen)) {
            watched.seen = stamp;
            watched.since = time;
            continue;
        }
        if (stamp == watched.known || time - watched.since < (stamp.exists ? interval : goneAfter)) continue;
        watched.known = stamp;
        out.push_back(file);
    }
    return out;
}

void FileWatch::accept(const std::string& file) {
    const auto found = files_.find(file);
    if (found != files_.end()) found->second.known = found->second.seen = stampOf(file);
}

}  // namespace shoal
