// Rows for the keys of an object of a scene file, by its description (core/description.h): whatever a file
// may say has one, but for what is read by hand and is more than a number, a text or a list of numbers. What
// a file leaves out is shown as what it then is.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/description.h"
#include "core/json.h"
#include "core/smallest.h"
#include "window/edit_widgets.h"

namespace shoal::window {

class JsonRows {
  public:
    // Texts that a key may say, such as names of groups; empty: any.
    using Choices = std::function<std::vector<std::string>(const std::string& key)>;
    explicit JsonRows(Choices choices) : choices_(std::move(choices)) {}

    // Whether the user changed the object in this frame.
    bool draw(const Description& keys, JsonValue& object);
    // The elements of a list, each with buttons, and a button to add one.
    bool drawList(const Key& key, JsonValue& list);

    // A place that a key of an element of a list names, which was drawn.
    struct Place {
        JsonValue* object;  // that has the key; until something changes
        std::string key;
        glm::dvec3 position;  // m
    };
    const std::vector<Place>& places() const { return places_; }

  private:
    bool drawKey(const Description& keys, const Key& key, JsonValue& object);
    void addPlaces(const Key& key, const JsonValue& value, JsonValue& object);
    bool drawPresent(const Key& key, JsonValue& value, const std::string& label);
    bool drawNode(const Key& key, JsonValue& value, bool startsOpen);
    bool drawRotation(const Key& key, JsonValue& value, const std::string& label);
    bool drawTexts(const Row& row, JsonValue& value);
    bool drawNumbers(const Key& key, JsonValue& value, const std::string& label);
    bool drawText(const Key& key, JsonValue& value, const std::string& label);
    bool drawKind(const Key& key, JsonValue& object);
    TextOf text() const;  // the first choice, or the key's name

    Choices choices_;
    std::vector<Place> places_;
    bool inList_ = false;  // an element is being drawn
};

// In place of what the object says of the key, if anything.
void setMember(JsonValue& object, const std::string& key, JsonValue value);

// A group of a molecule beside others. Rules between keys ask for more than a description tells: places.
JsonValue smallestGroup(const JsonValue& groups, const std::string& molecule);

// "sphere", or the name of an element of a list, or its number.
std::string titleOf(const JsonValue& element, size_t index);

}  // namespace shoal::window
