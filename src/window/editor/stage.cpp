#include "window/editor/stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/json_edit.h"
#include "gpu/gl.h"
#include "molecule/molecule_json.h"
#include "scene/field_kinds.h"
#include "scene/known_colliders.h"
#include "window/editor/overlay.h"

namespace shoal::window {

namespace {

constexpr size_t mostPlayed = 3600;  // frames that one can go back to: a minute

// Whether the same programs run both: their text holds all but the springs' numbers and the start.
bool sameProgram(const Plan& a, const Plan& b) {
    const GroupPlan &group = a.groups[0], &other = b.groups[0];
    return group.kernel == other.kernel && group.solver == other.solver &&
           group.springCount == other.springCount && a.fields.source == b.fields.source &&
           a.fields.parameters == b.fields.parameters && a.colliders.source == b.colliders.source &&
           a.gravity == b.gravity && a.substeps == b.substeps &&
           group.colliderParameters == other.colliderParameters && group.drag.normal == other.drag.normal &&
           group.drag.tangent == other.drag.tangent && group.rigid == other.rigid;
}

// Whether a renderer that was made for one draws the other.
bool sameLooks(const Molecule& a, const Molecule& b) {
    const auto looks = [](const Molecule& molecule) {
        Molecule out = molecule;
        out.springs.clear();
        out.name = out.comment = {};
        for (Vertex& vertex : out.vertices) {
            vertex.position = glm::dvec3(0);
            vertex.mass = 1;
            vertex.pinned = false;
        }
        return toJson(out, true);
    };
    return a.file == b.file && sameJson(looks(a), looks(b));
}

}  // namespace

EditorStage::EditorStage(gpu::Context& context) : context_(&context) {}

Scene EditorStage::sceneOf(const Molecule& molecule, const StageSettings& settings) const {
    using Around = StageSettings::Around;
    Scene scene;
    scene.name = molecule.name;
    scene.frameRate = frameRate;
    scene.solver.substeps = settings.substeps;
    scene.solver.kind = settings.solver;
    if (settings.around != Around::still) scene.gravity = {0, -settings.gravity, 0};
    Group group;
    group.name = "molecule";
    group.molecule = molecule;
    group.count = 1;
    group.place.kind = Placement::Kind::list;
    group.place.turn = Placement::Turn::none;
    group.place.items.emplace_back();
    group.held = settings.pinsHold && settings.around != Around::drop;
    const bool surface = !molecule.triangles.empty();
    if (settings.around == Around::wind) {
        group.drag = {settings.drag, surface ? settings.drag / 5 : settings.drag};
        GustField gust;
        gust.direction = {1, 0, 0.3};
        gust.speed = gust.frontSpeed = settings.wind;
        const double size = molecule.size();
        gust.length = 8 * size;
        gust.width = 6 * size;
        Field field;
        field.shape = gust;
        scene.fields.push_back(field);
    } else if (settings.around == Around::drop) {
        group.drag = {0.3, surface ? 0.1 : 0.3};
    } else {
        group.drag = {0.2, 0.2};
    }
    scene.groups.push_back(group);
    Collider floor;
    floor.name = "floor";
    floor.shape = PlaneCollider{{0, floor_, 0}, {0, 1, 0}};
    floor.thickness = 0.002 * molecule.size();
    floor.color = {0.045, 0.05, 0.05};
    floor.draw = settings.floorShows;
    scene.colliders.push_back(floor);
    scene.light.direction = {-0.45, -1, -0.5};
    scene.sky.zenith = {0.10, 0.12, 0.15};
    scene.sky.horizon = {0.24, 0.27, 0.30};
    scene.sky.ground = settings.floorShows ? glm::dvec3(0.10, 0.11, 0.11) : scene.sky.horizon * 0.6;
    return scene;
}

void EditorStage::show(const Molecule& molecule, const StageSettings& settings) {
    const bool other = !simulation_ || scene_.groups[0].molecule.vertices.size() != molecule.vertices.size();
    const double size = molecule.size(), lowest = boxAround(molecule).low.y;
    if (!simulation_ || settings.around != settings_.around || lowest < floor_ + 0.2 * size)
        floor_ = lowest - (settings.around == StageSettings::Around::drop ? 1.2 : 0.6) * size;
    const Scene scene = sceneOf(molecule, settings);
    Plan plan = compile(scene, {.liveSprings = true});
    const bool same = simulation_ && sameProgram(plan, simulation_->plan());
    const bool looks = renderer_ && sameLooks(molecule, drawn_) && !other;
    std::unique_ptr<Renderer> renderer;  // before another scene is shown, since it may fail
    if (!looks) {
        RenderOptions options;
        options.width = renderer_ ? renderer_->width() : 64;
        options.height = renderer_ ? renderer_->height() : 64;
        options.grid = true;
        renderer = std::make_unique<Renderer>(*context_, scene, plan, options);
    }
    scene_ = scene;
    settings_ = settings;
    const std::vector<GroupState> start = {plan.groups[0].start};
    if (same)
        simulation_->changeSprings(0, molecule);
    else
        rebuild(plan, !other);
    if (!looks) {
        renderer_ = std::move(renderer);
        drawn_ = molecule;
    }
    if (played_.empty() || frame_ == 0) {
        SavedState first;
        first.groups = start;
        played_ = {first};
        frame_ = 0;
        simulation_->load(first);
    } else {
        played_.front().groups = start;
    }
    wobbling_ = false;
    takePositions();
}

// `goOn`: from the state as it is.
void EditorStage::rebuild(Plan plan, bool goOn) {
    std::optional<SavedState> saved;
    if (goOn && simulation_) saved = wobbling_ ? played_[size_t(frame_)] : simulation_->save();
    simulation_ = std::make_unique<Simulation>(*context_, plan);
    if (!saved) {
        played_.clear();
        frame_ = 0;
        return;
    }
    // what one solver knows of the last substep means nothing to another
    const bool history = plan.groups[0].layout().history;
    const auto fit = [&](SavedState& state) {
        GroupState& group = state.groups[0];
        const size_t count = history ? group.positions.size() : 0;
        if (group.displacements.size() == count) return;
        group.displacements.assign(count, glm::vec3(noHistory));
        group.velocityChanges.assign(count, glm::vec3(0));
    };
    fit(*saved);
    saved->step = 0;  // other forces
    for (SavedState& state : played_)
        fit(state);
    simulation_->load(*saved);
}

std::string EditorStage::advance() {
    if (!playing || !simulation_) return {};
    try {
        step();
    } catch (const Runaway& runaway) {
        playing = false;
        seek(std::max(0, frame_ - 1));
        return concat(runaway.what(), ": softer springs, more substeps or the solver bdf2-xpbd hold it");
    }
    return {};
}

void EditorStage::step() {
    if (wobbling_) rest();
    if (pull) applyPull();
    simulation_->frame();
    simulation_->check();
    played_.resize(size_t(frame_) + 1);
    played_.push_back(simulation_->save());
    if (played_.size() > mostPlayed) played_.erase(played_.begin() + 1);  // the rest shape stays
    frame_ = int(played_.size()) - 1;
    takePositions();
}

void EditorStage::rewind() {
    seek(0);
    played_.resize(1);
}

void EditorStage::seek(int frame) {
    frame_ = std::clamp(frame, 0, int(played_.size()) - 1);
    wobbling_ = false;
    simulation_->load(played_[size_t(frame_)]);
    takePositions();
}

// Reaches the target within a few frames, at any mass: the velocity is set, as a hand would.
void EditorStage::applyPull() {
    SavedState state = simulation_->save();
    GroupState& group = state.groups[0];
    const size_t v = size_t(pull->vertex);
    if (v >= group.positions.size()) return;
    const glm::dvec3 here = glm::dvec3(group.anchors[0]) + glm::dvec3(group.positions[v]);
    glm::dvec3 velocity = (pull->target - here) * (0.35 * frameRate);
    const double most = 30 * simulation_->plan().groups[0].size, speed = glm::length(velocity);
    if (speed > most) velocity *= most / speed;
    group.velocities[v] = velocity;
    if (!group.displacements.empty()) group.displacements[0] = glm::vec3(noHistory);
    simulation_->load(state);
}

void EditorStage::wobble(const Mode& mode, double reach) {
    SavedState state = played_.front();
    GroupState& group = state.groups[0];
    if (mode.shape.size() != group.positions.size()) return;
    for (size_t v = 0; v < mode.shape.size(); ++v) {
        group.positions[v] += glm::vec3(mode.shape[v] * reach);
        group.velocities[v] = glm::vec3(0);
    }
    simulation_->load(state);
    wobbling_ = true;
    takePositions();
}

const gpu::Texture& EditorStage::draw(const View& view, int width, int height) {
    renderer_->resize(width, height);
    renderer_->draw(simulation_->state(), view);
    return renderer_->picture();
}

Image EditorStage::picture(const View& view, int width, int height) {
    renderer_->resize(width, height);
    renderer_->draw(simulation_->state(), view);
    return renderer_->capture();
}

MoleculeCost measureCost(gpu::Context& context, const Molecule& molecule, const StageSettings& settings,
                         int count) {
    Scene scene;
    scene.gravity = {0, -settings.gravity, 0};
    scene.solver.substeps = settings.substeps;
    scene.solver.kind = settings.solver;
    GustField gust;
    gust.speed = gust.frontSpeed = settings.wind;
    Field field;
    field.shape = gust;
    scene.fields.push_back(field);
    Group group;
    group.molecule = molecule;
    group.count = count;
    group.held = settings.pinsHold;
    group.drag = {settings.drag, molecule.triangles.empty() ? settings.drag : settings.drag / 5};
    group.place.kind = Placement::Kind::volume;
    group.place.box = {glm::dvec3(-50), glm::dvec3(50)};
    scene.groups.push_back(group);

    SimulationOptions options;
    options.drawn = false;
    Simulation simulation(context, compile(scene), options);
    const auto frame = [&] {
        const auto begin = std::chrono::steady_clock::now();
        simulation.frame();
        glFinish();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    frame();
    std::vector<double> times;
    double sum = 0;
    while (times.size() < 5 || (sum < 0.1 && times.size() < 200)) {
        times.push_back(frame());
        sum += times.back();
    }
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
    return {times[times.size() / 2] / count, count, context.info().renderer};
}

}  // namespace shoal::window
