// The parts of the scene reader. Used by scene_*.cpp only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json.h"
#include "scene/distance_field_cache.h"
#include "scene/scene.h"

namespace shoal {

// The GPU computes in single precision: squares of larger numbers would overflow there, and smaller ones
// are as good as 0.
constexpr double largestNumber = 1e15, leastPositive = 1e-9;

inline Range aboveZero() {
    return Range::atLeast(leastPositive);
}

// Refuses numbers beyond largestNumber anywhere in the file, seeds and counts apart.
void refuseHugeNumbers(const JsonValue& value, const std::string& file, const std::string& path = "$");

std::vector<Field> readFields(JsonReader& scene);
// Error: a force for a group that there is not.
std::vector<Force> readForces(JsonReader& scene, const std::vector<Group>& groups);
std::vector<Model> readModels(JsonReader& scene);
std::vector<Collider> readColliders(JsonReader& scene, const std::vector<Model>& models,
                                    const FieldBaking& baking, std::vector<Warning>& warnings);
// Error: a surface that neither a collider nor a group has; a pair given twice.
std::vector<SurfaceRule> readSurfacePairs(JsonReader& scene, const std::vector<Collider>& colliders,
                                          const std::vector<Group>& groups);
// `thickness`: the collider's, which the grid must reach beyond.
DistanceFieldCollider readDistanceField(JsonReader& reader, const std::vector<Model>& models,
                                        double thickness, const FieldBaking& baking,
                                        std::vector<Warning>& warnings);
std::vector<Group> readGroups(JsonReader& scene, const std::vector<Model>& models,
                              std::vector<Warning>& warnings);

// "colorBy" of a group. Error, located: a span the wrong way round, colours out of [0, 1], too few or too
// many.
std::optional<ColorScale> readColorScale(JsonReader& group);
// "water" of the scene.
std::optional<Water> readWater(JsonReader& scene);

// "life" and "emitters" of a group whose molecule and count are read. Error, located: a rate below 0, a life
// without length, no capacity where nothing says it, and more.
void readLife(JsonReader& reader, Group& group, const std::vector<Model>& models);
// Error, located at the emitter: from the deaths of no group, of one where none dies, or in a circle.
void checkDeaths(const std::vector<Group>& groups);
// "school" of a group. Error, located: a radius of 0, slowest above fastest, and more.
void readSchool(JsonReader& reader, Group& group);
Selection readSelection(JsonReader& reader, const Model& model);
std::optional<ColliderPath> readPath(JsonReader& reader);  // "path"

// A group's "particle". Error: keys that have no effect, keyframes out of order, tiles that the image does
// not have, an image that is missing, not a PNG, or that its tiles do not fill.
ParticleType readParticleType(JsonReader& reader);
// What of a type changes with age, and so never shows in a group that lives for ever.
std::vector<Warning> agelessWarnings(const ParticleType& type, const Location& where);

// A key that names a file: its path, relative to the folder of the file that names it.
// Error at the key: absent, empty, or no such file.
std::string needFile(JsonReader& reader, const std::string& key);

// A key that names a model: its index.
int needModel(JsonReader& reader, const std::string& key, const std::vector<Model>& models);

// "rotation" as a quaternion [x, y, z, w] (glTF's order) or as {"axis": [x, y, z], "angle": rad}.
bool getRotation(JsonReader& reader, const std::string& key, glm::dquat& out);

// A vector of any length above 0; `out` becomes its direction.
bool getDirection(JsonReader& reader, const std::string& key, glm::dvec3& out);

// {"low": [x, y, z], "high": [x, y, z]}, low below high (or equal where `flat`).
bool getBox(JsonReader& reader, const std::string& key, Box& out, bool flat = false);

// "surface": a name that is not empty.
bool getSurface(JsonReader& reader, std::string& out);

// A number, or [least, most].
bool getSpan(JsonReader& reader, const std::string& key, glm::dvec2& out, Range range);

// A colour: three numbers, at least 0.
bool getColor(JsonReader& reader, const std::string& key, glm::dvec3& out);
bool getColor(JsonReader& reader, const std::string& key, std::optional<glm::dvec3>& out);

// An optional number that keeps apart "absent" and any value.
bool getOptional(JsonReader& reader, const std::string& key, std::optional<double>& out, Range range);

// Refuses a name that an earlier element already has. An element's own name may be empty.
void refuseRepeated(const JsonReader& reader, const std::vector<std::string>& earlier,
                    const std::string& name);

}  // namespace shoal
