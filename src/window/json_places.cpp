// The places and turns that rows of a scene name, and their handles in the picture.
#include <algorithm>
#include <cmath>

#include "core/json_build.h"
#include "window/edit_widgets.h"
#include "window/json_rows.h"
#include "window/new_elements.h"

namespace shoal::window {

// Where something stands, by the words that scenes have for it.
static bool isPlace(const Key& key) {
    constexpr const char* names[] = {"position", "center", "point", "origin", "from", "to"};
    return key.kind == Key::Kind::vector3 &&
           std::find(std::begin(names), std::end(names), key.name) != std::end(names);
}

namespace {

std::optional<glm::dvec3> vectorOf(const JsonValue* value) {
    const std::vector<double> numbers = value ? numbersOf(*value) : std::vector<double>();
    if (numbers.size() != 3) return {};
    return glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

}  // namespace

std::pair<glm::dvec3, double> axisAndAngle(const JsonValue& value) {
    glm::dvec3 axis(0, 1, 0);
    double angle = 0;
    if (const std::vector<double> q = numbersOf(value); q.size() == 4) {
        const glm::dvec3 imaginary(q[0], q[1], q[2]);
        if (glm::length(imaginary) > 0) axis = glm::normalize(imaginary);
        angle = 2 * std::atan2(glm::length(imaginary), q[3]);
    }
    axis = vectorOf(value.find("axis")).value_or(axis);
    if (const JsonValue* given = value.find("angle")) angle = given->number;
    return {axis, angle};
}

// An axis and an angle, whether the file has these or a quaternion.
bool JsonRows::drawRotation(Row row, JsonValue& value) {
    auto [axis, angle] = axisAndAngle(value);
    angle *= degrees;
    const std::string label = concat(row.label, ", axis");
    row.label = label.c_str(), row.format = "%.5g";
    bool changed = drag(row, {-1e3, 1e3}, &axis.x, 3, 0.01);
    changed |= drag({"angle", row.tip, "%.5g\xC2\xB0"}, {-360, 360, "there is"}, &angle, 1, 1);
    if (changed) value = object(shoal::key("axis", axis), shoal::key("angle", angle / degrees));
    return changed;
}

void JsonRows::addPlaces(const Key& key, const JsonValue& value, JsonValue& object) {
    const auto add = [&](JsonValue& parent, const std::string& name, const JsonValue& numbers) {
        if (const std::optional<glm::dvec3> position = vectorOf(&numbers))
            places_.push_back({&parent, name, {.label = inWords(name), .position = *position}});
    };
    if (isPlace(key)) add(object, key.name, value);
    if (isPlace(key) && (key.name == "position" || key.name == "center") && !places_.empty()) {
        GizmoHandle& handle = places_.back().handle;
        const JsonValue *radius = object.find("radius"), *turn = object.find("rotation");
        if (const auto size = vectorOf(object.find("size"))) handle.reach = *size / 2.0;
        handle.round = radius && radius->kind == JsonValue::Kind::number;
        if (handle.round) handle.reach = glm::dvec3(radius->number);
        if (turn || object.find("size")) {
            const auto [axis, angle] = turn ? axisAndAngle(*turn) : std::pair(glm::dvec3(0, 1, 0), 0.0);
            if (glm::length(axis) > 0) handle.turn = glm::angleAxis(angle, glm::normalize(axis));
        }
    }
    const auto low = key.kind == Key::Kind::box ? vectorOf(value.find("low")) : std::nullopt,
               high = key.kind == Key::Kind::box ? vectorOf(value.find("high")) : std::nullopt;
    if (low && high && object.find(key.name))
        places_.push_back(
            {&memberOf(object, key.name),
             "",
             {.label = inWords(key.name), .position = (*low + *high) / 2.0, .reach = (*high - *low) / 2.0}});
}

void JsonRows::move(const Place& place, const GizmoHandle& to) {
    JsonValue& object = *place.object;
    if (place.key.empty()) {
        setMember(object, "low", toJson(toMillimetre(to.position - *to.reach)));
        setMember(object, "high", toJson(toMillimetre(to.position + *to.reach)));
        return;
    }
    if (to.position != place.handle.position) setMember(object, place.key, toJson(toMillimetre(to.position)));
    if (to.reach != place.handle.reach && to.round)
        setMember(object, "radius", toJson(std::round(to.reach->x * 1e4) / 1e4));
    if (to.reach != place.handle.reach && !to.round)
        setMember(object, "size", toJson(toMillimetre(*to.reach * 2.0)));
    if (!to.turn || to.turn == place.handle.turn) return;
    setMember(object, "rotation",
              shoal::object(shoal::key("axis", toMillimetre(glm::axis(*to.turn))),
                            shoal::key("angle", std::round(glm::angle(*to.turn) * 1e4) / 1e4)));
}

}  // namespace shoal::window
