// Reads and writes whole files, with errors that say what to do.
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

// The value of an environment variable; empty: it is not set, or set to nothing.
std::string environment(const char* name);

// The program of that name by PATH; empty: there is none.
std::string findProgram(const std::string& name);

// "a folder", "a FIFO", "a socket" or "a device", of what is no regular file.
std::string kindOf(mode_t mode);

// Which files may be opened: any, until a command asks to stay within some folders (`--sandbox`). That is a
// setting of the process, asked where files are opened, so that no reader can forget it.
//
// From now on nothing outside these folders is opened; none: any file is again. What a link in them points to
// counts as where it really is.
void openOnlyWithin(const std::vector<std::filesystem::path>& folders);

bool mayOpen(const std::filesystem::path& path);  // which need not exist
// Error, located at the file, where it may not be opened.
void refuseOutside(const std::filesystem::path& path);

constexpr const char* outsideSandbox = "lies outside the scene's folder and the shipped data (--sandbox)";

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

// Opens a file for data too long for memory, for writing and reading. It lies beside `target`, or in the
// nearest folder above it that is there already, where there is room for it if there is for `target`, and has
// no name, so that it vanishes when it is closed. Error: cannot be made.
FilePointer unnamedFile(const std::filesystem::path& target);

// Reads a file piece by piece, where it need not lie in memory as a whole.
class FileReader {
  public:
    // Error: no such file, unreadable, no regular file (a FIFO would be waited for, a device has no end),
    // sparse (above 64 MB and 32 times what is stored of it), or it may not be opened (refuseOutside).
    explicit FileReader(const std::filesystem::path& path);
    // The bytes that were there: fewer than asked for only at the end. Error: cannot be read.
    size_t read(void* data, size_t bytes);
    const Location& location() const { return location_; }

  private:
    Location location_;
    FilePointer file_;
};

// A file that is not whole yet, beside the one that it becomes: ".shoal-<process>-<name>".
//
// It goes with its object, and with a signal that ends the program (removePartFiles). What a killed process
// left goes when another one first writes into that folder; a lock tells it from what is still written.
class PartFile {
  public:
    // Makes missing folders, which go with it as well. Through a link, into what it points to. Error: cannot
    // be created, or what is there is no regular file, which cannot be replaced.
    explicit PartFile(const std::filesystem::path& target);
    ~PartFile();
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const std::filesystem::path& path() const { return path_; }  // ends as the target does
    int file() const { return file_; }                           // open for writing, as long as this lives
    void replaceTarget();                                        // Error: cannot be renamed

  private:
    // Removes the folders that were made, the innermost first, where they are empty.
    struct NewFolders {
        std::vector<std::filesystem::path> made;
        ~NewFolders();
    };
    std::filesystem::path given_, target_, path_;
    NewFolders folders_;
    int file_ = -1, slot_ = -1;
};

// While it lives, no other process gets the same: for runs whose many files would mix.
class SoleWriter {
  public:
    // Error: another process has it, or PartFile's.
    explicit SoleWriter(const std::filesystem::path& target);

  private:
    PartFile part_;
};

// Removes all part files of this process; safe in a signal's handler.
void removePartFiles() noexcept;

// Writes a file piece by piece. Without finish() nothing of it stays, and the old file is kept. A device or
// FIFO that takes bytes (/dev/null, a FIFO that somebody reads) is never replaced: the bytes go there as they
// come.
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
