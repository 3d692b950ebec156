#include "gpu/program_cache.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/cache_folder.h"
#include "core/file.h"

namespace shoal::gpu {
namespace fs = std::filesystem;

namespace {

constexpr uint32_t layoutVersion = 1;
constexpr char magic[8] = {'s', 'h', 'o', 'a', 'l', 'p', 'r', 'g'};
constexpr const char* extension = ".shoal-program";
constexpr size_t largestFile = size_t{1} << 28;

struct Header {
    char magic[8];
    uint32_t version, format;
    uint64_t length, checksum;
};
static_assert(sizeof(Header) == 32);

// With the key, so that a whole file under another program's name is found out.
uint64_t checksum(const std::string& key, uint32_t format, std::string_view binary) {
    return fnv(binary, fnv(key + ":" + std::to_string(format)));
}

// Sets `format` and `binary`, a part of `bytes`. False: this is no file of ours, or not what we wrote.
bool parse(std::string_view bytes, const std::string& key, uint32_t& format, std::string_view& binary) {
    Header header;
    if (bytes.size() <= sizeof header) return false;
    std::memcpy(&header, bytes.data(), sizeof header);
    binary = bytes.substr(sizeof header);
    format = header.format;
    return std::memcmp(header.magic, magic, sizeof magic) == 0 && header.version == layoutVersion &&
           header.length == binary.size() && header.checksum == checksum(key, format, binary);
}

// Clears OpenGL's errors: a binary that the driver refuses is no mistake of ours.
void forgetErrors() {
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
    }
}

}  // namespace

std::string programKey(const ContextInfo& info, std::span<const std::string_view> texts) {
    std::string all;
    const auto add = [&](std::string_view part) {
        all += std::to_string(part.size()) + ":";  // so that parts cannot run into each other
        all += part;
    };
    add(std::to_string(layoutVersion));
    // EGL and OSMesa may be different builds of one Mesa, which do not take each other's binaries.
    add(name(info.kind));
    for (const std::string& driver : {info.renderer, info.vendor, info.version})
        add(driver);
    for (const std::string_view text : texts)
        add(text);
    return contentKey(all);
}

ProgramCache::ProgramCache(const ContextInfo& info, std::string folder) : folder_(std::move(folder)) {
    if (folder_.empty() || !info.atLeast(4, 1)) return;
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    active_ = formats > 0;
}

fs::path ProgramCache::file(const std::string& key) const {
    return folder_ / (key + extension);
}

bool ProgramCache::load(const std::string& key, GLuint program) {
    if (!active_) return false;
    if (fill(key, program)) {
        ++hits_;
        touchFile(file(key));
        return true;
    }
    ++misses_;
    glProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    return false;
}

bool ProgramCache::fill(const std::string& key, GLuint program) {
    const fs::path path = file(key);
    const auto compiledAnew = [&](const std::string& why) {
        warnings_.push_back({{path.string(), 0, 0, {}}, why + "; compiled anew"});
        return false;
    };
    std::error_code code;
    if (!fs::exists(path, code)) return false;
    std::string bytes;
    try {
        bytes = readFile(path, largestFile);
    } catch (const Error& error) {
        return compiledAnew("the cached program " + error.message());
    }
    uint32_t format = 0;
    std::string_view binary;
    if (!parse(bytes, key, format, binary)) return compiledAnew("the cached program is damaged");
    glProgramBinary(program, format, binary.data(), static_cast<GLsizei>(binary.size()));
    forgetErrors();
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    return linked == GL_TRUE;  // a driver may refuse its own: Mesa's, on another number of CPUs
}

void ProgramCache::store(const std::string& key, GLuint program) {
    if (!active_ || !writable_) return;
    GLint length = 0;
    glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0) return;
    std::string binary(static_cast<size_t>(length), '\0');
    GLenum format = 0;
    GLsizei written = 0;
    glGetProgramBinary(program, length, &written, &format, binary.data());
    forgetErrors();
    if (written <= 0) return;
    binary.resize(static_cast<size_t>(written));

    Header header{{}, layoutVersion, format, binary.size(), checksum(key, format, binary)};
    std::memcpy(header.magic, magic, sizeof magic);
    const std::string front(reinterpret_cast<const char*>(&header), sizeof header);
    try {
        writeFile(file(key), front + binary);
        keepNewest(folder_, extension,
                   std::clamp(size_t(hits_) + size_t(misses_), keptPrograms, mostPrograms));
    } catch (const Error& error) {
        writable_ = false;
        warnings_.push_back({error.location(), error.message() + "; programs are compiled at every start"});
    }
}

}  // namespace shoal::gpu
