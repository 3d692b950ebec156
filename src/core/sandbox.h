// Which files may be opened: any, until a command asks to stay within some folders (`--sandbox`). That is a
// setting of the process, asked where files are opened, so that no reader can forget it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shoal {

// From now on nothing outside these folders is opened; none: any file is again. What a link in them points to
// counts as where it really is.
void openOnlyWithin(const std::vector<std::filesystem::path>& folders);

bool mayOpen(const std::filesystem::path& path);  // which need not exist
// Error, located at the file, where it may not be opened.
void refuseOutside(const std::filesystem::path& path);

constexpr const char* outsideSandbox = "lies outside the scene's folder and the shipped data (--sandbox)";

}  // namespace shoal
