// Elements that are added to the lists of a scene. Rules between their keys ask for more than a description
// tells.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/json.h"
#include "scene/scene.h"

namespace shoal::window {

glm::dvec3 toMillimetre(const glm::dvec3& place);  // as the window writes places

// `wanted`, or that with a number, which no element of a list is called.
std::string freeName(const JsonValue& list, const std::string& wanted);

// The molecules that ship, and those beside a scene, as its file names them.
std::vector<std::string> moleculesFor(const std::string& sceneFile);
// A group of a molecule beside others of a scene, which shows what the molecule can do: a hundred in a box
// above the ground, in proportion to its size, turned any way and not held, with the drag of what flutters,
// swims or falls. `molecule`: as the scene's file names it.
JsonValue groupOf(const JsonValue& groups, const std::string& molecule, const Scene& scene);
// An emitter like the last, or one of 20 a second.
JsonValue newEmitter(const JsonValue& emitters);
// Lets a new collider stand on the ground below what the camera looks at.
void standInView(JsonValue& collider, const Scene& scene);

}  // namespace shoal::window
