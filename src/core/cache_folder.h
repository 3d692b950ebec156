// Finds the folder that is kept between runs, and names and checks the files in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace shoal {

// $SHOAL_CACHE (empty: no cache), $XDG_CACHE_HOME/shoal, ~/.cache/shoal; else empty.
std::string cacheFolder();

// 32 hexadecimal digits of a content (FNV-1a, forwards and backwards): names a cached file.
std::string contentKey(std::string_view bytes);

// FNV-1a of 64 bits: tells a damaged file.
constexpr uint64_t fnvStart = 14695981039346656037ull;
uint64_t fnv(std::string_view bytes, uint64_t hash = fnvStart);

// Marks a file as used now, and keeps only the `kept` files of this extension that were used last. Another
// process may do the same at the same time: what has gone already is no mistake.
void touchFile(const std::filesystem::path& file);
void keepNewest(const std::filesystem::path& folder, const char* extension, size_t kept);

}  // namespace shoal
