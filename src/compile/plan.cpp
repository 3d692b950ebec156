#include "compile/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compile/choose_solver.h"
#include "compile/generate.h"
#include "compile/generate_emitters.h"
#include "compile/lanes.h"
#include "compile/muscle_limits.h"
#include "compile/newton.h"
#include "compile/pack.h"
#include "compile/scene_warnings.h"
#include "compile/surface_pair.h"
#include "core/activity.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"
#include "scene/field_kinds.h"
#include "scene/force_kinds.h"
#include "scene/json/scene_file.h"
#include "scene/known_colliders.h"

namespace shoal {

namespace {

Needs findNeeds(const Scene& scene, const Group& group, const CompileOptions& options) {
    const Molecule& molecule = group.molecule;
    Needs needs;
    needs.drag = group.drag.any();
    needs.directionalDrag = group.drag.directional() && !molecule.triangles.empty();
    needs.fields = needs.drag && !scene.fields.empty();
    needs.gravity = scene.gravity != glm::dvec3(0);
    needs.springs = !molecule.springs.empty();
    needs.liveSprings = options.liveSprings && needs.springs;
    for (const Spring& spring : molecule.springs) {
        needs.springDamping |= spring.damping > 0;
        needs.actuation |= spring.actuation.has_value() && spring.actuation->amplitude != 0;
    }
    if (needs.liveSprings) needs.springDamping = needs.actuation = true;
    needs.pins = group.held && molecule.hasPins();
    needs.release = needs.pins && group.release.has_value();
    needs.life = group.life.has_value();
    needs.records = !needs.pins || needs.release || needs.life;
    needs.collide = group.collide && !scene.colliders.empty();
    needs.normals = !molecule.triangles.empty();
    needs.steers = group.school.has_value();
    needs.avoids = needs.steers && group.school->walls > 0 && !scene.colliders.empty();
    return needs;
}

// The group's own name, else its molecule's, numbered where that is taken.
std::string uniqueName(const Group& group, size_t index, const Plan& plan) {
    const std::string name = group.name.empty() ? group.molecule.name : group.name;
    const bool taken = std::any_of(plan.groups.begin(), plan.groups.end(),
                                   [&](const GroupPlan& other) { return other.name == name; });
    return taken ? concat(name, " ", index + 1) : name;
}

int placesOf(const Group& group) {
    return group.life ? group.life->capacity : group.count;
}

// Plans a group: its needs and numbers.
GroupPlan planGroup(const Scene& scene, size_t index, const CompileOptions& options, const Plan& plan) {
    const Group& group = scene.groups[index];
    if (!group.molecule.bends.empty())
        throw Error(group.molecule.places.bends.empty() ? group.location : group.molecule.places.bends[0],
                    "bends are not simulated yet: fold the sheet instead (docs/molecule-format.md)");
    GroupPlan out;
    out.name = uniqueName(group, index, plan);
    out.location = group.location;
    out.index = index;
    out.count = placesOf(group);
    out.vertexCount = int(group.molecule.vertices.size());
    out.springCount = int(group.molecule.springs.size());
    out.triangleCount = int(group.molecule.triangles.size());
    out.skinTriangleCount = int(group.molecule.skin.triangles.size());
    out.needs = findNeeds(scene, group, options);
    out.forces = generateForces(scene.forces, group.name, out.needs.drag);
    out.needs.forces = !out.forces.pulls.empty();
    out.needs.thrust = !out.forces.thrusts.empty();
    out.needs.wind = !out.forces.winds.empty();
    out.drag = group.drag;
    if (!out.needs.directionalDrag) out.drag.normal = out.drag.tangent;  // no surface
    for (const Vertex& vertex : group.molecule.vertices)
        out.pinned.push_back(out.needs.pins && vertex.pinned);
    if (group.release) out.release = *group.release;
    out.phaseSpread = group.phaseSpread;
    out.muscles = muscleFrequencies(group.molecule);
    if (countsMuscles(out.needs) && out.muscles.size() > mostMuscleFrequencies)
        throw Error(group.location,
                    concat("the muscles of \"", group.molecule.name, "\" beat at ", out.muscles.size(),
                           " different frequencies; at most ", mostMuscleFrequencies, " are possible"));
    out.musclePeriod = commonPeriod(out.muscles);
    out.stiffness = group.stiffness;
    out.damping = group.damping;
    out.size = group.molecule.size();
    if (group.life) {
        LifePlan& life = out.life.emplace();
        life.cycle = *group.life;
        life.atStart = group.count;
        life.seed = hash(uint32_t(scene.seed), uint32_t(scene.seed >> 32), uint32_t(index));
    }
    return out;
}

// The allocators on the CPU know of no death but of age.
void warnOfBooks(Plan& plan) {
    for (const GroupPlan& group : plan.groups) {
        if (!group.life || !group.life->emits()) continue;
        const Lifecycle& life = group.life->cycle;
        const bool booked = life.allocator == Allocator::stack || life.allocator == Allocator::heap;
        if (booked && life.life.y >= longestLife && (life.within || life.afterContact))
            plan.warnings.push_back(
                {life.location, concat("the allocator \"", name(life.allocator), "\" of \"", group.name,
                                       "\" knows of no death but of age: without a \"span\" the places of "
                                       "what dies otherwise never come back")});
    }
}

// Resolves emitters from deaths, whose source groups are known once all groups are.
void planLives(const Scene& scene, Plan& plan) {
    for (GroupPlan& group : plan.groups) {
        if (!group.life) continue;
        std::vector<BufferLayout> layouts;
        for (const Emitter& emitter : group.life->cycle.emitters) {
            size_t from = LifePlan::noSource;
            for (size_t g = 0; g < plan.groups.size() && emitter.from == Emitter::From::death; ++g)
                if (scene.groups[plan.groups[g].index].name == emitter.group) from = g;
            group.life->sources.push_back(from);
            layouts.push_back(from == LifePlan::noSource ? BufferLayout{} : plan.groups[from].layout());
            if (from != LifePlan::noSource) plan.groups[from].life->feeds = true;
        }
        if (!group.life->emits()) continue;
        group.life->source = generateEmitters(scene, group.life->cycle, layouts, plan.samples);
        group.life->middles = emitterMiddles(scene, group.life->cycle);
    }
}

// The colliders' parameters as they are for a group: what a surface does depends on what meets it.
std::vector<glm::vec4> parametersOf(const Scene& scene, const GroupPlan& group,
                                    const GeneratedColliders& colliders) {
    std::vector<glm::vec4> out = colliders.parameters;
    for (size_t i = 0; i < scene.colliders.size(); ++i) {
        const SurfacePair pair = surfacePair(scene, scene.groups[group.index], scene.colliders[i]);
        out[colliders.materials[i]].x = float(pair.restitution);
        out[colliders.materials[i]].y = float(pair.friction);
    }
    return out;
}

// Within a frame a pose is followed only so far.
void checkTurn(const Scene& scene, const Collider& collider) {
    if (!collider.path) return;
    const double turn = collider.path->fastestTurn() / scene.frameRate;
    if (turn <= mostTurn) return;
    throw Error(Location{scene.file, 0, 0, {}},
                concat("the collider \"", collider.name, "\" turns by ", turn,
                       " rad within a frame; at most ", mostTurn, " is followed: ",
                       std::ceil(collider.path->fastestTurn() / mostTurn), " frames a second would do"));
}

// Computed noise, grids and many waves are long texts.
bool isLong(const Field& field) {
    const WavesField* waves = std::get_if<WavesField>(&*field.shape);
    const GustField* gust = std::get_if<GustField>(&*field.shape);
    const CurlNoiseField* curl = std::get_if<CurlNoiseField>(&*field.shape);
    return (waves && waves->trains.size() > 4) || (gust && gust->noise == NoiseForm::computed) ||
           (curl && curl->noise == NoiseForm::computed) || std::holds_alternative<GridField>(*field.shape);
}

}  // namespace

bool Plan::hasLife() const {
    return std::any_of(groups.begin(), groups.end(), [](const GroupPlan& g) { return g.life.has_value(); });
}

// Placing takes memory here before any device is asked: of a molecule its record, constants and life, of a
// vertex its position and velocity.
void checkCounts(const Scene& scene) {
    int64_t left = std::numeric_limits<int>::max();  // vertices, which are counted in int
    for (const Group& group : scene.groups) {
        const int64_t count = placesOf(group);
        if (count < 1) throw Error(group.location, "a group needs at least one molecule");
        const int64_t vertices = int64_t(group.molecule.vertices.size());
        const int64_t ofLife = group.life ? int64_t(2 * sizeof(glm::vec2) + sizeof(uint32_t)) : 0;
        const int64_t each =
            vertices * 2 * int64_t(sizeof(glm::vec3)) + int64_t(sizeof(glm::vec3)) + 13 + ofLife;
        const int64_t available = availableMemory();
        const int64_t fit = left / vertices, held = available / each;
        const auto refuse = [&](const std::string& why, int64_t fitting) {
            throw Error(
                group.location,
                concat(many(count, "molecule", "molecules"), " of ", many(vertices, "vertex", "vertices"),
                       &group != &scene.groups.front() ? ", beside the groups before," : "", why,
                       ": at most ", fitting, " such molecules fit"));
        };
        if (count > fit)
            refuse(concat(" are more than the ", std::numeric_limits<int>::max(),
                          " vertices that a scene may have"),
                   fit);
        if (count > held)
            refuse(concat(" take ", (count * each) >> 20, " MiB to start; ", available >> 20,
                          " MiB of memory are free"),
                   held);
        left -= count * vertices;
    }
}

namespace {

// Plans a step, and the groups with their needs and solvers: nothing is placed, and no distance field is
// read. Error: as checkPlan() before a baking.
Plan planGroups(const Scene& scene, const CompileOptions& options) {
    checkCounts(scene);
    for (const Collider& collider : scene.colliders)
        checkTurn(scene, collider);
    Plan plan;
    plan.sceneName = scene.name;
    plan.frameRate = scene.frameRate;
    plan.substeps = scene.solver.substeps;
    plan.gravity = scene.gravity;
    plan.forces = scene.forces;
    plan.fieldSampling = scene.solver.fieldSampling;
    plan.warnings = scene.warnings;
    plan.fieldCount = scene.fields.size();
    plan.longFields = std::any_of(scene.fields.begin(), scene.fields.end(), isLong);
    plan.colliderCount = scene.colliders.size();
    plan.jointContact = respondTogether(scene.colliders);
    for (size_t i = 0; i < scene.groups.size(); ++i) {
        GroupPlan group = planGroup(scene, i, options, plan);
        if (group.needs.drag && scene.groups[i].drag.directional() && !group.needs.directionalDrag)
            plan.warnings.push_back(
                {scene.groups[i].location,
                 concat("\"", group.name, "\" has no triangles and so no surface: its drag is the ",
                        "tangent rate in all directions")});
        chooseSolver(scene, scene.groups[i], plan, group);
        checkMuscles(scene, scene.groups[i], plan.warnings);
        plan.groups.push_back(std::move(group));
    }
    return plan;
}

// Places the molecules of a group, and makes of its molecule what kernels and passes read.
void fill(GroupPlan& group, const Scene& scene, Plan& plan) {
    const Group& source = scene.groups[group.index];
    const Molecule& molecule = source.molecule;
    if (solver(group.solver).spread) group.matrix = newtonPattern(molecule, group);
    group.topologyBase = packTopology(molecule, group, plan.topology);
    const double vertices = double(group.count) * group.vertexCount;
    const std::string what =
        concat(group.count, " molecules of ", group.vertexCount, " vertices in \"", group.name, "\"");
    const Activity placing("placing " + what);
    namingMemory(source.location, what, double(sizeof(glm::vec3)) * (2 * vertices + 2 * group.count),
                 [&] { packStart(scene, group); });
    group.kernel = kernelText(molecule, group.needs, solver(group.solver),
                              fitsLane(group) || group.isStill());  // which is drawn in fragments
    if (group.needs.liveSprings) {
        group.springNumbers = springNumbers(molecule);
        group.springFrequencies = springFrequencies(molecule);
    }
    if (group.factored()) group.shape = molecule;
}

// The middle of the box around where molecules start and emitters emit, m.
glm::dvec3 middleOf(const Scene& scene, const Plan& plan) {
    glm::dvec3 low(1e300), high(-1e300);
    const auto add = [&](const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    };
    for (const GroupPlan& group : plan.groups) {
        const size_t placed = group.life ? size_t(group.life->atStart) : group.start.anchors.size();
        for (size_t m = 0; m < placed; ++m)
            add(group.start.anchors[m]);
        if (!group.life) continue;
        for (const Emitter& emitter : group.life->cycle.emitters)
            if (emitter.from != Emitter::From::death) add(placeOf(emitter, scene.models).middle);
    }
    return low.x > high.x ? glm::dvec3(0) : 0.5 * (low + high);
}

}  // namespace

void checkPlan(const Scene& scene) {
    const bool bakes =
        std::any_of(scene.colliders.begin(), scene.colliders.end(), isKind<DistanceFieldCollider>);
    bakes ? void(planGroups(scene, {})) : checkCounts(scene);  // else compile() follows at once
}

Plan compile(const Scene& scene, const CompileOptions& options) {
    checkScene(scene);
    Plan plan = planGroups(scene, options);
    for (GroupPlan& group : plan.groups)
        fill(group, scene, plan);
    plan.contact = planContact(scene, plan.groups);
    plan.school = planSchools(scene, plan.groups);
    warnOf(scene, plan);

    const auto any = [&](bool Needs::*need) {
        return std::any_of(plan.groups.begin(), plan.groups.end(),
                           [&](const GroupPlan& g) { return g.needs.*need; });
    };
    const glm::dvec3 middle = middleOf(scene, plan);
    if (any(&Needs::fields)) {
        plan.fields = generateFields(scene.fields, plan.samples, middle);
        plan.grids = describeGrids(scene.fields, plan.fields.noiseTiles);
    }
    if (any(&Needs::collide) || any(&Needs::avoids))
        plan.colliders = generateColliders(scene.colliders, plan.samples, middle);
    if (plan.fields.parameters.size() > maxParameters || plan.colliders.parameters.size() > maxParameters)
        throw Error(
            Location{scene.file, 0, 0, {}},
            concat("the scene has ", scene.fields.size(), " fields and ", scene.colliders.size(),
                   " colliders, more than the ", maxParameters, " 4-vectors of uniforms that each may take"));
    for (const GroupPlan& group : plan.groups)
        if (group.forces.parameterCount > maxForceParameters)
            throw Error(
                group.location,
                concat("the forces on \"", group.name, "\" take ", group.forces.parameterCount,
                       " 4-vectors of uniforms, more than the ", maxForceParameters, " that they may"));
    for (GroupPlan& group : plan.groups)
        if (group.needs.collide || group.needs.avoids)
            group.colliderParameters = parametersOf(scene, group, plan.colliders);
    planLives(scene, plan);
    warnOfBooks(plan);
    return plan;
}

int substepsNeeded(const Plan& plan, double frameTime, double stiffnessFactor, double dampingFactor,
                   double dragFactor, int substeps) {
    // Frequencies grow as sqrt(stiffness); the damped limit shrinks no faster than either factor does alone.
    const double factor = std::max({1.0, std::sqrt(stiffnessFactor), dampingFactor});
    double needed = substeps;
    for (const GroupPlan& group : plan.groups) {
        const double drag = std::max(group.drag.normal, group.drag.tangent) * dragFactor;
        needed = std::max(needed, std::ceil(frameTime * drag / solver(group.solver).mostDragged));
        if (group.needs.springs) needed = std::max(needed, std::ceil(frameTime * factor / group.stableStep));
    }
    return int(std::min(needed, 1e6));
}

float largestScale(const GroupPlan& group) {
    const std::vector<float>& scales = group.constants.scales;
    const float born = group.life ? float(group.life->cycle.scale.y) : 0;
    return scales.empty() ? 1 : std::max(born, *std::max_element(scales.begin(), scales.end()));
}

}  // namespace shoal
