// The list "colors" of a particle: keyframes of its life, which keep their order.
#pragma once

#include "core/json.h"

namespace shoal::window {

// Draws a life from birth to death as a bar, over black and over grey, with a mark at each keyframe.
void drawColorBar(const JsonValue& colors);
// Adds a keyframe where the widest gap is, if there is room for one.
void addColorKey(JsonValue& colors);
// Puts the age of a keyframe between its neighbours'.
void keepAge(JsonValue& colors, size_t index);

}  // namespace shoal::window
