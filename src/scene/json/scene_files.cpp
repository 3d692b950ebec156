#include "scene/json/scene_files.h"

#include <filesystem>
#include <fstream>
#include <set>

#include "core/file.h"
#include "core/json.h"
#include "scene/field_files/field_file.h"

namespace shoal {

namespace {

namespace fs = std::filesystem;

class Collector {
  public:
    void add(const fs::path& file) {
        if (!files.insert(file.string()).second) return;
        const std::string kind = lowerExtension(file);
        if (kind == ".json") addNamed(file);
        if (kind == ".obj") addMaterials(file);
    }

    std::set<std::string> files;

  private:
    void addIfFile(const fs::path& by, const std::string& text) {
        constexpr size_t longestName = 1024;
        if (text.empty() || text.size() > longestName || text.find('\0') != std::string::npos) return;
        const fs::path path = (by.parent_path() / text).lexically_normal();
        std::error_code code;
        if (fs::is_regular_file(path, code)) add(path);
        for (const std::string& one : numberedFiles(path))
            add(one);
    }

    void addNamed(const fs::path& file) {
        try {
            addTexts(file, readJson(file.string()));
        } catch (const Error&) {
            // whoever reads it for what it says tells what is wrong
        }
    }

    void addTexts(const fs::path& file, const JsonValue& value) {
        if (value.kind == JsonValue::Kind::string) addIfFile(file, value.text);
        for (const JsonValue& item : value.items)
            addTexts(file, item);
        for (const auto& [key, member] : value.members)
            addTexts(file, member);
    }

    // They stand before the faces that use them, as a rule at the beginning.
    void addMaterials(const fs::path& file) {
        if (!mayOpen(file)) return;
        constexpr int most = 200;  // lines
        std::ifstream in(file);
        std::string line;
        for (int i = 0; i < most && std::getline(in, line); ++i) {
            if (line.rfind("mtllib ", 0) != 0) continue;
            if (line.back() == '\r') line.pop_back();
            addIfFile(file, line.substr(7));
        }
    }
};

}  // namespace

std::vector<std::string> filesOf(const std::string& sceneFile) {
    Collector collector;
    collector.add(fs::path(sceneFile).lexically_normal());
    return {collector.files.begin(), collector.files.end()};
}

}  // namespace shoal
