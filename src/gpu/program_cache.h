// Linked programs on disk, so that the next start need not compile them. By content and driver: what a
// program's text, its driver or this file's layout changes has another key, so nothing is ever out of date.
//
// One file a program, <folder>/<key>.shoal-program; numbers as this machine has them in memory:
//   8 bytes   "shoalprg"                  8 bytes   length of the binary
//   4 bytes   version of this layout      8 bytes   FNV-1a of the key, the format and the binary
//   4 bytes   format, the driver's own    then the binary
// A cache never fails: what it cannot use or keep is compiled as if there were none. It warns of damage, and
// not of what the driver refuses.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "gpu/context.h"
#include "gpu/gl.h"

namespace shoal::gpu {

// 32 hexadecimal digits of the texts of a program's stages and the driver that compiles them.
std::string programKey(const ContextInfo& info, std::span<const std::string_view> texts);

class ProgramCache {
  public:
    // Beyond keptPrograms the oldest are removed, except those that this run uses, up to mostPrograms:
    // otherwise the next run would find none of them.
    static constexpr size_t keptPrograms = 256, mostPrograms = 4096;

    // The folder is made when something is written. Does nothing without a folder, below OpenGL 4.1, and
    // where the driver hands out no binaries.
    ProgramCache(const ContextInfo& info, std::string folder);

    // For Program. Fills a program that is new; false: link it, then store() it.
    bool load(const std::string& key, GLuint program);
    void store(const std::string& key, GLuint program);

    const std::filesystem::path& folder() const { return folder_; }  // empty: none
    bool active() const { return active_; }
    int hits() const { return hits_; }
    int misses() const { return misses_; }  // compiled; damaged files count
    std::vector<Warning> takeWarnings() { return std::exchange(warnings_, {}); }  // since the last call

  private:
    std::filesystem::path file(const std::string& key) const;
    bool fill(const std::string& key, GLuint program);

    std::filesystem::path folder_;
    bool active_ = false, writable_ = true;
    int hits_ = 0, misses_ = 0;
    std::vector<Warning> warnings_;
};

// Keeps a context's programs in another folder while this lives; empty: nowhere.
class OtherCache {
  public:
    OtherCache(const Context& context, std::string folder)
        : context_(&context),
          usual_(std::exchange(context.cache(), ProgramCache(context.info(), std::move(folder)))) {}
    ~OtherCache() { context_->cache() = std::move(usual_); }
    OtherCache(const OtherCache&) = delete;
    OtherCache& operator=(const OtherCache&) = delete;

  private:
    const Context* context_;
    ProgramCache usual_;
};

}  // namespace shoal::gpu
