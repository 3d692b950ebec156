#include "run/scene_list.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/data_paths.h"
#include "core/json.h"
#include "core/printable.h"

namespace shoal {

namespace fs = std::filesystem;

constexpr std::string_view ending = ".scene.json";

static ListedScene listed(const std::string& file) {
    ListedScene out{file, {}, {}};
    try {
        const JsonValue root = readJson(file);
        const JsonValue *name = root.find("name"), *comment = root.find("comment");
        if (name) out.name = name->text;
        if (comment) out.comment = comment->text;
    } catch (const Error& error) {
        out.comment = error.what();
    }
    if (!out.name.empty()) return out;
    const std::string stem = fs::path(file).filename().string();
    out.name = stem.substr(0, stem.find('.'));
    return out;
}

static std::vector<std::string> filesBelow(const std::string& folder) {
    std::vector<std::string> out;
    std::error_code code;
    const auto skip = fs::directory_options::skip_permission_denied;
    constexpr int mostFiles = 100000;  // a folder such as / is not worth a search without end
    int seen = 0;
    for (fs::recursive_directory_iterator entry(folder, skip, code), end; !code && entry != end;
         entry.increment(code)) {
        if (++seen > mostFiles) break;
        const std::string name = entry->path().filename().string();
        if (name.size() > ending.size() && name.ends_with(ending)) out.push_back(entry->path().string());
    }
    std::sort(out.begin(), out.end());
    return out;
}

// Its path below the folder, without the ending.
static std::string nameBelow(const std::string& folder, const std::string& file) {
    const std::string path = fs::path(file).lexically_relative(folder).generic_string();
    return path.substr(0, path.size() - ending.size());
}

// The names in the folder's scenes.txt, one a line: the order in which its scenes are listed.
static std::vector<std::string> orderIn(const std::string& folder) {
    std::vector<std::string> out;
    std::ifstream lines(fs::path(folder) / "scenes.txt");
    for (std::string line; std::getline(lines, line);)
        if (!line.empty()) out.push_back(line);
    return out;
}

std::vector<ListedScene> scenesBelow(const std::string& folder) {
    std::vector<ListedScene> out;
    for (const std::string& file : filesBelow(folder))
        out.push_back(listed(file));
    const std::vector<std::string> order = orderIn(folder);
    const auto rank = [&](const ListedScene& scene) {
        return std::find(order.begin(), order.end(), nameBelow(folder, scene.file)) - order.begin();
    };
    std::sort(out.begin(), out.end(), [&](const ListedScene& a, const ListedScene& b) {
        return std::make_tuple(rank(a), a.name, a.file) < std::make_tuple(rank(b), b.name, b.file);
    });
    return out;
}

std::optional<std::string> sceneFile(const std::string& word) {
    std::error_code code;
    const fs::file_status status = fs::status(word, code);
    if ((fs::exists(status) && !fs::is_directory(status)) || word.ends_with(".json")) return word;
    const std::string folder = modelFolder();
    std::vector<std::string> names, files;
    for (const std::string& file : filesBelow(folder)) {
        const std::string name = nameBelow(folder, file);
        if (name == word || name == word + "/" + word) return file;
        if (!name.ends_with("/" + word)) continue;
        names.push_back(name);
        files.push_back(file);
    }
    if (files.size() == 1) return files[0];
    if (fs::is_directory(status)) return word;
    if (files.empty()) return {};
    throw Error(concat("several scenes are called \"", word, "\": say ", joined(names, " or ")));
}

std::string needScene(const std::string& word) {
    if (const std::optional<std::string> file = sceneFile(word)) return *file;
    const std::string folder = modelFolder();
    std::vector<std::string> names;
    for (const std::string& file : filesBelow(folder)) {
        names.push_back(nameBelow(folder, file));
        names.push_back(fs::path(names.back()).filename().string());
    }
    const std::string near = nearest(word, names);
    throw Error(concat(word, ": no such file, and no scene that ships is called so",
                       near.empty() ? "" : " (did you mean \"" + near + "\"?)", "; shoal scenes lists them"));
}

std::vector<std::pair<std::string, std::string>> shippedScenes() {
    std::vector<std::pair<std::string, std::string>> out;
    for (const std::string& file : filesBelow(modelFolder()))
        out.emplace_back(nameBelow(modelFolder(), file), file);
    return out;
}

std::string listOfScenes(const std::string& folder) {
    std::vector<std::pair<std::string, std::string>> rows;
    size_t width = 0;
    const bool ships = fs::path(folder) == fs::path(modelFolder());
    for (const ListedScene& scene : scenesBelow(folder)) {
        const std::string& words = scene.comment.empty() ? scene.name : scene.comment;
        // its first sentence
        rows.emplace_back(printable(ships ? nameBelow(folder, scene.file) : scene.file),
                          printable(words.substr(0, words.find(". "))));
        width = std::max(width, rows.back().first.size());
    }
    std::string out;
    for (const auto& [name, words] : rows)
        out += name + std::string(width + 2 - name.size(), ' ') + words + "\n";
    return out;
}

}  // namespace shoal
