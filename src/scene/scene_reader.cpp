#include "scene/scene_reader.h"

#include <algorithm>
#include <cmath>

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

bool getRotation(JsonReader& reader, const std::string& key, glm::dquat& out) {
    const JsonValue* value = reader.raw(key);
    if (!value) return false;
    if (value->kind == JsonValue::Kind::object) {
        auto turn = reader.object(key);
        glm::dvec3 axis(0, 1, 0);
        double angle = 0;
        turn->require("axis");
        getDirection(*turn, "axis", axis);
        turn->need("angle", angle);
        turn->finish();
        out = glm::angleAxis(angle, axis);
        return true;
    }
    std::vector<double> q;
    reader.get(key, q);
    if (q.size() != 4)
        throw Error(reader.at(key),
                    concat("expected a quaternion [x, y, z, w], found ", q.size(), " numbers"));
    const double largest = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
    if (!(largest > 0))
        throw Error(reader.at(key), "expected a quaternion [x, y, z, w] of any length above 0, found zero");
    for (double& part : q)
        part /= largest;  // before the squares, which could overflow
    out = glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]));
    return true;
}

bool getDirection(JsonReader& reader, const std::string& key, glm::dvec3& out) {
    glm::dvec3 v(0);
    if (!reader.get(key, v)) return false;
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0)) throw Error(reader.at(key), "expected a direction of any length above 0, found zero");
    out = glm::normalize(v / largest);
    return true;
}

bool getBox(JsonReader& reader, const std::string& key, Box& out, bool flat) {
    auto box = reader.object(key);
    if (!box) return false;
    box->need("low", out.low);
    box->need("high", out.high);
    for (int i = 0; i < 3; ++i)
        if (flat ? out.low[i] > out.high[i] : out.low[i] >= out.high[i])
            throw Error(box->at("high"), concat("expected high above low along every axis, found ",
                                                out.high[i], " against ", out.low[i], " along ", "xyz"[i]));
    box->finish();
    return true;
}

bool getSpan(JsonReader& reader, const std::string& key, glm::dvec2& out, Range range) {
    const JsonValue* value = reader.raw(key);
    if (!value) return false;
    if (value->kind == JsonValue::Kind::number) {
        reader.get(key, out.x, range);
        out.y = out.x;
        return true;
    }
    reader.get(key, out, range);
    if (out.x > out.y)
        throw Error(reader.at(key), concat("expected [least, most], found ", out.x, " above ", out.y));
    return true;
}

bool getColor(JsonReader& reader, const std::string& key, glm::dvec3& out) {
    return reader.get(key, out, Range::atLeast(0));
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

void refuseRepeated(const JsonReader& reader, const std::vector<std::string>& earlier,
                    const std::string& name) {
    if (!name.empty() && std::find(earlier.begin(), earlier.end(), name) != earlier.end())
        throw Error(reader.at("name"), "the name \"" + name + "\" is already taken");
}

}  // namespace shoal
