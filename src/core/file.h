// Reading and writing whole files, with errors that say what to do.
#pragma once

#include <sys/types.h>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/part_file.h"

namespace shoal {

// The file's bytes. Error: FileReader's, or above maxBytes.
std::string readFile(const std::filesystem::path& path, size_t maxBytes = size_t{1} << 31);

// ".png" of "a/b.PNG"; empty without an extension.
std::string lowerExtension(const std::filesystem::path& path);

// Writes beside the target and renames, so that a full disk or a crash never leaves half a file.
// Missing folders are made. Error: cannot create, write (disk full), or rename; the old file is kept.
void writeFile(const std::filesystem::path& path, std::string_view bytes);
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Error: writeFile would not succeed now. For those who write late what should be known early.
void checkWritable(const std::filesystem::path& path);

// "a folder", "a FIFO", "a socket" or "a device", of what is no regular file.
std::string kindOf(mode_t mode);

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

// Reads a file piece by piece, where it need not lie in memory as a whole.
class FileReader {
  public:
    // Error: no such file, unreadable, or no regular file: a FIFO would be waited for, and a device has no
    // end; or it may not be opened (core/sandbox.h).
    explicit FileReader(const std::filesystem::path& path);
    // The bytes that were there: fewer than asked for only at the end. Error: cannot be read.
    size_t read(void* data, size_t bytes);
    const Location& location() const { return location_; }

  private:
    Location location_;
    FilePointer file_;
};

// Without finish() nothing stays, and the old file is kept. What is no file but takes bytes (/dev/null, a
// FIFO that somebody reads) is never replaced: they go there as they come.
class FileWriter {
  public:
    // Error: PartFile's, or nobody reads the FIFO.
    explicit FileWriter(const std::filesystem::path& path);
    void write(const void* data, size_t bytes);  // Error: disk full
    void finish();                               // Error: disk full, cannot rename

  private:
    [[noreturn]] void fail(int cause) const;

    std::filesystem::path path_;
    std::optional<PartFile> part_;  // none: a device or a FIFO
    FilePointer file_;
};

}  // namespace shoal
