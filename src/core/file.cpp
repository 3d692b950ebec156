#include "core/file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>

#include <fcntl.h>
#include <sys/file.h>
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
            throw Error(location_, "is ", kindOf(status.st_mode), ", expected a file");
    };
    if (::stat(path.c_str(), &status) == 0) {
        needRegular();
    } else if (errno == ENOENT || errno == ENOTDIR) {
        throw Error(location_, "no such file");
    }
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file >= 0) file_.reset(::fdopen(file, "rb"));
    if (!file_ || ::fstat(file, &status) != 0)
        throw Error(location_, "cannot be read: ", std::strerror(errno));
    needRegular();
    // As far as a file system compresses; what was never written costs nothing to make, and much to read.
    constexpr uint64_t always = 64'000'000, most = 32;
    const uint64_t size = uint64_t(status.st_size), stored = 512 * uint64_t(status.st_blocks);
    if (size > always && size / most > stored)
        throw Error(location_, "is sparse: of its ", size, " bytes only ", stored,
                    " are stored, and the rest is nothing");
}

size_t FileReader::read(void* data, size_t bytes) {
    if (bytes == 0) return 0;
    const size_t count = std::fread(data, 1, bytes, file_.get());
    if (std::ferror(file_.get())) throw Error(location_, "cannot be read: ", std::strerror(errno));
    return count;
}

std::string readFile(const fs::path& path, size_t maxBytes) {
    FileReader file(path);
    std::string bytes;
    const auto needSmall = [&](uint64_t count) {
        if (count > maxBytes)
            throw Error(file.location(), "is larger than ", maxBytes, " bytes, the most that is read");
    };
    std::error_code code;
    const uint64_t size = fs::file_size(path, code);
    if (!code) needSmall(size);
    if (!code) bytes.reserve(size_t(size));
    char chunk[1 << 16];
    while (const size_t count = file.read(chunk, sizeof chunk)) {  // it may have grown since
        bytes.append(chunk, count);
        needSmall(bytes.size());
    }
    return bytes;
}

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

std::string findProgram(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        std::string candidate = (folder.empty() ? "." : folder) + "/" + name;
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
    if (file < 0) throw Error(location, "cannot be written: ", std::strerror(errno));
    ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
    return FilePointer(::fdopen(file, "wb"));
}

void checkWritable(const fs::path& path) {
    if (!takesBytes(path))
        PartFile{path};  // made, and taken away again
    else if (::access(path.c_str(), W_OK) != 0)
        throw Error(Location{path.string()}, "cannot be written: ", std::strerror(errno));
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
    throw Error(Location{path_.string()}, "cannot be written: ", std::strerror(cause), " (nothing was kept)");
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

// ---- Files that are not whole yet

namespace {

constexpr std::string_view mark = ".shoal-";

// Holds what a part file's name says.
struct PartName {
    pid_t process = 0;
    std::string name;
};

std::optional<PartName> partName(const std::string& file) {
    if (file.rfind(mark, 0) != 0) return std::nullopt;
    PartName out;
    const char* end = file.data() + file.size();
    const auto [rest, code] = std::from_chars(file.data() + mark.size(), end, out.process);
    if (code != std::errc() || out.process < 1 || rest == end || *rest != '-') return std::nullopt;
    out.name.assign(rest + 1, end);
    return out;
}

// Names may be 255 bytes long; the end says what kind of file it is.
fs::path partPath(const fs::path& target, const fs::path& given) {
    constexpr size_t longest = 230;
    std::string name = given.filename().string();
    if (name.size() > longest) name = name.substr(name.size() - longest);
    return target.parent_path() / concat(mark, ::getpid(), "-", name);
}

// Whether a process still writes it. The lock tells it in other containers, too, where numbers of processes
// say nothing; the process where the file system has no locks.
bool isWritten(const fs::path& path, pid_t process) {
    if (process != ::getpid() && (::kill(process, 0) == 0 || errno != ESRCH)) return true;
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) return errno != ENOENT;
    const bool locked = ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(file);
    return locked;
}

template <typename Visit>
void forEachPart(const fs::path& folder, const Visit& visit) {
    std::error_code code;
    const fs::path where = folder.empty() ? fs::path(".") : folder;
    for (fs::directory_iterator entry(where, code), end; !code && entry != end; entry.increment(code)) {
        const std::optional<PartName> part = partName(entry->path().filename().string());
        std::error_code gone;
        if (part && entry->symlink_status(gone).type() == fs::file_type::regular) visit(entry->path(), *part);
    }
}

// Once a folder: others write their own.
void sweep(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> swept;
    const std::lock_guard lock(mutex);
    if (!swept.insert(folder).second) return;
    forEachPart(folder, [](const fs::path& path, const PartName& part) {
        std::error_code gone;
        if (!isWritten(path, part.process)) fs::remove(path, gone);
    });
}

fs::path behindLinks(fs::path path) {
    constexpr int most = 40;  // as the system follows
    std::error_code code;
    for (int i = 0; i < most && fs::is_symlink(path, code); ++i)
        path = path.parent_path() / fs::read_symlink(path, code);
    return path;
}

// Holds a part file's path where a signal's handler can read it: no memory elsewhere, nothing that moves.
struct Slot {
    enum State { free, filling, taken };
    std::atomic<int> state = free;
    pid_t owner = 0;  // a child that was forked has its parent's slots, and none of its own
    char path[PATH_MAX] = {};
};
Slot slots[16];

// -1: all are taken, or the name is too long; the next run sweeps it then.
int takeSlot(const std::string& path) {
    if (path.size() >= sizeof slots[0].path) return -1;
    for (int i = 0; i < int(std::size(slots)); ++i) {
        int state = Slot::free;
        if (!slots[i].state.compare_exchange_strong(state, Slot::filling)) continue;
        slots[i].owner = ::getpid();
        std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
        slots[i].state = Slot::taken;
        return i;
    }
    return -1;
}

// Returns a folder and those above it, as far as they are not there.
std::vector<fs::path> missingFolders(fs::path folder) {
    std::vector<fs::path> out;
    std::error_code code;
    for (; !folder.empty() && !fs::exists(folder, code); folder = folder.parent_path())
        out.push_back(folder);
    return out;
}

}  // namespace

