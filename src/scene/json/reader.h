// Declares what the readers of the parts of a scene share.
#pragma once

#include <optional>
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
    const FieldBaking& baking;
    std::vector<Warning>& warnings;
};

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

// Refuses a name that an earlier element already has. An element's own name may be empty.
void refuseRepeated(const Where& where, const std::vector<std::string>& earlier, const std::string& name);

}  // namespace shoal
