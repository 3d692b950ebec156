// Boxes and rotations.
#include <algorithm>

#include "core/kinds/parts.h"

namespace shoal {

namespace {

bool getBox(const Key& key, JsonReader& reader, Box& out) {
    auto box = reader.object(key.name);
    if (!box) return false;
    box->need("low", out.low);
    box->need("high", out.high);
    checkBox(out, key.flatBox, box->locate("high"));
    box->finish();
    return true;
}

void checkBoxOf(const Key& key, const void* value, const Where& where, double largest) {
    const Box& box = held<Box>(value);
    for (int i = 0; i < 3; ++i) {
        checkNumber(concat(key.name, ".low[", i, "]"), box.low[i], {}, where, largest);
        checkNumber(concat(key.name, ".high[", i, "]"), box.high[i], {}, where, largest);
    }
    checkBox(box, key.flatBox, where.locate(key.name + ".high"));
}

JsonValue boxJson(const Box& box) {
    return object(key("low", box.low), key("high", box.high));
}

// Error: of no length.
glm::dquat normalized(const glm::dquat& q, const Location& where) {
    const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)});
    if (largest == 0)
        throw Error(where, "expected a quaternion [x, y, z, w] of any length above 0, found zero");
    return glm::normalize(q / largest);  // the squares alone could overflow
}

bool getRotation(const Key& key, JsonReader& reader, glm::dquat& out) {
    const JsonValue* value = reader.raw(key.name);
    if (!value) return false;
    if (value->kind == JsonValue::Kind::object) {
        auto turn = reader.object(key.name);
        glm::dvec3 axis(0);
        double angle = 0;
        turn->need("axis", axis);
        axis = normalized(axis, turn->locate("axis"));
        turn->need("angle", angle);
        turn->finish();
        out = glm::angleAxis(angle, axis);
        return true;
    }
    std::vector<double> q;
    reader.get(key.name, q);
    if (q.size() != 4)
        throw Error(reader.locate(key.name), "expected a quaternion [x, y, z, w], found ", q.size(),
                    " numbers");
    out = normalized(glm::dquat(q[3], q[0], q[1], q[2]), reader.locate(key.name));
    return true;
}

void checkRotation(const Key& key, const void* value, const Where& where, double largest) {
    const glm::dquat& q = held<glm::dquat>(value);
    for (const double part : {q.x, q.y, q.z, q.w})
        checkNumber(key.name, part, {}, where, largest);
    normalized(q, where.locate(key.name));
}

JsonValue leastRotation(const Key&, const TextOf&) {
    return object(key("axis", glm::dvec3(0, 1, 0)), key("angle", 0.0));
}

JsonValue rotationJson(const glm::dquat& q) {
    return toJson(glm::dvec4(q.x, q.y, q.z, q.w));
}

}  // namespace

const KeyKind KeyKind::box = {.name = "box, m",
                              .form = RowForm::box,
                              .sliderReach = 1000,
                              .read = readValue<Box, getBox>,
                              .check = checkBoxOf,
                              .write = writeValue<Box, boxJson>,
                              .least = [](const Key&, const TextOf&) { return boxJson({}); },
                              .schema = [](const Key&, const SchemaOf&) { return schemaReference("box"); },
                              .numbers = numbersIn<6, double>};

const KeyKind KeyKind::rotation = {
    .name = "rotation",
    .form = RowForm::rotation,
    .read = readValue<glm::dquat, getRotation>,
    .check = checkRotation,
    .write = writeValue<glm::dquat, rotationJson>,
    .least = leastRotation,
    .schema = [](const Key&, const SchemaOf&) { return schemaReference("rotation"); }};

}  // namespace shoal
