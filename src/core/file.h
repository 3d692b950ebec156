// Reading and writing whole files, with errors that say what to do.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shoal {

// The file's bytes. Error: no such file, a folder, unreadable, or above maxBytes.
std::string readFile(const std::filesystem::path& path, size_t maxBytes = size_t{1} << 31);

// ".png" of "a/b.PNG"; empty without an extension.
std::string lowerExtension(const std::filesystem::path& path);

// Writes beside the target and renames, so that a full disk or a crash never leaves half a file.
// Missing folders are made. Error: cannot create, write (disk full), or rename; the old file is kept.
void writeFile(const std::filesystem::path& path, std::string_view bytes);
void writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace shoal
