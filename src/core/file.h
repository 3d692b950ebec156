// Reading and writing whole files, with errors that say what to do.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace shoal {

// The file's bytes. Error: no such file, a folder, a device, unreadable, or above maxBytes.
std::string readFile(const std::filesystem::path& path, size_t maxBytes = size_t{1} << 31);

// ".png" of "a/b.PNG"; empty without an extension.
std::string lowerExtension(const std::filesystem::path& path);

// Writes beside the target and renames, so that a full disk or a crash never leaves half a file.
// Missing folders are made. Error: cannot create, write (disk full), or rename; the old file is kept.
void writeFile(const std::filesystem::path& path, std::string_view bytes);
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

// The same piece by piece, for files that need not lie in memory as a whole.
class FileReader {
  public:
    // Error: no such file, a folder, a device or pipe, unreadable.
    explicit FileReader(const std::filesystem::path& path);
    // The bytes that were there: fewer than asked for only at the end. Error: cannot be read.
    size_t read(void* data, size_t bytes);
    const Location& location() const { return location_; }

  private:
    Location location_;
    FilePointer file_;
};

class FileWriter {
  public:
    // Makes missing folders and the temporary file. Error: cannot create.
    explicit FileWriter(const std::filesystem::path& path);
    ~FileWriter();  // without finish() nothing stays, and the old file is kept
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;
    void write(const void* data, size_t bytes);  // Error: disk full
    void finish();                               // Error: disk full, cannot rename

  private:
    [[noreturn]] void fail(int cause) const;

    std::filesystem::path path_, temporary_;
    FilePointer file_;
};

}  // namespace shoal
