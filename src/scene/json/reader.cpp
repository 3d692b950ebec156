#include "scene/json/reader.h"

#include <algorithm>
#include <cmath>

#include "core/sandbox.h"

namespace shoal {

namespace fs = std::filesystem;

void refuseHugeNumbers(const JsonValue& value, const std::string& file, const std::string& path) {
    if (value.kind == JsonValue::Kind::number && !(std::abs(value.number) <= largestNumber))
        throw Error(Location{file, value.line, value.column, path},
                    concat("expected a number within ", largestNumber, " of 0, found ", value.text));
    for (size_t i = 0; i < value.items.size(); ++i)
        refuseHugeNumbers(value.items[i], file, concat(path, "[", i, "]"));
    for (const auto& [key, member] : value.members)
        if (key != "seed" && key != "count") refuseHugeNumbers(member, file, path + "." + key);
}

std::string needFile(JsonReader& reader, const std::string& key) {
    std::string written;
    reader.need(key, written);
    if (written.empty()) throw Error(reader.at(key), "expected the name of a file, found an empty string");
    if (written.find('\0') != std::string::npos)
        throw Error(reader.at(key), "expected the name of a file, found a null character in it");
    const fs::path path = (fs::path(reader.file()).parent_path() / written).lexically_normal();
    std::error_code code;
    if (!mayOpen(path)) throw Error(reader.at(key), concat("\"", written, "\" ", outsideSandbox));
    if (!fs::exists(path, code)) throw Error(reader.at(key), "no such file: " + path.string());
    if (fs::is_directory(path, code))
        throw Error(reader.at(key), "expected a file, found a folder: " + path.string());
    return path.string();
}

int needModel(JsonReader& reader, const std::string& key, const std::vector<Model>& models) {
    std::string name;
    reader.need(key, name);
    std::vector<std::string> names;
    for (const Model& model : models)
        names.push_back(model.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        const std::string hint = names.empty() ? " (the scene has no models)" : suggestion(name, names);
        throw Error(reader.at(key), "no model is named \"" + name + "\"" + hint);
    }
    return static_cast<int>(found - names.begin());
}

void checkModel(int model, const std::vector<Model>& models, const Location& where) {
    if (models.empty()) throw Error(where, "expected a model to sit on (the scene has no models)");
    if (model < 0 || size_t(model) >= models.size())
        throw Error(where,
                    concat("expected the number of a model, 0 to ", models.size() - 1, ", found ", model));
}

void CheckScene::span(const std::string& key, const glm::dvec2& value, Range range) const {
    number(key, value, range);
    if (value.x > value.y) checkSpan(value, where().at(key));
}

void CheckScene::direction(const std::string& key, const glm::dvec3& value) const {
    number(key, value);
    if (value == glm::dvec3(0)) checkDirection(value, where().at(key));
}

void CheckScene::box(const std::string& key, const Box& value, bool flat) const {
    number(key + ".low", value.low);
    number(key + ".high", value.high);
    checkBox(value, flat, where().at(key + ".high"));
}

void CheckScene::rotation(const std::string& key, const glm::dquat& value) const {
    for (const double part : {value.x, value.y, value.z, value.w})
        number(key, part);
    checkRotation(value, where().at(key));
}

bool getColor(JsonReader& reader, const std::string& key, std::optional<glm::dvec3>& out) {
    glm::dvec3 color(0);
    if (!getColor(reader, key, color)) return false;
    out = color;
    return true;
}

bool getOptional(JsonReader& reader, const std::string& key, std::optional<double>& out, Range range) {
    double value = 0;
    if (!reader.get(key, value, range)) return false;
    out = value;
    return true;
}

void refuseRepeated(const Where& where, const std::vector<std::string>& earlier, const std::string& name) {
    if (!name.empty() && std::find(earlier.begin(), earlier.end(), name) != earlier.end())
        throw Error(where.at("name"), "the name \"" + name + "\" is already taken");
}

void takeName(const Where& where, std::vector<std::string>& taken, const std::string& name) {
    refuseRepeated(where, taken, name);
    taken.push_back(name);
}

}  // namespace shoal
