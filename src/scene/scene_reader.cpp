#include "scene/scene_reader.h"

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

static void checkRotation(const glm::dquat& q, const Location& where) {
    if (q == glm::dquat(0, 0, 0, 0))
        throw Error(where, "expected a quaternion [x, y, z, w] of any length above 0, found zero");
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
    checkRotation(glm::dquat(q[3], q[0], q[1], q[2]), reader.at(key));
    for (double& part : q)
        part /= largest;  // before the squares, which could overflow
    out = glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]));
    return true;
}

bool getDirection(JsonReader& reader, const std::string& key, glm::dvec3& out) {
    glm::dvec3 v(0);
    if (!reader.get(key, v)) return false;
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    checkDirection(v, reader.at(key));
    out = glm::normalize(v / largest);
    return true;
}

void checkDirection(const glm::dvec3& v, const Location& where) {
    if (v == glm::dvec3(0)) throw Error(where, "expected a direction of any length above 0, found zero");
}

void checkSpan(const glm::dvec2& span, const Location& where) {
    if (span.x > span.y)
        throw Error(where, concat("expected [least, most], found ", span.x, " above ", span.y));
}

void checkBox(const Box& box, bool flat, const Location& where) {
    for (int i = 0; i < 3; ++i)
        if (flat ? box.low[i] > box.high[i] : box.low[i] >= box.high[i])
            throw Error(where, concat("expected high above low along every axis, found ", box.high[i],
                                      " against ", box.low[i], " along ", "xyz"[i]));
}

void checkRises(double time, double before, const Location& where) {
    if (!(time > before))
        throw Error(
            where, concat("expected a time after that of the keyframe before, ", before, " s, found ", time));
}

void needTwoKeyframes(size_t count, const Location& where) {
    if (count < 2) throw Error(where, concat("expected at least two keyframes, found ", count));
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

bool getBox(JsonReader& reader, const std::string& key, Box& out, bool flat) {
    auto box = reader.object(key);
    if (!box) return false;
    box->need("low", out.low);
    box->need("high", out.high);
    checkBox(out, flat, box->at("high"));
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
    checkSpan(out, reader.at(key));
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

void refuseRepeated(const Where& where, const std::vector<std::string>& earlier, const std::string& name) {
    if (!name.empty() && std::find(earlier.begin(), earlier.end(), name) != earlier.end())
        throw Error(where.at("name"), "the name \"" + name + "\" is already taken");
}

}  // namespace shoal