PartFile::PartFile(const fs::path& target) : given_(target), target_(behindLinks(target)) {
    const Location location{given_.string()};
    std::error_code code;
    const fs::path folder = target_.parent_path();
    folders_.made = missingFolders(folder);
    if (!folder.empty()) fs::create_directories(folder, code);
    if (code) throw Error(Location{folder.string()}, "cannot make this folder: " + code.message());
    struct stat status {
    }, output{};
    if (::stat(target_.c_str(), &status) == 0) {
        if (!S_ISREG(status.st_mode))
            throw Error(location, "is ", kindOf(status.st_mode), ", expected a file to write");
        if (::fstat(STDOUT_FILENO, &output) == 0 && status.st_ino == output.st_ino &&
            status.st_dev == output.st_dev)
            throw Error(location, "is standard output, which would be lost");
    } else if (errno != ENOENT) {
        throw Error(location, "cannot be written: ", std::strerror(errno));
    }
    sweep(folder);
    path_ = partPath(target_, given_);
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0)
        throw Error(location, errno == EEXIST ? "cannot be written: it is being written already"
                                              : concat("cannot be written: ", std::strerror(errno)));
    slot_ = takeSlot(path_.string());
    ::flock(file_, LOCK_EX | LOCK_NB);  // where there are no locks, the process's number has to do
}

PartFile::NewFolders::~NewFolders() {
    std::error_code ignored;
    for (const fs::path& folder : made)
        fs::remove(folder, ignored);
}

PartFile::~PartFile() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
    if (slot_ >= 0) slots[slot_].state = Slot::free;
    ::close(file_);
}

void PartFile::replaceTarget() {
    std::error_code code;
    fs::rename(path_, target_, code);
    if (code) throw Error(Location{given_.string()}, "cannot be written: ", code.message());
    path_.clear();
}

SoleWriter::SoleWriter(const fs::path& target) : part_(concat(target.string(), ".run")) {
    const std::optional<PartName> own = partName(part_.path().filename().string());
    forEachPart(part_.path().parent_path(), [&](const fs::path& path, const PartName& part) {
        if (part.name == own->name && part.process != own->process && isWritten(path, part.process))
            throw Error(Location{target.string()}, "is being written by another run, process ", part.process,
                        ": give this one another name");
    });
}

void removePartFiles() noexcept {
    for (Slot& slot : slots)
        if (slot.state == Slot::taken && slot.owner == ::getpid()) ::unlink(slot.path);
}

FilePointer unnamedFile(const fs::path& target) {
    const std::vector<fs::path> missing = missingFolders(target.parent_path());
    const fs::path folder = missing.empty() ? target.parent_path() : missing.back().parent_path();
    std::string name = (folder / ".shoal-spool-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file < 0)
        throw Error(Location{target.string(), 0, 0, {}},
                    "no file can be made beside it: ", std::strerror(errno));
    ::unlink(name.c_str());
    return FilePointer(::fdopen(file, "w+b"));
}

}  // namespace shoal
