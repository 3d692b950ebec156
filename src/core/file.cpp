#include "core/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <unistd.h>

#include "core/error.h"

namespace shoal {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

// Removes the unfinished file unless it was renamed into place.
struct TemporaryFile {
    fs::path path;
    bool keep = false;
    ~TemporaryFile() {
        std::error_code ignored;
        if (!keep) fs::remove(path, ignored);
    }
};

}  // namespace

std::string readFile(const fs::path& path, size_t maxBytes) {
    const Location location{path.string(), 0, 0, {}};
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (status.type() == fs::file_type::not_found) throw Error(location, "no such file");
    if (status.type() == fs::file_type::directory) throw Error(location, "is a folder, expected a file");
    FilePointer file(std::fopen(path.c_str(), "rb"));
    if (!file) throw Error(location, concat("cannot be read: ", std::strerror(errno)));

    std::string bytes;
    char chunk[1 << 16];
    while (const size_t count = std::fread(chunk, 1, sizeof chunk, file.get())) {
        bytes.append(chunk, count);
        if (bytes.size() > maxBytes)
            throw Error(location, concat("is larger than ", maxBytes, " bytes, the most that is read"));
    }
    if (std::ferror(file.get())) throw Error(location, concat("cannot be read: ", std::strerror(errno)));
    return bytes;
}

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return extension;
}

void writeFile(const fs::path& path, std::string_view bytes) {
    const Location location{path.string(), 0, 0, {}};
    std::error_code code;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
    if (code)
        throw Error(Location{path.parent_path().string(), 0, 0, {}},
                    "cannot make this folder: " + code.message());
    if (fs::is_directory(path, code)) throw Error(location, "is a folder, expected a file to write");

    TemporaryFile temporary{path.string() + ".part-" + std::to_string(::getpid())};
    FilePointer file(std::fopen(temporary.path.c_str(), "wb"));
    if (!file) throw Error(location, concat("cannot be written: ", std::strerror(errno)));
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                         std::fflush(file.get()) == 0;
    const int cause = errno;
    const bool closed = std::fclose(file.release()) == 0;
    if (!written || !closed)
        throw Error(location, concat("cannot be written: ", std::strerror(written ? errno : cause),
                                     " (nothing was kept)"));
    fs::rename(temporary.path, path, code);
    if (code) throw Error(location, concat("cannot be written: ", code.message()));
    temporary.keep = true;
}

void writeFile(const fs::path& path, std::span<const std::byte> bytes) {
    writeFile(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace shoal
