#include "scene/json/scene_file.h"

#include <filesystem>
#include <fstream>
#include <set>

#include "core/data_paths.h"
#include "core/describe.h"
#include "core/file.h"
#include "core/json.h"
#include "core/json_edit.h"
#include "core/where.h"
#include "molecule/gap.h"
#include "scene/field_files/field_file.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

template <typename T>
void checkNames(const char* key, const std::vector<T>& list, const Where& whole) {
    for (size_t i = 0; i < list.size(); ++i)
        refuseRepeated(whole.in(key, i), list, i);
}

void checkForceGroups(const Scene& scene, const Where& whole) {
    std::vector<std::string> known = namesOf(scene.groups);
    std::erase(known, "");
    for (size_t i = 0; i < scene.forces.size(); ++i) {
        const Where where = whole.in("forces", i);
        if (where.given("groups") && scene.forces[i].groups.empty())
            throw Error(where.locate("groups"), "expected the name of at least one group; all without it");
        for (const std::string& name : scene.forces[i].groups)
            needNamed(name, known, where.locate("groups"), "no group is named", " (none has a \"name\")");
    }
}

void checkParts(const Scene& scene, const Where& where) {
    checkNames("fields", scene.fields, where);
    checkNames("models", scene.models, where);
    checkNames("colliders", scene.colliders, where);
    checkNames("forces", scene.forces, where);
    checkGroups(scene, where);
    checkForceGroups(scene, where);
    checkSurfaces(scene, where);
}

}  // namespace

const Description& describe(const Scene*) {
    static const Description description =
        Describe<Scene>("scene", "A scene: everything that a run needs. What is left out is not simulated.")
            .format("shoal-scene-1")
            .key("name", &Scene::name, {"", "Its name."})
            .key("models", &Scene::models,
                 {"", "Meshes that stand still: they are drawn, carry molecules, and make colliders."})
            .key("groups", &Scene::groups, {"", "The molecules, at least one group."})
            .needed()
            .key("fields", &Scene::fields, {"", "The velocity of the fluid."})
            .key("forces", &Scene::forces,
                 {"", "What accelerates molecules beside gravity, fields and springs."})
            .key("colliders", &Scene::colliders, {"", "What molecules collide with."})
            .key("gravity", &Scene::gravity, {"m/s²", "The gravity; there is none unless given."})
            .key("water", &Scene::water, {"", "Water; all is in the air without it."})
            .key("camera", &Scene::camera, {"", "From where it is seen."})
            .key("light", &Scene::light, {"", "The sun."})
            .key("sky", &Scene::sky, {"", "The sky."})
            .key("contact", &Scene::contact, {"", "Contact of molecules with one another."})
            .key("surfacePairs", &Scene::surfacePairs, {"", "Restitution and friction of pairs of surfaces."})
            .key("solver", &Scene::solver, {"", "How molecules are advanced."})
            .key("frameRate", &Scene::frameRate,
                 {"Hz", "A frame simulates 1 / frameRate seconds.", Range::between(1, 1e5)})
            .key("seed", &Scene::seed, {"", "The seed of places, colours, phases and release."})
            .rule(checkParts, R"({"properties": {"groups": {"minItems": 1}}})");
    return description;
}

Scene parseScene(const std::string& text, const std::string& file, const SceneOptions& options) {
    const JsonValue root = parseJson(text, file);
    refuseHugeNumbers(root, file);

    Scene scene;
    scene.file = file;
    SceneReading reading{scene.models, scene.warnings, options.lenient};
    describe(&scene).readFile(root, file, scene, &reading);
    if (const JsonValue* comment = root.find("comment")) scene.comment = comment->text;
    for (Group& group : scene.groups)
        if (group.contact && group.contact->radius == 0)
            group.contact->radius = closingRadius(group.molecule, group.contact->triangles);
    JsonReader whole(root, file);
    for (size_t g = 0; g < scene.groups.size(); ++g)
        for (Warning& warning : warningsOf(scene.groups[g], Where(whole).in("groups", g)))
            scene.warnings.push_back(std::move(warning));
    if (options.beforeBaking) options.beforeBaking(scene);
    bakeFields(scene, options.baking, Where(whole));
    return scene;
}

