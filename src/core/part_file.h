// A file that is not whole yet, beside the one that it becomes: ".shoal-<process>-<name>".
//
// It goes with its object, and with a signal that ends the program (removePartFiles). What a killed process
// left goes when another one first writes into that folder; a lock tells it from what is still written.
#pragma once

#include <filesystem>

namespace shoal {

class PartFile {
  public:
    // Makes missing folders. Through a link, into what it points to. Error: cannot be created, or what is
    // there is no regular file, which cannot be replaced.
    explicit PartFile(const std::filesystem::path& target);
    ~PartFile();
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const std::filesystem::path& path() const { return path_; }  // ends as the target does
    int file() const { return file_; }                           // open for writing, as long as this lives
    void replaceTarget();                                        // Error: cannot be renamed

  private:
    std::filesystem::path given_, target_, path_;
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

}  // namespace shoal
