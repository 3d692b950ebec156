#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "app/line/commands.h"
#include "compile/generate.h"
#include "core/data_paths.h"
#include "core/error.h"
#include "core/json_build.h"
#include "core/printable.h"
#include "molecule/analysis.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "reference/colliders.h"
#include "scene/json/scene_file.h"
#include "scene/known_colliders.h"

namespace shoal::app {

namespace {

// ---- How a scene starts: it is valid, but probably not what was meant

constexpr size_t mostLookedAt = 2000;  // molecules of a group, vertices of a model
// m: what contact leaves, and rounding, is no mistake. Deeper than this a molecule is pushed out before one's
// eyes.
constexpr double deepEnough = 1e-3;

// The share of a group from which to warn. Some of the molecules that are scattered over a surface or a
// volume always start inside a collider, and come out unseen.
constexpr double fewInside = 0.05;

glm::dvec3 positionOf(const GroupPlan& group, size_t molecule, size_t vertex) {
    const GroupState& state = group.start;
    return glm::dvec3(state.anchors[molecule]) +
           glm::dvec3(state.positions[molecule * size_t(group.vertexCount) + vertex]);
}

// Calls look(molecule) for evenly chosen molecules that are there at the start.
template <typename Look>
void forSome(const GroupPlan& group, const Look& look) {
    const size_t count = group.start.anchors.size(), step = std::max<size_t>(1, count / mostLookedAt);
    for (size_t m = 0; m < count; m += step)
        if (group.start.lives.empty() || group.start.lives[m].y > 0) look(m);
}

void findInside(const Scene& scene, const GroupPlan& group, std::vector<Warning>& out) {
    const reference::RestSurfaces surfaces(scene.colliders);
    for (size_t c = 0; c < surfaces.count(); ++c) {
        size_t inside = 0, looked = 0;
        forSome(group, [&](size_t m) {
            bool whole = true;  // what only dips in will lie on it
            for (size_t v = 0; v < size_t(group.vertexCount) && whole; ++v)
                whole = surfaces.surfaceOf(c, positionOf(group, m, v)).distance < -deepEnough;
            ++looked;
            inside += whole;
        });
        if (inside == 0 || double(inside) < fewInside * double(looked)) continue;
        const std::string& name = scene.colliders[c].name;
        out.push_back(
            {group.location,
             concat(looked < group.start.anchors.size() ? concat(inside, " of the ", looked, " looked at")
                                                        : concat(inside, " of ", looked),
                    " molecules of \"", group.name, "\" start inside the ",
                    kindName(*scene.colliders[c].shape), name.empty() ? "" : concat(" \"", name, "\""),
                    ", which pushes them out: move one or the other")});
    }
}

// Whether the camera has x in its picture, 16 wide and 9 high.
class Sight {
  public:
    explicit Sight(const Camera& camera) : eye_(camera.eye) {
        forward_ = glm::normalize(camera.target - camera.eye);
        const glm::dvec3 up = std::abs(forward_.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        right_ = glm::normalize(glm::cross(forward_, up));
        high_ = std::tan(camera.fieldOfView / 2);
    }
    bool has(const glm::dvec3& x) const {
        const glm::dvec3 d = x - eye_;
        const double depth = glm::dot(d, forward_);
        return depth > 0 && std::abs(glm::dot(d, glm::cross(right_, forward_))) <= high_ * depth &&
               std::abs(glm::dot(d, right_)) <= high_ * depth * 16 / 9;
    }

  private:
    glm::dvec3 eye_, forward_, right_;
    double high_ = 0;
};

bool seesAnything(const Scene& scene, const Plan& plan) {
    const Sight sight(scene.camera);
    bool seen = false;
    for (const GroupPlan& group : plan.groups) {
        forSome(group, [&](size_t m) { seen = seen || sight.has(positionOf(group, m, 0)); });
        if (!group.life) continue;
        const std::vector<Emitter>& emitters = group.life->cycle.emitters;
        for (size_t i = 0; i < emitters.size() && i < group.life->middles.size(); ++i)  // deaths are anywhere
            seen = seen || emitters[i].from == Emitter::From::death || sight.has(group.life->middles[i]);
    }
    for (const Model& model : scene.models) {
        const auto& points = model.mesh.positions;
        for (size_t i = 0; i < points.size() && model.draw && !seen; i += points.size() / mostLookedAt + 1)
            seen = sight.has(glm::dvec3(points[i]));
    }
    return seen;
}

// Whether something of a group dies in the end.
bool dies(const Group& group) {
    return group.life && (group.life->life.y < longestLife || group.life->within || group.life->afterContact);
}

void findIdleEmitters(const Scene& scene, std::vector<Warning>& out) {
    for (const Group& group : scene.groups) {
        if (!group.life) continue;
        for (const Emitter& emitter : group.life->emitters) {
            const auto tell = [&](const std::string& why) {
                out.push_back({emitter.location, "the emitter never emits: " + why});
            };
            if (emitter.from == Emitter::From::death) {
                const auto source = std::find_if(scene.groups.begin(), scene.groups.end(),
                                                 [&](const Group& g) { return g.name == emitter.group; });
                if (source != scene.groups.end() && !dies(*source))
                    tell(concat("nothing of \"", emitter.group, "\" dies"));
            } else if (emitter.bursts.empty() && !(emitter.rate > 0)) {
                tell("its \"rate\" is 0, and it has no \"bursts\"");
            }
        }
    }
}

void findColliderOutOfReach(const Scene& scene, std::vector<Warning>& out) {
    const bool touches =
        std::any_of(scene.groups.begin(), scene.groups.end(), [](const Group& g) { return g.collide; });
    for (const Collider& collider : scene.colliders) {
        const auto tell = [&](const std::string& why) {
            const std::string name = collider.name.empty() ? "" : concat(" \"", collider.name, "\"");
            out.push_back({Location{scene.file, 0, 0, {}},
                           concat("nothing can reach the ", kindName(*collider.shape), name, ": ", why)});
        };
        // A collider that is drawn may be there to be seen.
        if (!touches && !scene.groups.empty() && !collider.draw) tell("\"collide\" of all groups is false");
        if (collider.path) continue;
        for (const Collider& other : scene.colliders) {
            const auto* plane = kindOf<PlaneCollider>(*other.shape);
            if (!plane || other.path || !touches) continue;
            const glm::dvec3 normal = glm::normalize(plane->normal);
            const std::optional<double> highest = supportOf(*collider.shape, normal);
            if (highest && *highest < glm::dot(normal, plane->point))
                tell(concat("it lies wholly behind \"", other.name, "\""));
        }
    }
}

// Warns of more skin triangles than a picture can show: they cost most of the time and nobody sees them.
void findTooManyTriangles(const Scene& scene, std::vector<Warning>& out) {
    constexpr double pixels = 1280.0 * 720, most = 2 * pixels;
    for (const Group& group : scene.groups) {
        const double each = double(group.molecule.skin.triangles.size());
        const double count = group.life ? group.life->capacity : double(group.count);
        if (each * count <= most) continue;
        out.push_back({group.location,
                       concat("the skins of \"", group.name, "\" have ", std::round(each * count / 1e5) / 10,
                              " million triangles, and a picture of 1280 x 720 has 0.9 million pixels: "
                              "\"molecule from-mesh --skin-triangles\" makes a skin of fewer")});
    }
}

// Warns where 5 % of a group or more start wholly inside a collider or below the ground, and of a camera that
// sees neither a molecule nor a model nor an emitter, of emitters that never emit, of colliders that nothing
// can reach, of more triangles than can be seen, and of darkness. Of large groups and models only some
// thousand vertices are looked at.
std::vector<Warning> checkStart(const Scene& scene, const Plan& plan) {
    std::vector<Warning> out;
    for (const GroupPlan& group : plan.groups)
        if (group.needs.collide) findInside(scene, group, out);
    if (!seesAnything(scene, plan))
        out.push_back(
            {{scene.file, 0, 0, "$.camera"},
             "the camera sees no molecule, emitter or model at the start: turn its \"target\" towards them"});
    findIdleEmitters(scene, out);
    findColliderOutOfReach(scene, out);
    findTooManyTriangles(scene, out);
    if (scene.light.intensity <= 0 && scene.sky.intensity <= 0)
        out.push_back({{scene.file, 0, 0, "$.light"},
                       "nothing lights the scene: the \"intensity\" of \"light\" and of \"sky\" is 0"});
    return out;
}

// ---- Files

struct Verdict {
    std::string kind;  // "molecule" or "scene"
    std::vector<Warning> warnings;
    JsonValue facts = JsonValue::makeObject();
    std::string summary;
};

// The format key decides; where it says neither, the reader of the likely kind refuses it.
bool isScene(const std::string& file) {
    const JsonValue json = readJson(file);
    const JsonValue* format = json.find("format");
    if (format && format->text.rfind("shoal-scene-", 0) == 0) return true;
    if (format && format->text.rfind("shoal-molecule-", 0) == 0) return false;
    return json.find("groups") != nullptr;
}

// A texture is read by the renderer only: here it is looked for, so that `check` finds it missing.
void checkTexture(const Molecule& molecule) {
    if (!molecule.material.texture.empty()) readTexture(molecule);
}

Verdict checkMolecule(const std::string& file) {
    const Molecule molecule = readMolecule(file);
    checkTexture(molecule);
    const Analysis free = analyse(molecule, false);
    Verdict out;
    out.kind = "molecule";
    out.warnings = check(molecule);
    append(out.facts, key("name", molecule.name), key("vertices", molecule.vertices.size()),
           key("springs", molecule.springs.size()), key("triangles", molecule.triangles.size()),
           key("totalMass", free.totalMass), key("restEnergy", free.restEnergy),
           key("zeroModes", free.zeroModes), key("lowestFrequency", hertz(free.lowestFrequency)),
           key("highestFrequency", hertz(free.highestFrequency)));
    out.summary = concat("molecule \"", printable(molecule.name), "\": ", molecule.vertices.size(),
                         molecule.vertices.size() == 1 ? " vertex, " : " vertices, ",
                         many(int64_t(molecule.springs.size()), "spring", "springs"), ", ",
                         many(int64_t(molecule.triangles.size()), "triangle", "triangles"), ", mass ",
                         free.totalMass, " kg, rest energy ", free.restEnergy, " J");
    if (!molecule.skin.empty()) {
        out.summary += concat("\n  skin: ", molecule.skin.vertices.size(), " vertices, ",
                              many(int64_t(molecule.skin.triangles.size()), "triangle", "triangles"));
        append(out.facts, key("skinVertices", molecule.skin.vertices.size()),
               key("skinTriangles", molecule.skin.triangles.size()));
    }
    if (molecule.springs.empty()) return out;
    out.summary += concat(
        "\n  frequencies ", hertz(free.lowestFrequency), " to ", hertz(free.highestFrequency), " Hz, ",
        many(free.zeroModes, "zero-stiffness mode", "zero-stiffness modes"), "\n  stable steps: euler ",
        free.stableStepEuler, " s, leapfrog ", free.stableStepLeapfrog, " s");
    append(out.facts, key("stableStepEuler", free.stableStepEuler),
           key("stableStepLeapfrog", free.stableStepLeapfrog));
    return out;
}

// Whether the molecule ships. A scene's check leaves out its warnings: the scene cannot mend them, and the
// molecule's own comment explains them.
bool isShipped(const Molecule& molecule) {
    std::error_code ignored;
    return !molecule.file.empty() &&
           std::filesystem::equivalent(std::filesystem::path(molecule.file).parent_path(), moleculeFolder(),
                                       ignored);
}

}  // namespace

std::vector<Warning> warningsOfStart(const Scene& scene, const Plan& plan) {
    std::vector<Warning> out = checkStart(scene, plan);
    for (const Group& group : scene.groups) {
        if (isShipped(group.molecule)) continue;
        for (const Warning& warning : check(group.molecule))
            out.push_back(warning);
    }
    return out;
}

namespace {

std::string asText(const glm::dvec3& place) {
    return concat("(", place.x, ", ", place.y, ", ", place.z, ")");
}

Verdict checkScene(const std::string& file, bool lenient) {
    const Scene scene =
        readScene(file, {.lenient = lenient, .beforeBaking = [](const Scene& read) { checkPlan(read); }});
    const Plan plan = compile(scene);
    for (const Group& group : scene.groups)
        checkTexture(group.molecule);
    Verdict out;
    out.kind = "scene";
    out.warnings = plan.warnings;
    for (const Warning& warning : warningsOfStart(scene, plan))
        out.warnings.push_back(warning);
    int molecules = 0;
    for (const GroupPlan& group : plan.groups)
        molecules += group.count;
    append(out.facts, key("name", scene.name), key("groups", plan.groups.size()),
           key("molecules", molecules));
    JsonValue gaps = object();
    std::string gapText;
    for (const ContactGroup& contact : plan.contact.groups) {
        const GroupPlan& group = plan.groups[contact.group];
        const Group& source = scene.groups[group.index];
        const Gap gap = largestGap(source.molecule, *source.contact);
        gaps.add(group.name, toJson(gap.radius));
        gapText +=
            concat("\n  contact of \"", printable(group.name), "\": spheres of ", contact.radius, " m, ");
        gapText +=
            gap.triangle < 0 ? "no gap" : concat("largest gap ", gap.radius, " m in triangle ", gap.triangle);
    }
    if (plan.contact.any()) append(out.facts, key("contactGaps", gaps));
    JsonValue boxes = object();
    std::string boxText;
    for (const Model& model : scene.models) {
        boxes.add(model.name, object(key("low", model.mesh.low), key("high", model.mesh.high)));
        boxText += concat("\n  model \"", printable(model.name), "\": from ", asText(model.mesh.low), " to ",
                          asText(model.mesh.high), " m");
    }
    if (!scene.models.empty()) append(out.facts, key("modelBoxes", boxes));
    out.summary = concat(
        "scene \"", printable(scene.name), "\": ", many(int64_t(plan.groups.size()), "group", "groups"), ", ",
        many(molecules, "molecule", "molecules"), ", ", many(int64_t(scene.fields.size()), "field", "fields"),
        ", ", many(int64_t(scene.colliders.size()), "collider", "colliders"), boxText, gapText);
    return out;
}

}  // namespace

int checkCommand(const Options& options) {
    JsonValue report = JsonValue::makeArray();
    bool failed = false;
    for (const std::string& file : options.files) {
        JsonValue entry = object(key("file", file));
        try {
            keepToSandbox(options, file);
            Verdict verdict = isScene(file) ? checkScene(file, options.lenient) : checkMolecule(file);
            std::vector<std::string> warnings;
            for (const Warning& warning : verdict.warnings)
                warnings.push_back(text(warning));
            append(entry, key("ok", true), key("kind", verdict.kind), key("warnings", warnings),
                   key(verdict.kind.c_str(), verdict.facts));
            if (!options.json) {
                std::cout << printable(file) << ": " << verdict.summary << "\n";
                for (const std::string& warning : warnings)
                    std::cout << "  warning: " << warning << "\n";
            }
        } catch (const Error& error) {
            failed = true;
            append(entry, key("ok", false), key("error", error.what()));
            if (!options.json) std::cerr << "shoal: " << error.what() << "\n";
        }
        report.items.push_back(std::move(entry));
    }
    if (options.json) std::cout << writeJson(report);
    return failed ? 1 : 0;
}

}  // namespace shoal::app
