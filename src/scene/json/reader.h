// Declares what the readers of the parts of a scene share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "core/description.h"
#include "core/where.h"
#include "geometry/distance_field.h"
#include "scene/scene.h"

namespace shoal {

// Refuses numbers beyond largestNumber anywhere in the file, seeds and counts apart.
void refuseHugeNumbers(const JsonValue& value, const std::string& file, const std::string& path = "$");

// The context of keys that are read by hand (core/description.h). What is written by hand has the Scene.
struct SceneReading {
    const std::vector<Model>& models;  // that were read before
    std::vector<Warning>& warnings;
    bool lenient = false;  // what is lost of a model is a warning, no error
};

// Bakes the distance fields of a scene of which all else is read, or takes them from where they are kept.
void bakeFields(Scene& scene, const FieldBaking& baking, const Where& whole);

// Derives a group's capacity from the keys of its life and emitters, unless a file gives it.
void deriveLife(Group& group, const Where& where);

// Rules between the parts of a scene, of a file or made in code.
void checkGroups(const Scene& scene, const Where& where);
void checkSurfaces(const Scene& scene, const Where& where);

// Warns of what is valid, but hardly meant.
std::vector<Warning> warningsOf(const Group& group, const Where& where);

// A key that names a file: its path, relative to the folder of the file that names it.
// Error at the key: absent, empty, or no such file.
std::string needFile(JsonReader& reader, const std::string& key);
std::string needFile(const Where& where, const std::string& key, const std::string& written);

// A key that names a model: its index.
int needModel(JsonReader& reader, const std::string& key, const std::vector<Model>& models);
int needModel(const Where& where, const std::string& key, const std::string& name,
              const std::vector<Model>& models);

template <typename T>
std::vector<std::string> namesOf(const std::vector<T>& list) {
    std::vector<std::string> names;
    for (const T& element : list)
        names.push_back(element.name);
    return names;
}

// The index of a name among others. Error: `what` "name" (did you mean ...), or `none` where there are none.
size_t needNamed(const std::string& name, const std::vector<std::string>& names, const Location& where,
                 const std::string& what, const char* none = "");

// Refuses the name of an element that an earlier one already has. It may be empty.
template <typename T>
void refuseRepeated(const Where& where, const std::vector<T>& list, size_t index) {
    const std::string& name = list[index].name;
    const auto same = [&](const T& earlier) { return earlier.name == name; };
    if (!name.empty() && std::any_of(list.begin(), list.begin() + std::ptrdiff_t(index), same))
        throw Error(where.locate("name"), "the name \"" + name + "\" is already taken");
}

}  // namespace shoal
