// An edit that a run takes as it goes on gives what the same scene gives that is begun anew at that moment:
// for every key of lives, schools, particles and colours, from the descriptions.
#include <algorithm>
#include <set>

#include "core/json_build.h"
#include "core/smallest.h"
#include "gl/numerics.h"
#include "scene/json/scene_file.h"
#include "simulate/carry_over.h"
#include "support/catch.h"
#include "support/scratch.h"
#include "support/small_scene.h"
#include "window/running_scene.h"

using namespace shoal;
using namespace shoal::test;
using window::RunningScene;

namespace {

constexpr const char* edited = R"({
  "format": "shoal-scene-1",
  "seed": 3,
  "gravity": [0, -1, 0],
  "solver": {"method": "leapfrog", "substeps": 2},
  "groups": [
    {"name": "fish", "molecule": "blade.json", "held": false, "count": 24,
     "place": {"on": "volume", "box": {"low": [-0.5, -0.5, -0.5], "high": [0.5, 0.5, 0.5]}},
     "color": [0.8, 0.2, 0.1], "secondColor": [0.9, 0.6, 0.1], "variation": 0.3,
     "school": {"radius": 0.6, "home": {"center": [0, 0, 0], "radius": 1}, "depth": [-1, 1],
                "hunts": [{"group": "sparks"}]}},
    {"name": "born", "molecule": "blade.json", "held": false,
     "life": {"span": [0.5, 1], "capacity": 60, "scale": [0.5, 1], "turn": "yaw", "spin": [1, 0, 1],
              "grow": 0.1, "shrink": 0.2, "dies": {"outside": {"low": [-3, -3, -3], "high": [3, 3, 3]}}},
     "emitters": [
       {"from": "disc", "position": [0, 1, 0], "radius": 0.3, "hollow": 0.5, "rate": 40, "random": true,
        "begin": 0.01, "until": 5, "direction": [1, 1, 0], "spread": 0.5, "speed": [1, 2]},
       {"from": "box", "box": {"low": [0, 0, 0], "high": [1, 0, 1]}, "rate": 20,
        "bursts": [{"time": 0.02, "count": 3, "every": 0.1}]},
       {"from": "line", "start": [0, 0, 0], "end": [1, 0, 0], "rate": 30}]},
    {"name": "sparks", "particle": {"size": [0.05, 0.1], "shape": "quads", "facing": "velocity", "blend": "alpha",
     "growth": [0.5, 1], "stretch": 0.02, "colors": [{"color": [3, 2, 1]}, {"age": 1, "opacity": 0.2}]},
     "life": {"span": 0.4, "capacity": 60}, "emitters": [{"from": "point", "rate": 60, "speed": 1, "spread": 1}]}
  ],
  "camera": {"eye": [0, 0, 5], "target": [0, 0, 0]},
  "light": {"shadows": false}
}
)";

// Other values of the same form. Rules between keys may refuse some.
std::vector<JsonValue> othersOf(const Key& key, const JsonValue& value) {
    const auto moved = [&](double number, double factor) {
        const Range range = key.says.range;
        return std::clamp(number == 0 ? factor - 1 : number * factor, range.least, range.most);
    };
    std::vector<JsonValue> out;
    if (value.kind == JsonValue::Kind::boolean) out.push_back(toJson(!value.boolean));
    if (value.kind == JsonValue::Kind::string)
        for (const std::string& word : key.words)
            if (word != value.text) out.push_back(toJson(word));
    for (const double factor : {1.25, 0.8}) {
        if (value.kind == JsonValue::Kind::number)
            out.push_back(toJson(value.number == std::round(value.number) && value.number >= 3
                                     ? std::round(moved(value.number, factor))
                                     : moved(value.number, factor)));
        if (value.items.empty() || value.items[0].kind != JsonValue::Kind::number) continue;
        JsonValue list = JsonValue::makeArray();
        for (const JsonValue& item : value.items)
            list.items.push_back(toJson(moved(item.number, factor)));
        out.push_back(list);
    }
    return out;
}

struct Edit {
    std::string path;
    JsonValue root;
};

