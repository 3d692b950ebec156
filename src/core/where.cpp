#include "core/where.h"

#include <algorithm>
#include <cmath>

namespace shoal {

std::string Where::path() const {
    if (parent_ == nullptr) return reader_ ? reader_->path() : "$";
    // Without concat(), which takes its time: there is one for each spring.
    std::string out = parent_->path();
    if (*key_) out.append(".").append(key_);
    if (index_ != none) out.append("[").append(std::to_string(index_)).append("]");
    return out;
}

const JsonReader* Where::root() const {
    return parent_ ? parent_->root() : reader_;
}

const JsonValue* Where::value() const {
    if (parent_ == nullptr) return reader_ ? &reader_->value() : nullptr;
    const JsonValue* outer = parent_->value();
    const JsonValue* inner = outer && *key_ ? outer->find(key_) : outer;
    if (inner && index_ != none) return index_ < inner->items.size() ? &inner->items[index_] : nullptr;
    return inner;
}

Location Where::here() const {
    const JsonReader* file = root();
    const JsonValue* own = value();
    if (!file) return {{}, 0, 0, path()};
    return own ? Location{file->file(), own->line, own->column, path()} : parent_->here();
}

Location Where::locate(const std::string& key) const {
    return in(key.c_str()).here();
}

bool Where::given(const std::string& key) const {
    return in(key.c_str()).value() != nullptr;
}

double Where::number(const std::string& key, double fallback) const {
    const JsonValue* value = in(key.c_str()).value();
    return value ? value->number : fallback;
}

void Where::require(const std::string& key) const {
    if (reader_) return reader_->require(key);
    if (root() && !given(key)) throw Error(here(), "missing key \"" + key + "\"");
}

void needAtMost(const Where& where, const std::string& key, size_t count, size_t most) {
    if (count > most) throw Error(where.locate(key), "expected at most ", most, " ", key, ", found ", count);
}

void needFormat(JsonReader& root, const std::string& expected) {
    std::string format;
    root.need("format", format);
    if (format == expected) return;
    const size_t number = expected.rfind('-') + 1;
    const bool kin = format.compare(0, number, expected, 0, number) == 0 && format.size() > number &&
                     format.find_first_not_of("0123456789", number) == std::string::npos;
    throw Error(root.locate("format"), "expected the format \"", expected, "\", found \"", format, "\"",
                kin ? ": the file is of a newer version of Shoal" : "");
}

// ---- Values of several numbers

void checkRotation(const glm::dquat& q, const Location& where) {
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
        throw Error(reader.locate(key), "expected a quaternion [x, y, z, w], found ", q.size(), " numbers");
    const double largest = std::max({std::abs(q[0]), std::abs(q[1]), std::abs(q[2]), std::abs(q[3])});
    checkRotation(glm::dquat(q[3], q[0], q[1], q[2]), reader.locate(key));
    for (double& part : q)
        part /= largest;  // before the squares, which could overflow
    out = glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]));
    return true;
}

bool getDirection(JsonReader& reader, const std::string& key, glm::dvec3& out) {
    glm::dvec3 v(0);
    if (!reader.get(key, v)) return false;
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    checkDirection(v, reader.locate(key));
    out = glm::normalize(v / largest);
    return true;
}

void checkDirection(const glm::dvec3& v, const Location& where) {
    if (v == glm::dvec3(0)) throw Error(where, "expected a direction of any length above 0, found zero");
}

void checkSpan(const glm::dvec2& span, const Location& where) {
    if (span.x > span.y) throw Error(where, "expected [least, most], found ", span.x, " above ", span.y);
}

void checkBox(const Box& box, bool flat, const Location& where) {
    for (int i = 0; i < 3; ++i)
        if (flat ? box.low[i] > box.high[i] : box.low[i] >= box.high[i])
            throw Error(where, "expected high above low along every axis, found ", box.high[i], " against ",
                        box.low[i], " along ", "xyz"[i]);
}

bool getBox(JsonReader& reader, const std::string& key, Box& out, bool flat) {
    auto box = reader.object(key);
    if (!box) return false;
    box->need("low", out.low);
    box->need("high", out.high);
    checkBox(out, flat, box->locate("high"));
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
    checkSpan(out, reader.locate(key));
    return true;
}

JsonValue writeBox(const Box& box) {
    return JsonValue::makeObject()
        .add("low", JsonValue::makeVector(box.low))
        .add("high", JsonValue::makeVector(box.high));
}

}  // namespace shoal
