#include "scene/json/reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/file.h"

namespace shoal {

namespace fs = std::filesystem;

void refuseHugeNumbers(const JsonValue& value, const std::string& file, const std::string& path) {
    if (value.kind == JsonValue::Kind::number && !(std::abs(value.number) <= largestNumber))
        throw Error(Location{file, value.line, value.column, path}, "expected a number within ",
                    largestNumber, " of 0, found ", value.text);
    for (size_t i = 0; i < value.items.size(); ++i)
        refuseHugeNumbers(value.items[i], file, concat(path, "[", i, "]"));
    for (const auto& [key, member] : value.members)
        if (key != "seed" && key != "count") refuseHugeNumbers(member, file, path + "." + key);
}

std::string needFile(const Where& where, const std::string& key, const std::string& written) {
    const Location location = where.locate(key);
    if (written.empty()) throw Error(location, "expected the name of a file, found an empty string");
    if (written.find('\0') != std::string::npos)
        throw Error(location, "expected the name of a file, found a null character in it");
    const fs::path path = (fs::path(location.file).parent_path() / written).lexically_normal();
    std::error_code code;
    if (!mayOpen(path)) throw Error(location, "\"", written, "\" ", outsideSandbox);
    if (!fs::exists(path, code)) throw Error(location, "no such file: " + path.string());
    if (fs::is_directory(path, code))
        throw Error(location, "expected a file, found a folder: " + path.string());
    return path.string();
}

std::string needFile(JsonReader& reader, const std::string& key) {
    std::string written;
    reader.need(key, written);
    return needFile(Where(reader), key, written);
}

size_t needNamed(const std::string& name, const std::vector<std::string>& names, const Location& where,
                 const std::string& what, const char* none) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw Error(where, what + " \"" + name + "\"" + (names.empty() ? none : suggestion(name, names)));
    return size_t(found - names.begin());
}

int needModel(const Where& where, const std::string& key, const std::string& name,
              const std::vector<Model>& models) {
    return int(needNamed(name, namesOf(models), where.locate(key), "no model is named",
                         " (the scene has no models)"));
}

int needModel(JsonReader& reader, const std::string& key, const std::vector<Model>& models) {
    std::string name;
    reader.need(key, name);
    return needModel(Where(reader), key, name, models);
}

}  // namespace shoal
