// Rows for the keys of an object of a file, by its description (core/description.h): whatever a file
// may say has one, but for what is read by hand and is more than a number, a text or a list of numbers. What
// a file leaves out is shown as what it then is. The only rows that the window has for scenes.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <imgui.h>

#include "core/description.h"
#include "core/json.h"
#include "core/smallest.h"
#include "window/edit_widgets.h"
#include "window/gizmo.h"
#include "window/molecule_picker.h"

namespace shoal::window {

class JsonRows {
  public:
    // Texts that a key may say, such as names of groups; empty: any.
    using Choices = std::function<std::vector<std::string>(const std::string& key)>;
    explicit JsonRows(Choices choices) : choices_(std::move(choices)) {}

    // Whether the user changed the object in this frame. `runs`: the struct that was read from it, perhaps
    // before it changed; null: there is none.
    bool draw(const Description& keys, JsonValue& object, const void* runs);
    std::vector<std::string> opens;  // lists that are open at first unless empty, and an only element

    // A place or a box that a key of an element of a list names, which was drawn.
    struct Place {
        JsonValue* object;   // that has the key, or a box; until something changes
        std::string key;     // empty: of a box
        GizmoHandle handle;  // with the size and the turn that stand beside it
    };
    const std::vector<Place>& places() const { return places_; }
    static void move(const Place& place, const GizmoHandle& to);
    void begin(const Scene& scene);  // a frame, in which rows of the scene are drawn

  private:
    bool drawKey(const Description& keys, const Key& key, JsonValue& object, const void* runs);
    JsonValue ticked(const Key& key, const void* runs) const;
    void addPlaces(const Key& key, const JsonValue& value, JsonValue& object);
    bool drawPresent(const Description& keys, const Key& key, JsonValue& value, bool* says);
    bool drawNode(const Key& key, JsonValue& value, const void* runs, bool* says);
    // The elements of a list, each with buttons, and a button to add one.
    bool drawList(const Key& key, JsonValue& list, const void* runs);
    bool drawRotation(Row row, JsonValue& value);
    bool drawDirection(const Row& row, JsonValue& value);
    bool drawTexts(const Row& row, JsonValue& value);
    bool drawNumbers(const Key& key, JsonValue& value, Row row);
    bool drawSpan(const Description& keys, const Key& key, JsonValue& value, Row row);
    bool drawText(const Key& key, JsonValue& value, const Row& row);
    bool drawKind(const Key& key, JsonValue& object, const void* runs);
    std::optional<JsonValue> addedTo(const Key& key, const JsonValue& list);
    Slider* sliderOf(const Key& key, const std::vector<double>& numbers);
    TextOf text() const;  // the first choice, or the key's name

    Choices choices_;
    const Scene* scene_ = nullptr;
    MoleculePicker molecules_;
    std::vector<Place> places_;
    bool inList_ = false;  // an element is being drawn
    ImGuiID fresh_ = 0;    // a node that was added, which opens
    // By the row's place in the window, since a slider that follows its number would run away.
    std::map<ImGuiID, Slider> sliders_;
    std::map<ImGuiID, glm::dvec2> angles_;  // rad, of directions
};

// An axis and an angle, rad, whether a file has these or a quaternion.
std::pair<glm::dvec3, double> axisAndAngle(const JsonValue& rotation);

// The name of an element of a list, its kind, or what its file is called; else its number.
std::string titleOf(const JsonValue& element, size_t index);

}  // namespace shoal::window
