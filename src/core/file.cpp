#include "core/file.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace shoal {

namespace fs = std::filesystem;

std::string kindOf(mode_t mode) {
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a FIFO";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

// Looked at before it is opened, because a FIFO would wait for its writer and a device may do anything; and
// afterwards, because it may have become another one in between.
FileReader::FileReader(const fs::path& path) : location_{path.string()} {
    refuseOutside(path);
    struct stat status {};
    const auto needRegular = [&] {
        if (!S_ISREG(status.st_mode))
            throw Error(location_, concat("is ", kindOf(status.st_mode), ", expected a file"));
    };
    if (::stat(path.c_str(), &status) == 0) {
        needRegular();
    } else if (errno == ENOENT || errno == ENOTDIR) {
        throw Error(location_, "no such file");
    }
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file >= 0) file_.reset(::fdopen(file, "rb"));
    if (!file_ || ::fstat(file, &status) != 0)
        throw Error(location_, concat("cannot be read: ", std::strerror(errno)));
    needRegular();
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

std::string findProgram(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string candidate = (folder.empty() ? "." : folder) + "/" + name;
        if (access(candidate.c_str(), X_OK) == 0 && !std::filesystem::is_directory(candidate))
            return candidate;
    }
    return {};
}

std::string lowerExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return extension;
}

// Disks are devices, too, and are not among them.
static bool takesBytes(const fs::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 && (S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode));
}

// A FIFO that nobody reads would be waited for.
static FilePointer openForBytes(const fs::path& path) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    const Location location{path.string()};
    if (file < 0 && errno == ENXIO) throw Error(location, "cannot be written: nobody reads there");
    if (file < 0) throw Error(location, concat("cannot be written: ", std::strerror(errno)));
    ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
    return FilePointer(::fdopen(file, "wb"));
}

void checkWritable(const fs::path& path) {
    if (!takesBytes(path))
        PartFile{path};  // made, and taken away again
    else if (::access(path.c_str(), W_OK) != 0)
        throw Error(Location{path.string()}, concat("cannot be written: ", std::strerror(errno)));
}

FileWriter::FileWriter(const fs::path& path) : path_(path) {
    if (takesBytes(path)) {
        file_ = openForBytes(path);
    } else {
        part_.emplace(path);
        file_.reset(::fdopen(::fcntl(part_->file(), F_DUPFD_CLOEXEC, 0), "wb"));
    }
    if (!file_) fail(errno);
}

void FileWriter::fail(int cause) const {
    throw Error(Location{path_.string()},
                concat("cannot be written: ", std::strerror(cause), " (nothing was kept)"));
}

void FileWriter::write(const void* data, size_t bytes) {
    if (bytes == 0) return;  // of an empty array, which may have no address
    if (std::fwrite(data, 1, bytes, file_.get()) != bytes) fail(errno);
}

void FileWriter::finish() {
    if (std::fflush(file_.get()) != 0) fail(errno);
    if (std::fclose(file_.release()) != 0) fail(errno);
    if (part_) part_->replaceTarget();
}

void writeFile(const fs::path& path, std::string_view bytes) {
    FileWriter file(path);
    file.write(bytes.data(), bytes.size());
    file.finish();
}

void writeFile(const fs::path& path, std::span<const std::byte> bytes) {
    writeFile(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

// ---- Which files may be opened

namespace fs = std::filesystem;

namespace {

std::vector<fs::path>& folders() {
    static std::vector<fs::path> within;
    return within;
}

// Without links, as far as it exists. Empty where that cannot be found out.
fs::path real(const fs::path& path) {
    std::error_code code;
    const fs::path whole = fs::absolute(path, code);
    fs::path out = code ? fs::path() : fs::weakly_canonical(whole, code);
    if (code) return {};
    return out.has_filename() ? out : out.parent_path();  // "folder/" as "folder"
}

bool lies(const fs::path& path, const fs::path& within) {
    return std::mismatch(within.begin(), within.end(), path.begin(), path.end()).first == within.end();
}

}  // namespace

void openOnlyWithin(const std::vector<fs::path>& given) {
    folders().clear();
    for (const fs::path& folder : given)
        if (!folder.empty()) folders().push_back(real(folder));
}

bool mayOpen(const fs::path& path) {
    if (folders().empty()) return true;
    const fs::path file = real(path);
    return !file.empty() && std::any_of(folders().begin(), folders().end(), [&](const fs::path& folder) {
        return !folder.empty() && lies(file, folder);
    });
}

void refuseOutside(const fs::path& path) {
    if (!mayOpen(path)) throw Error(Location{path.string()}, outsideSandbox);
}

}  // namespace shoal
