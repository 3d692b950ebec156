// Scene files: strict JSON, format "shoal-scene-1", described by
// models/scene.schema.json. Keys are named like the members of the structs in scene.h; anything left out
// keeps the struct's default. File names inside are relative to the scene file's folder.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "core/cache_folder.h"
#include "core/json.h"
#include "geometry/distance_field.h"
#include "scene/scene.h"

namespace shoal {

struct SceneOptions {
    FieldBaking baking{cacheFolder(), {}};
    bool lenient = false;  // what is lost of a model is a warning instead (geometry/mesh.h)
    // Is called when all but the distance fields is read, and may change the scene: what it refuses, nobody
    // has waited for.
    std::function<void(Scene&)> beforeBaking{};
};

// Reads a scene with its molecules, models and fields. Every mistake is one Error with file, line, column
// and JSON path; a mistake inside a file that the scene names is reported at that file.
// Distance fields are baked here, or taken from where they are kept.
Scene readScene(const std::string& file, const SceneOptions& options = {});
Scene parseScene(const std::string& text, const std::string& file, const SceneOptions& options = {});

// The keys of a group that a run may take while it goes on.
inline constexpr std::initializer_list<const char*> liveKeys = {
    "particle", "color", "secondColor", "variation", "school", "life", "emitters"};
// Reads these keys of all groups anew from what a scene file says, which differs in them alone from what
// the scene was read from. No model, molecule or field is read. Error: the reader's.
void rereadLiveKeys(const JsonValue& root, Scene& scene);

// The colliders that an array of a scene's file says, of which those that differ from `before` are read anew;
// nothing where one is made of a model or an image. Error: the reader's.
std::optional<std::vector<Collider>> rereadColliders(const JsonValue& list, const JsonValue& before,
                                                     const Scene& scene);

// The rules of the reader for a scene that was made, or changed, in code. Error: the reader's, with the path
// of what is wrong and no file. What only files say (which keys go together) is not asked.
void checkScene(const Scene& scene);

// The scene file and whatever it names, directly or through another JSON file (molecules, their images, skins
// and so on): every text in them that is the name of a file which is there, relative to the file that names
// it, or that stands for numbered ones (wind-##.vti); and the materials that .obj models name. Files that
// cannot be read name nothing. Sorted, each once.
std::vector<std::string> filesOf(const std::string& sceneFile);

}  // namespace shoal
