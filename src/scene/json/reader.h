// The parts of the scene reader. Used by scene_*.cpp only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/description.h"
#include "core/json_values.h"
#include "core/members.h"
#include "geometry/distance_field_cache.h"
#include "scene/keyframes.h"
#include "scene/scene.h"

namespace shoal {

// The GPU computes in single precision: squares of larger numbers would overflow there.
constexpr double largestNumber = 1e15;

// Refuses numbers beyond largestNumber anywhere in the file, seeds and counts apart.
void refuseHugeNumbers(const JsonValue& value, const std::string& file, const std::string& path = "$");

std::vector<Field> readFields(JsonReader& scene);
// Error: a force for a group that there is not.
std::vector<Force> readForces(JsonReader& scene, const std::vector<Group>& groups);
std::vector<Model> readModels(JsonReader& scene);
// What the readers of colliders need besides their object.
struct ColliderReading {
    const std::vector<Model>& models;
    const FieldBaking& baking;
    std::vector<Warning>& warnings;
    double thickness;  // m, of the collider that is read: a distance field must reach beyond it
};
std::vector<Collider> readColliders(JsonReader& scene, const std::vector<Model>& models,
                                    const FieldBaking& baking, std::vector<Warning>& warnings);
// Error: a surface that neither a collider nor a group has; a pair given twice.
std::vector<SurfaceRule> readSurfacePairs(JsonReader& scene, const std::vector<Collider>& colliders,
                                          const std::vector<Group>& groups);
std::vector<Group> readGroups(JsonReader& scene, const std::vector<Model>& models,
                              std::vector<Warning>& warnings);

// "colorBy" of a group. Error, located: a span the wrong way round, colours out of [0, 1], too few or too
// many.
std::optional<ColorScale> readColorScale(JsonReader& group);

// "life" and "emitters" of a group whose molecule and count are read. Error, located: a rate below 0, a life
// without length, no capacity where nothing says it, and more.
void readLife(JsonReader& reader, Group& group, const std::vector<Model>& models);
// Error, located at the emitter: from the deaths of no group, of one where none dies, or in a circle.
void checkDeaths(const std::vector<Group>& groups);
Selection readSelection(JsonReader& reader, const Model& model);

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

bool getColor(JsonReader& reader, const std::string& key, std::optional<glm::dvec3>& out);

// An optional number that keeps apart "absent" and any value.
bool getOptional(JsonReader& reader, const std::string& key, std::optional<double>& out, Range range);

// Refuses a name that an earlier element already has. An element's own name may be empty.
void refuseRepeated(const Where& where, const std::vector<std::string>& earlier, const std::string& name);
// Does so, and adds it to them.
void takeName(const Where& where, std::vector<std::string>& taken, const std::string& name);

// Error: no such model.
void checkModel(int model, const std::vector<Model>& models, const Location& where);

// The visitors of core/members.h with what scenes have besides numbers.
class ReadScene : public ReadMembers {
  public:
    using ReadMembers::ReadMembers;
    void span(const std::string& key, glm::dvec2& out, Range range) { getSpan(reader(), key, out, range); }
    void direction(const std::string& key, glm::dvec3& out) { getDirection(reader(), key, out); }
    template <typename Color>
    void color(const std::string& key, Color& out) {
        getColor(reader(), key, out);
    }
    void box(const std::string& key, Box& out, bool flat = false) { getBox(reader(), key, out, flat); }
    void box(const std::string& key, std::optional<Box>& out) {
        if (Box box; getBox(reader(), key, box)) out = box;
    }
    void rotation(const std::string& key, glm::dquat& out) { getRotation(reader(), key, out); }
};

class CheckScene : public CheckMembers {
  public:
    explicit CheckScene(const Where& where) : CheckMembers(where, largestNumber) {}
    void span(const std::string& key, const glm::dvec2& value, Range range) const;
    void direction(const std::string& key, const glm::dvec3& value) const;
    template <typename Color>
    void color(const std::string& key, const Color& value) const {
        number(key, value, Range::atLeast(0));
    }
    void box(const std::string& key, const Box& value, bool flat = false) const;
    void box(const std::string& key, const std::optional<Box>& value) const {
        if (value) box(key, *value);
    }
    void rotation(const std::string& key, const glm::dquat& value) const;
};

// A struct from its object, whose keys `needed` must be there.
template <typename Struct>
Struct readMembers(JsonReader& reader, std::initializer_list<const char*> needed = {}) {
    for (const char* key : needed)
        reader.require(key);
    Struct out;
    members(ReadScene(reader), out);
    return out;
}

// The rules of the parts of a scene that was made in code (checkScene of scene/json/scene_file.h).
void checkFields(const std::vector<Field>& fields);
void checkForces(const std::vector<Force>& forces, const std::vector<Group>& groups);
void checkColliders(const Scene& scene);
void checkModels(const std::vector<Model>& models);
void checkGroups(const std::vector<Group>& groups, const std::vector<Model>& models);
void checkLife(const Group& group, const std::vector<Model>& models, const Where& where);
void checkParticle(const ParticleType& type, const Where& where);
void checkColorScale(const ColorScale& scale, const Where& where);

}  // namespace shoal