static void rereadLiveKeys(JsonReader& reader, SceneReading& reading, Group& group) {
    Group fresh;
    fresh.count = group.count;
    describe(&fresh).readSome(liveKeys, reader, fresh, &reading);
    deriveLife(fresh, reader);
    group.particle = std::move(fresh.particle);
    group.color = fresh.color;
    group.secondColor = fresh.secondColor;
    group.variation = fresh.variation;
    group.school = std::move(fresh.school);
    group.life = std::move(fresh.life);
    if (group.particle) group.molecule = moleculeOf(*group.particle);
}

void rereadLiveKeys(const JsonValue& root, Scene& scene) {
    refuseHugeNumbers(root, scene.file);
    std::vector<Warning> warnings;
    SceneReading reading{scene.models, warnings};
    const JsonValue& groups = *root.find("groups");
    EXPECTS(groups.items.size() == scene.groups.size());
    for (size_t g = 0; g < scene.groups.size(); ++g) {
        JsonReader reader(groups.items[g], scene.file, concat("$.groups[", g, "]"));
        rereadLiveKeys(reader, reading, scene.groups[g]);
    }
    const JsonReader whole(root, scene.file);
    describe(&scene).check(scene, Where(whole), largestNumber);
}

std::optional<std::vector<Collider>> rereadColliders(const JsonValue& list, const JsonValue& before,
                                                     const Scene& scene) {
    EXPECTS(before.items.size() == scene.colliders.size());
    if (list.items.size() != before.items.size()) return {};
    std::vector<Collider> out = scene.colliders;
    std::vector<Warning> warnings;
    SceneReading reading{scene.models, warnings};
    for (size_t i = 0; i < out.size(); ++i) {
        if (sameJson(list.items[i], before.items[i])) continue;
        if (list.items[i].find("model") || list.items[i].find("image")) return {};
        JsonReader reader(list.items[i], scene.file, concat("$.colliders[", i, "]"));
        out[i] = {};
        describe(&out[i]).read(reader, out[i], &reading);
    }
    return out;
}

void checkScene(const Scene& scene) {
    describe(&scene).check(scene, Where(), largestNumber);
}

Scene readScene(const std::string& file, const SceneOptions& options) {
    return parseScene(readFile(file), file, options);
}

// ---- The files that a scene is made of

namespace {

namespace fs = std::filesystem;

class Collector {
  public:
    void add(const fs::path& file) {
        if (!files.insert(file.string()).second) return;
        const std::string kind = lowerExtension(file);
        if (kind == ".json") addNamed(file);
        if (kind == ".obj") addMaterials(file);
    }

    std::set<std::string> files;

  private:
    void addIfFile(const fs::path& base, const std::string& text) {
        constexpr size_t longestName = 1024;
        if (text.empty() || text.size() > longestName || text.find('\0') != std::string::npos) return;
        const fs::path path = (base.parent_path() / text).lexically_normal();
        std::error_code code;
        if (fs::is_regular_file(path, code)) add(path);
        for (const std::string& file : numberedFiles(path))
            add(file);
    }

    void addNamed(const fs::path& file) {
        try {
            addTexts(file, readJson(file.string()));
        } catch (const Error&) {
            // whoever reads it for what it says tells what is wrong
        }
    }

    void addTexts(const fs::path& file, const JsonValue& value) {
        if (value.kind == JsonValue::Kind::string) addIfFile(file, value.text);
        for (const JsonValue& item : value.items)
            addTexts(file, item);
        for (const auto& [key, member] : value.members) {
            addTexts(file, member);
            if (key == "molecule" && isShippedName(member.text))
                addIfFile(moleculeFolder() + "/", member.text + ".json");
        }
    }

    // They stand before the faces that use them, as a rule at the beginning.
    void addMaterials(const fs::path& file) {
        if (!mayOpen(file)) return;
        constexpr int most = 200;  // lines
        std::ifstream in(file);
        std::string line;
        for (int i = 0; i < most && std::getline(in, line); ++i) {
            if (line.rfind("mtllib ", 0) != 0) continue;
            if (line.back() == '\r') line.pop_back();
            addIfFile(file, line.substr(7));
        }
    }
};

}  // namespace

std::vector<std::string> filesOf(const std::string& sceneFile) {
    Collector collector;
    collector.add(fs::path(sceneFile).lexically_normal());
    return {collector.files.begin(), collector.files.end()};
}

}  // namespace shoal
