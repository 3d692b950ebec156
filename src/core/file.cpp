#include "core/file.h"

#include <cerrno>
#include <cstring>

#include <unistd.h>

#include "core/error.h"

namespace shoal {

namespace fs = std::filesystem;

FileReader::FileReader(const fs::path& path) : location_{path.string(), 0, 0, {}} {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (status.type() == fs::file_type::not_found) throw Error(location_, "no such file");
    if (status.type() == fs::file_type::directory) throw Error(location_, "is a folder, expected a file");
    // A device has no end, and a pipe would wait for ever.
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw Error(location_, "is a device, a pipe or a socket, expected a file");
    file_.reset(std::fopen(path.c_str(), "rb"));
    if (!file_) throw Error(location_, concat("cannot be read: ", std::strerror(errno)));
}

size_t FileReader::read(void* data, size_t bytes) {
    if (bytes == 0) return 0;
    const size_t count = std::fread(data, 1, bytes, file_.get());
    if (std::ferror(file_.get())) throw Error(location_, concat("cannot be read: ", std::strerror(errno)));
    return count;
}

std::string readFile(const fs::path& path, size_t maxBytes) {
    FileReader file(path);
    std::string bytes;
    char chunk[1 << 16];
    while (const size_t count = file.read(chunk, sizeof chunk)) {
        bytes.append(chunk, count);
        if (bytes.size() > maxBytes)
            throw Error(file.location(),
                        concat("is larger than ", maxBytes, " bytes, the most that is read"));
    }
    return bytes;
}

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return extension;
}

FileWriter::FileWriter(const fs::path& path) : path_(path) {
    std::error_code code;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
    if (code)
        throw Error(Location{path.parent_path().string(), 0, 0, {}},
                    "cannot make this folder: " + code.message());
    if (fs::is_directory(path, code))
        throw Error(Location{path.string(), 0, 0, {}}, "is a folder, expected a file to write");
    temporary_ = path.string() + ".part-" + std::to_string(::getpid());
    file_.reset(std::fopen(temporary_.c_str(), "wb"));
    if (!file_)
        throw Error(Location{path.string(), 0, 0, {}}, concat("cannot be written: ", std::strerror(errno)));
}

FileWriter::~FileWriter() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void FileWriter::fail(int cause) const {
    throw Error(Location{path_.string(), 0, 0, {}},
                concat("cannot be written: ", std::strerror(cause), " (nothing was kept)"));
}

void FileWriter::write(const void* data, size_t bytes) {
    if (bytes == 0) return;  // of an empty array, which may have no address
    if (std::fwrite(data, 1, bytes, file_.get()) != bytes) fail(errno);
}

void FileWriter::finish() {
    if (std::fflush(file_.get()) != 0) fail(errno);
    if (std::fclose(file_.release()) != 0) fail(errno);
    std::error_code code;
    fs::rename(temporary_, path_, code);
    if (code) throw Error(Location{path_.string(), 0, 0, {}}, concat("cannot be written: ", code.message()));
    temporary_.clear();
}

void writeFile(const fs::path& path, std::string_view bytes) {
    FileWriter file(path);
    file.write(bytes.data(), bytes.size());
    file.finish();
}

void writeFile(const fs::path& path, std::span<const std::byte> bytes) {
    writeFile(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace shoal
