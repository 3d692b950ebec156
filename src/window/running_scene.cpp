#include "window/running_scene.h"

#include <algorithm>
#include <filesystem>

#include "core/file.h"
#include "core/json_build.h"
#include "core/json_edit.h"
#include "gpu/program_cache.h"
#include "molecule/molecule_file.h"
#include "run/progress.h"
#include "scene/json/scene_file.h"
#include "simulate/carry_over.h"
#include "window/new_elements.h"

namespace shoal::window {

namespace {

// As they stand, so that sliders go on from there; what is new is as the plan has it.
Parameters carriedParameters(const Parameters& old, const Parameters& fresh) {
    Parameters out = old;
    out.frameTime = fresh.frameTime;
    out.forces = fresh.forces;
    if (old.forces.size() == fresh.forces.size())
        for (size_t i = 0; i < out.forces.size(); ++i)
            out.forces[i].factor = old.forces[i].factor;
    return out;
}

}  // namespace

RunningScene::RunningScene(const RunRequest& request, gpu::Context& context, Loaded loaded, int width,
                           int height)
    : request_(request),
      context_(&context),
      document_(loaded.scene, request),
      path_(request.path),
      width_(width),
      height_(height) {
    build(std::move(loaded.scene), loaded.plan, path_);
}

std::unique_ptr<Simulation> RunningScene::simulate(Plan plan, Path path) {
    SimulationOptions wanted;
    wanted.timing = gpu::PassTimers::suitedTo(context_->info());
    wanted.path = path;
    // what was asked of compute shaders does not bind the other paths
    if (path == Path::automatic || path == Path::fused)
        wanted.inPlace = request_.inPlace, wanted.lanes = request_.lanes;
    return std::make_unique<Simulation>(*context_, std::move(plan), wanted);
}

// Where the path is free, keeps the one that runs, unless it cannot run the new plan. A shader that the
// driver refuses is a mistake to report, no reason to take another path.
std::unique_ptr<Simulation> RunningScene::simulateAsBefore(const Plan& plan, Path path) {
    if (path != Path::automatic || !simulation_) return simulate(plan, path);
    try {
        return simulate(plan, simulation_->path().path);
    } catch (const Error& error) {
        if (context_->shaderFiles().count(error.location().file) > 0) throw;
        return simulate(plan, path);
    }
}

// Programs of a picture are made when it is drawn, so one picture tells whether they can be.
std::unique_ptr<Renderer> RunningScene::draws(const Scene& scene, Simulation& simulation) const {
    RenderOptions size;
    size.width = renderer_ ? renderer_->width() : width_;
    size.height = renderer_ ? renderer_->height() : height_;
    size.timing = simulation.timers().mode();
    auto out = std::make_unique<Renderer>(*context_, scene, simulation.plan(), size);
    if (renderer_) out->draw(simulation.state(), View::fromCamera(scene.camera, simulation.time()));
    return out;
}

// What runs stays until the new one is whole.
std::vector<std::string> RunningScene::build(Scene next, const Plan& plan, Path path) {
    std::unique_ptr<Simulation> simulation = simulateAsBefore(plan, path);
    tellWarnings(simulation->warnings());
    tellWarnings(context_->cache().takeWarnings());
    std::vector<std::string> restarted;
    if (simulation_) {
        GoneOn gone = goOn(simulation_->save(), simulation_->plan(), simulation->plan());
        simulation->load(gone.state);
        simulation->parameters = carriedParameters(simulation_->parameters, simulation->parameters);
        restarted = std::move(gone.restarted);
    }
    renderer_ = draws(next, *simulation);
    shown_ = {};
    simulation_ = std::move(simulation);
    scene_ = std::move(next);
    ++builds_;
    return restarted;
}

// A stiffer molecule takes more substeps instead of being refused.
Plan RunningScene::compileStably(Scene& next) const {
    for (int tries = 0; tries < 12; ++tries) {
        try {
            return compile(next);
        } catch (const Error&) {
            if (next.solver.substeps >= 256) throw;
            next.solver.substeps *= 2;
        }
    }
    return compile(next);
}

std::vector<std::string> RunningScene::build(Scene next) {
    const Plan plan = compileStably(next);
    tellWarnings(plan.warnings);
    return build(std::move(next), plan, path_);
}

void RunningScene::switchPath(Path path) {
    build(scene_, simulation_->plan(), path);
    path_ = path;
}

Scene RunningScene::read(const std::string& text) const {
    return parseScene(text, document_.file(), {.lenient = request_.lenient});
}

// ---- Edits

// Lets a capacity that a file leaves to its rates stay as it runs, so that a rate can be moved meanwhile:
// from now on the text says it.
void RunningScene::keepCapacities(const SceneDifference& difference, const std::vector<Group>& before,
                                  SceneDocument::Texts& next, bool trial) {
    JsonValue root = next.running.json;
    bool kept = false;
    for (const SceneDifference::Live& edit : difference.live) {
        const Group& old = before[edit.group];
        Group& group = scene_.groups[edit.group];
        JsonValue& says = memberOf(root, "groups").items[edit.group];
        const JsonValue* life = says.find("life");
        if (!old.life || !group.life || (life && life->find("capacity"))) continue;
        if (group.life->capacity == old.life->capacity) continue;
        group.life->capacity = old.life->capacity;
        setMember(memberOf(says, "life"), "capacity", toJson(old.life->capacity));
        kept = true;
    }
    if (kept) next = document_.changed(root, trial);
}

// Takes what differs in what runs, as it goes on; false: that cannot be, and nothing has changed.
bool RunningScene::takeLive(const SceneDifference& difference, SceneDocument::Texts& next,
                            std::optional<bool> trial) {
    if (difference.simulation || difference.picture) return false;
    const std::vector<Group> before = scene_.groups;
    try {
        rereadLiveKeys(next.running.json, scene_);
        SceneDocument::Texts kept = next;
        if (trial) keepCapacities(difference, before, kept, *trial);
        if (applyLive(difference.live, before, scene_.groups, *simulation_, *renderer_)) {
            next = std::move(kept);
            return true;
        }
    } catch (const Error&) {
        scene_.groups = before;
        throw;
    }
    scene_.groups = before;
    return false;
}

// Runs what the texts say. `trial`: they are an edit, or an edit for this run alone.
void RunningScene::follow(SceneDocument::Texts& next, std::optional<bool> trial) {
    const SceneDifference difference = differenceOf(document_.json(), next.running.json);
    if (takeLive(difference, next, trial)) return;
    Scene fresh = read(next.running.text);
    if (difference.simulation || !difference.live.empty()) {
        build(std::move(fresh));
        return;
    }
    fresh.solver.substeps = scene_.solver.substeps;
    renderer_ = draws(fresh, *simulation_);
    shown_ = {};
    scene_ = std::move(fresh);
    ++builds_;
}

void RunningScene::change(const JsonValue& after, bool trial) {
    SceneDocument::Texts next = document_.changed(after, trial);
    if (next != document_.texts()) {
        follow(next, trial);
        document_.take(std::move(next), held_);
    }
    held_ = false;
}

bool RunningScene::changeLive(const JsonValue& after) {
    SceneDocument::Texts next = document_.changed(after, false);
    if (next == document_.texts()) return true;
    const SceneDifference difference = differenceOf(document_.json(), next.running.json);
    if (!takeLive(difference, next, false)) return false;
    document_.take(std::move(next), std::exchange(held_, true));
    return true;
}

void RunningScene::showColliders(const JsonValue& after) {
    const JsonValue& before = document_.json();
    const JsonValue *list = after.find("colliders"), *own = before.find("colliders");
    if (!list || !own) return;
    const bool shows = shown_.kind != JsonValue::Kind::null;
    if (sameJson(*list, shows ? shown_ : *own)) return;
    try {
        const std::optional<std::vector<Collider>> moved = rereadColliders(*list, *own, scene_);
        if (!moved) return;
        renderer_->changeColliders(*moved);
        shown_ = *list;
    } catch (const Error&) {
        // which is told when the run is to take it
    }
}

void RunningScene::go(SceneDocument::Texts next) {
    follow(next, {});
    document_.take(std::move(next));
}

void RunningScene::undo() {
    SceneDocument::Texts next = *document_.before();
    follow(next, {});
    document_.goBack();
}

void RunningScene::redo() {
    SceneDocument::Texts next = *document_.after();
    follow(next, {});
    document_.goForth();
}

void RunningScene::save() {
    if (document_.tries()) read(document_.texts().kept.text);  // so that no file is left that nobody can open
    document_.save();
}

void RunningScene::add(const std::string& file) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::absolute(document_.file()).parent_path();
    const std::string name = fs::relative(file, folder).generic_string();
    const bool molecule = fs::path(file).extension() == ".json";
    JsonValue root = document_.json();
    const char* list = molecule ? "groups" : "models";
    const JsonValue* existing = root.find(list);
    JsonValue longer = existing ? *existing : JsonValue::makeArray();
    longer.items.push_back(molecule ? groupOf(longer, name, scene_) : object(key("file", name)));
    setMember(root, list, std::move(longer));
    change(root);
}

RunningScene::Reloaded RunningScene::reload(std::optional<Prefer> prefer) {
    const std::string onDisk = readFile(document_.file());
    Reloaded out;
    SceneDocument::Texts next = document_.merged(onDisk, prefer.value_or(Prefer::mine), out.conflicts);
    Scene fresh = read(next.running.text);
    if (!out.conflicts.empty() && !prefer) return out;
    out.restarted = build(std::move(fresh));
    document_.reread(onDisk, std::move(next));
    return out;
}

std::vector<std::string> RunningScene::files() const {
    std::vector<std::string> out = filesOf(document_.file());
    for (const Group& group : scene_.groups)
        if (!group.molecule.file.empty()) out.push_back(group.molecule.file);
    for (const Model& model : scene_.models)
        out.push_back(model.file);
    out.insert(out.end(), context_->shaderFiles().begin(), context_->shaderFiles().end());
    return out;
}

}  // namespace shoal::window
