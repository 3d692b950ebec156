#include "window/running_scene.h"

#include <algorithm>
#include <filesystem>

#include "core/file.h"
#include "core/json_build.h"
#include "gpu/program_cache.h"
#include "molecule/molecule_file.h"
#include "run/progress.h"
#include "scene/json/saver.h"
#include "scene/json/scene_file.h"
#include "simulate/carry_over.h"
#include "window/json_rows.h"

namespace shoal::window {

namespace {

void copyEdits(const std::vector<Group>& from, std::vector<Group>& to) {
    for (size_t g = 0; g < from.size(); ++g)
        copyEdited(from[g], to[g]);
}

void settleParticles(Scene& scene) {
    for (Group& group : scene.groups)
        if (group.particle) group.molecule = moleculeOf(*group.particle);
}

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

const Group* named(const Scene& scene, const std::string& name) {
    for (const Group& group : scene.groups)
        if (group.name == name) return &group;
    return nullptr;
}

}  // namespace

RunningScene::RunningScene(const RunRequest& request, gpu::Context& context, Loaded loaded, int width,
                           int height)
    : request_(request),
      context_(&context),
      original_(loaded.scene),
      text_(readFile(original_.file)),
      saved_(text_),
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

// What runs stays until the new one is whole. Programs of a picture are made when it is drawn, so one picture
// tells whether they can be.
std::vector<std::string> RunningScene::build(Scene next, const Plan& plan, Path path) {
    std::unique_ptr<Simulation> simulation = simulateAsBefore(plan, path);
    tellWarnings(simulation->warnings());
    tellWarnings(context_->cache().takeWarnings());
    RenderOptions size;
    size.width = renderer_ ? renderer_->width() : width_;
    size.height = renderer_ ? renderer_->height() : height_;
    size.timing = simulation->timers().mode();
    auto renderer = std::make_unique<Renderer>(*context_, next, simulation->plan(), size);
    std::vector<std::string> restarted;
    if (simulation_) {
        GoneOn gone = goOn(simulation_->save(), simulation_->plan(), simulation->plan());
        simulation->load(gone.state);
        simulation->parameters = carriedParameters(simulation_->parameters, simulation->parameters);
        renderer->draw(simulation->state(), View::fromCamera(scene.camera, simulation_->time()));
        restarted = std::move(gone.restarted);
    }
    renderer_ = std::move(renderer);
    simulation_ = std::move(simulation);
    scene = std::move(next);
    accepted_ = scene.groups;
    acceptedChoices_ = choices;
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

std::vector<std::string> RunningScene::build(Scene next, bool warns) {
    settleParticles(next);
    const Plan plan = compileStably(next);
    if (warns) tellWarnings(plan.warnings);
    return build(std::move(next), plan, path_);
}

void RunningScene::applyChoices(Scene& next, const Scene& from) const {
    next.solver.kind = choices.solver.value_or(from.solver.kind);
    next.solver.substeps = from.solver.substeps;
    for (size_t g = 0; g < next.groups.size(); ++g) {
        Group& group = next.groups[g];
        const Group& own = from.groups[g];
        const auto found = choices.groups.find(group.name);
        const GroupChoice choice = found == choices.groups.end() ? GroupChoice() : found->second;
        group.count = choice.count.value_or(own.count);
        if (group.life) group.life->capacity = std::max(group.life->capacity, group.count);
        if (group.particle) continue;
        group.molecule = choice.molecule.empty() ? own.molecule : readMolecule(choice.molecule);
        Material& material = group.molecule.material;
        material.roughness = choice.roughness.value_or(material.roughness);
        material.translucency = choice.translucency.value_or(material.translucency);
        material.opacity = choice.opacity.value_or(material.opacity);
    }
}

void RunningScene::edit() {
    try {
        Scene next = scene;
        next.solver.substeps = original_.solver.substeps;
        build(std::move(next));
    } catch (const Error&) {
        copyEdits(accepted_, scene.groups);
        settleParticles(scene);
        throw;
    }
}

void RunningScene::choose() {
    try {
        Scene next = scene;
        applyChoices(next, original_);
        build(std::move(next));
    } catch (const Error&) {
        choices = acceptedChoices_;
        throw;
    }
}

void RunningScene::switchPath(Path path) {
    build(scene, simulation_->plan(), path);
    path_ = path;
}

bool RunningScene::edited() const {
    return differ(original_, scene);
}

bool RunningScene::unsaved() const {
    return text_ != saved_ || edited();
}

void RunningScene::save() {
    const std::string onDisk = readFile(original_.file);
    const bool changed = text_ != saved_;
    if (changed && onDisk != saved_)
        throw Error(Location{original_.file}, "has changed since it was read: nothing was saved");
    const std::string edited = withEdits(changed ? text_ : onDisk, original_, scene);
    if (edited != onDisk) writeFile(original_.file, edited);
    text_ = saved_ = edited;
    copyEdits(scene.groups, original_.groups);
}

void RunningScene::revert() {
    if (text_ != saved_) {
        const std::string onDisk = readFile(original_.file);
        go(onDisk, undo_);
        saved_ = onDisk;
        return;
    }
    copyEdits(original_.groups, scene.groups);
    edit();
}

std::string RunningScene::text() const {
    return withEdits(text_, original_, scene);
}

JsonValue RunningScene::json() const {
    return parseJson(text(), original_.file);
}

Scene RunningScene::read(const std::string& text) const {
    FieldWatch baking;
    return parseScene(text, original_.file,
                      {baking.baking(), request_.lenient, [this](Scene& made) { apply(request_, made); }});
}

// Builds `fresh` in its place. Without `keepsChoices` the choices give way to what it says.
std::vector<std::string> RunningScene::replace(Scene fresh, bool keepsChoices) {
    const Choices before = choices;
    if (!keepsChoices) choices = {};
    try {
        Scene next = fresh;
        applyChoices(next, fresh);
        std::vector<std::string> restarted = build(std::move(next), true);
        original_ = std::move(fresh);
        return restarted;
    } catch (const Error&) {
        choices = before;
        throw;
    }
}

std::vector<std::string> RunningScene::take(const std::string& text) {
    Scene fresh = read(text);
    const bool keepsChoices = changedChoices(fresh).empty();
    std::vector<std::string> restarted = replace(std::move(fresh), keepsChoices);
    text_ = text;
    return restarted;
}

// Takes a text and adds the one that it leaves behind to `passed`.
void RunningScene::go(const std::string& text, std::vector<std::string>& passed) {
    std::string previous = this->text();
    take(text);
    passed.push_back(std::move(previous));
}

// Returns `text`, which was read as `before`, with what differs in `after`.
static std::string withJson(const std::string& text, const JsonValue& before, const JsonValue& after) {
    std::vector<TextChange> changes;
    addChanges(text, before, before, after, changes);
    return withChanges(text, std::move(changes));
}

void RunningScene::change(const JsonValue& after) {
    const std::string current = text(), next = withJson(current, parseJson(current, original_.file), after);
    if (next == current) return;
    go(next, undo_);
    redo_.clear();
}

void RunningScene::add(const std::string& file) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::absolute(scene.file).parent_path();
    const std::string name = fs::relative(file, folder).generic_string();
    const bool molecule = fs::path(file).extension() == ".json";
    JsonValue root = json();
    const char* list = molecule ? "groups" : "models";
    const JsonValue* existing = root.find(list);
    JsonValue longer = existing ? *existing : JsonValue::makeArray();
    longer.items.push_back(molecule ? smallestGroup(longer, name) : object(key("file", name)));
    setMember(root, list, std::move(longer));
    change(root);
}

void RunningScene::undo() {
    const bool onlyEdited = edited();
    if (!onlyEdited && undo_.empty()) return;
    const std::string before = onlyEdited ? text_ : undo_.back();
    go(before, redo_);
    if (!onlyEdited) undo_.pop_back();
}

void RunningScene::redo() {
    if (redo_.empty()) return;
    const std::string after = redo_.back();
    go(after, undo_);
    redo_.pop_back();
}

// Returns the choices whose value the file changed, too.
std::vector<std::string> RunningScene::changedChoices(const Scene& theirs) const {
    std::vector<std::string> out;
    if (choices.solver && theirs.solver.kind != original_.solver.kind &&
        theirs.solver.kind != *choices.solver)
        out.emplace_back("$.solver.method");
    for (const auto& [name, choice] : choices.groups) {
        const Group *before = named(original_, name), *after = named(theirs, name);
        if (!before || !choice.any()) continue;
        if (!after) {
            out.push_back(concat("the group \"", name, "\""));
            continue;
        }
        if (choice.count && after->count != before->count && after->count != *choice.count)
            out.push_back(concat("count of \"", name, "\""));
        if (!choice.molecule.empty() && after->molecule.file != before->molecule.file)
            out.push_back(concat("molecule of \"", name, "\""));
        const Material &previous = before->molecule.material, &current = after->molecule.material;
        const auto look = [&, &group = name](const std::optional<double>& chosen, double old, double fresh,
                                             const char* what) {
            if (chosen && old != fresh && fresh != *chosen)
                out.push_back(concat(what, " of \"", group, "\""));
        };
        look(choice.roughness, previous.roughness, current.roughness, "roughness");
        look(choice.translucency, previous.translucency, current.translucency, "translucency");
        look(choice.opacity, previous.opacity, current.opacity, "opacity");
    }
    return out;
}

RunningScene::Reloaded RunningScene::reload(std::optional<Prefer> prefer) {
    const std::string onDisk = readFile(original_.file);
    const bool changed = onDisk != saved_;  // else another file has, which the scene names
    Reloaded out;
    std::string combined = text();
    if (changed) {
        const JsonValue theirs = parseJson(onDisk, original_.file);
        combined = withJson(onDisk, theirs,
                            merged(parseJson(saved_, original_.file), parseJson(combined, original_.file),
                                   theirs, prefer.value_or(Prefer::mine), "$", out.conflicts));
    }
    Scene fresh = read(combined);
    const std::vector<std::string> choicesToo = changedChoices(fresh);
    out.conflicts.insert(out.conflicts.end(), choicesToo.begin(), choicesToo.end());
    if (!out.conflicts.empty() && !prefer) return out;

    out.restarted = replace(std::move(fresh), prefer != Prefer::theirs || choicesToo.empty());
    if (changed) {  // the texts are of before: going back to one would take the file's change back as well
        undo_.clear();
        redo_.clear();
        saved_ = text_ = onDisk;
    }
    if (combined != text_) undo_.push_back(text_);
    text_ = combined;
    return out;
}

std::vector<std::string> RunningScene::files() const {
    std::vector<std::string> out = filesOf(original_.file);
    for (const Group& group : scene.groups)
        if (!group.molecule.file.empty()) out.push_back(group.molecule.file);
    for (const Model& model : scene.models)
        out.push_back(model.file);
    out.insert(out.end(), context_->shaderFiles().begin(), context_->shaderFiles().end());
    return out;
}

}  // namespace shoal::window
