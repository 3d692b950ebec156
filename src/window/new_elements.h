// Elements that are added to the lists of a scene. Rules between their keys ask for more than a description
// tells.
#pragma once

#include <string>

#include "core/json.h"

namespace shoal::window {

// `wanted`, or that with a number, which no element of a list is called.
std::string freeName(const JsonValue& list, const std::string& wanted);

// A group of a molecule beside others.
JsonValue smallestGroup(const JsonValue& groups, const std::string& molecule);
// An emitter like the last, or one of 20 a second.
JsonValue newEmitter(const JsonValue& emitters);

}  // namespace shoal::window