// Every edit of a value below an object, which is a part of `root`.
void addEdits(const Description& keys, JsonValue& object, const std::string& path, const JsonValue& root,
              std::vector<Edit>& edits) {
    const auto text = [](const Key& key) { return key.name; };
    for (const Key& key : keys.keys()) {
        if (!meansSomething(keys, key, object)) continue;
        const std::string own = path + "." + key.name;
        const bool given = object.find(key.name);
        if (given && key.objects.size() == 1) {
            JsonValue& value = memberOf(object, key.name);
            if (value.kind == JsonValue::Kind::object) addEdits(*key.objects[0], value, own, root, edits);
            for (size_t i = 0; i < value.items.size(); ++i)
                addEdits(*key.objects[0], value.items[i], concat(own, "[", i, "]"), root, edits);
            continue;
        }
        const JsonValue before = object;
        JsonValue value = given ? *object.find(key.name) : keys.usualValue(key);
        if (value.kind == JsonValue::Kind::null && key.objects.empty()) value = key.kind->least(key, text);
        for (const JsonValue& other : othersOf(key, value)) {
            setMember(object, key.name, other);
            edits.push_back({concat(own, " = ", writeJsonLine(other)), root});
            object = before;
        }
    }
}

std::vector<Edit> allEdits(JsonValue root) {
    std::vector<Edit> out;
    const Description& keys = describe(static_cast<const Group*>(nullptr));
    for (JsonValue& group : memberOf(root, "groups").items) {
        std::vector<Edit> inside;
        const std::string name = group.find("name")->text;  // not of the object that is edited
        addEdits(keys, group, name, root, inside);
        for (Edit& edit : inside)
            for (const char* key : liveKeys)
                if (edit.path.starts_with(concat(name, ".", key))) {
                    out.push_back(std::move(edit));
                    break;
                }
    }
    return out;
}

struct Result {
    uint64_t hash;
    std::vector<uint8_t> pixels;
    bool operator==(const Result&) const = default;
};

Result goOnWith(Simulation& simulation, Renderer& renderer, const Scene& scene) {
    run(simulation, 4);
    renderer.draw(simulation.state(), View::fromCamera(scene.camera, simulation.time()));
    return {simulation.hash(), renderer.capture().pixels};
}

Result begunAnew(const Scene& scene, const SavedState& state, const Plan& from) {
    Simulation simulation(testContext(), compile(scene), {.path = testPath()});
    simulation.load(goOn(state, from, simulation.plan()).state);
    Renderer renderer(testContext(), scene, simulation.plan(), {.width = 96, .height = 72});
    return goOnWith(simulation, renderer, scene);
}

}  // namespace

TEST_CASE("what is edited while a run goes on is as if begun anew at that moment", "[editedLive]") {
    if (testPath() == Path::pingPong) return;  // has neither lives nor schools
    const Scratch scratch;
    const std::string file = writeSmallScene(scratch, edited);
    RunRequest request;
    request.path = testPath();
    RunningScene running(request, testContext(), loadScene(file, request), 96, 72);
    run(running.simulation(), 8);
    const SavedState state = running.simulation().save();
    const Plan plan = running.simulation().plan();
    const Result plain = goOnWith(running.simulation(), running.renderer(), running.scene());
    CHECK(plain == begunAnew(running.scene(), state, plan));
    std::set<std::string> live;
    int seen = 0;
    for (const Edit& edit : allEdits(running.document().json())) {
        INFO(edit.path);
        running.simulation().load(state);
        bool taken = false;
        try {
            taken = running.changeLive(edit.root);
        } catch (const Error&) {
            continue;  // a rule between keys
        }
        running.release();
        if (!taken) continue;
        const Result result = goOnWith(running.simulation(), running.renderer(), running.scene());
        const Result anew = begunAnew(running.scene(), state, plan);
        CHECK(result.hash == anew.hash);
        CHECK(result.pixels == anew.pixels);
        seen += !(result == plain);
        live.insert(edit.path.substr(0, edit.path.find(' ')));
        if (running.document().before()) running.undo();
        running.simulation().load(state);
        CHECK(goOnWith(running.simulation(), running.renderer(), running.scene()) == plain);
    }
    INFO(joined(std::vector<std::string>(live.begin(), live.end()), " "));
    CHECK(live.size() > 60);
    CHECK(seen > 60);
    CHECK(running.builds() == 1);
}
