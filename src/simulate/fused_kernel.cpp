#include "simulate/fused_kernel.h"

#include <algorithm>
#include <array>
#include <bit>

#include "compile/corotated.h"
#include "compile/generate.h"
#include "compile/lanes.h"
#include "compile/newton.h"
#include "core/contract.h"
#include "gpu/shader_source.h"
#include "simulate/tables.h"
#include "simulate/vertex_loops.h"
#include "simulate/watchdog.h"

namespace shoal {

namespace {

int deathRunsOf(const Lifecycle& life) {
    return int(std::count_if(life.emitters.begin(), life.emitters.end(),
                             [](const Emitter& emitter) { return emitter.from == Emitter::From::death; }));
}

void defineLife(const LifePlan& life, bool births, std::vector<std::string>& out) {
    const Lifecycle& cycle = life.cycle;
    const auto define = [&](bool need, const char* name) {
        if (need) out.emplace_back(name);
    };
    define(life.feeds, "DEATHS");
    out.push_back(gpu::constant("CONFINED", cycle.within.has_value()));
    define(cycle.afterContact.has_value(), "TOUCH_COUNTS");
    if (!births) return;
    out.push_back(concat("RUNS ", std::max(1, mostRuns(cycle))));
    if (const int runs = deathRunsOf(cycle)) out.push_back(concat("DEATH_RUNS ", runs));
}

using Work = KernelOptions::Work;

bool writesNormals(const GroupPlan& group, const KernelOptions& options) {
    return group.needs.normals && (options.normals || options.work == Work::normals);
}

// Whether contact with other molecules acts on the step.
bool remembers(const Plan& plan, const GroupPlan& group, const KernelOptions& options) {
    return options.work == Work::frame && plan.contact.remembers() &&
           plan.contact.find(size_t(&group - plan.groups.data()));
}

bool raisesAlarm(const KernelOptions& options) {
    return options.watch && options.work == Work::frame && !options.targets;
}

bool votes(const GroupPlan& group, const KernelOptions& options) {
    return options.groupVote && options.lanes == Lanes::molecule && group.needs.collide;
}

bool answersAsBody(const GroupPlan& group, const KernelOptions& options) {
    return group.rigid && group.needs.collide && options.lanes == Lanes::molecule;
}

// What ordinary conditions of the shaders ask for.
std::vector<std::string> constants(const Plan& plan, const GroupPlan& group, const KernelOptions& options) {
    using gpu::constant;
    const Needs& needs = group.needs;
    const bool perLane = options.lanes == Lanes::molecule, births = options.work == Work::births;
    // only with such loops can a frame turn more often than it may (compile/collider_table.h), or than a CPU
    // rasteriser takes (gpu/context.h)
    const bool mayBeCut =
        (needs.collide && plan.colliders.turns > 0) ||
        (options.software && (plan.longFields || !perLane || (needs.collide && plan.jointContact)));
    const bool acts = remembers(plan, group, options), isBody = answersAsBody(group, options),
               mayDieOfTouch = needs.life && group.life->cycle.afterContact.has_value();
    return {constant("LANE_A_VERTEX", !perLane),
            constant("MAY_BE_CUT", mayBeCut),
            constant("CARRIES", options.software && !votes(group, options)),
            constant("TOGETHER", needs.collide && (options.software || votes(group, options))),
            constant("ISSUED_AHEAD", raisesAlarm(options) && options.ahead),
            constant("RESTS", acts && !options.targets && plan.contact.mayRest(group)),
            constant("MAY_BE_HELD", acts && isBody && !mayDieOfTouch),
            constant("RIGID_IMPACT", isBody),
            constant("COLLIDE", needs.collide),
            constant("ANCHORS_MOVE", needs.records),
            constant("RELEASE", needs.release),
            constant("PINS", needs.pins),
            constant("SPRINGS", needs.springs),
            constant("SAMPLE_SUBSTEPS", births || plan.fieldSampling == FieldSampling::vertexSubstep),
            constant("SAMPLE_MOLECULE", !births && plan.fieldSampling == FieldSampling::moleculeFrame)};
}

std::vector<std::string> defines(const Plan& plan, const GroupPlan& group, const KernelOptions& options) {
    const Needs& needs = group.needs;
    std::vector<std::string> out = group.layout().defines(options.targets.has_value());
    const bool births = options.work == Work::births, perLane = options.lanes == Lanes::molecule;
    if (!options.targets)
        out.push_back(concat("LANES ", births ? birthLanes : workgroupMolecules(group, options)));
    if (perLane) {
        out.push_back(concat("VERTICES ", group.vertexCount));
    } else {
        const WorkgroupShape shape = workgroupShape(group.vertexCount, options.sharedBytes);
        out.insert(out.end(), {concat("ROWS ", shape.rows), concat("VERTICES ", shape.vertices),
                               concat("MOLECULE_VERTICES ", group.vertexCount),
                               concat("TRIANGLES ", group.triangleCount)});
    }
    const auto define = [&](bool need, const char* name) {
        if (need) out.emplace_back(name);
    };
    define(true, "FUSED");
    define(options.software, "SOFTWARE");
    define(votes(group, options), "GROUP_VOTE");
    if (options.work == Work::watch || raisesAlarm(options)) out.push_back(fastestDefine());
    const ContactGroup* contact = plan.contact.find(size_t(&group - plan.groups.data()));
    if (options.work == Work::touched || remembers(plan, group, options)) {
        EXPECTS(contact);
        out.push_back(concat("SPHERES ", contact->spheresOf));
        if (options.targets)
            out.insert(out.end(), {"TEXTURES", concat("ROW_BITS ", rowBits(plan.contact.cells()))});
    }
    define(needs.records, "RECORDS");
    for (const std::string& constant : constants(plan, group, options))
        out.push_back(constant);
    define(group.solver == SolverKind::leapfrog, "LEAPFROG");
    define(group.solver == SolverKind::verlet, "VERLET");
    if (solver(group.solver).rungeKutta())
        out.push_back(concat("STAGES ", solver(group.solver).tableau.stages));
    define(needs.actuation || (needs.steers && !perLane), "MUSCLES");
    define(needs.scale || needs.phase, "CONSTANTS");
    define(needs.fields, "FIELDS");
    define(needs.forces, "FORCES");
    define(needs.thrust, "THRUST");
    define(needs.directionalDrag, "DIRECTIONAL_DRAG");
    define(needs.steers, "STEERED");
    if (needs.collide && contact && !births)
        for (const std::string& wanted : contact->defines())
            out.push_back(wanted);
    if (solver(group.solver).implicit) out.push_back(concat("SPRING_COUNT ", std::max(1, group.springCount)));
    for (const std::string& wanted : newtonDefines(group))
        out.push_back(wanted);
    if (births && options.targets)
        out.insert(out.end(), {"TEXTURES", concat("ROW_BITS ", std::countr_zero(unsigned(stateWidth)))});
    if (needs.life) defineLife(*group.life, births, out);
    return out;
}

// The uniforms that the kernel copies before it begins.
std::string parameterLoads(const GroupPlan& group, const KernelOptions& options) {
    std::string out = "\nvoid loadParameters()\n{\n    loadUniforms();\n";
    const auto load = [&](bool need, const char* what) {
        if (need) out += concat("    load", what, "();\n");
    };
    load(group.needs.fields, "FieldParameters");
    load(countsMuscles(group.needs) && options.work != Work::births, "MuscleAngles");
    load(group.forces.any(), "ForceParameters");
    load(group.needs.collide && options.work != Work::births, "ColliderParameters");
    return out + "}\n\n";
}

// The files of a kernel in the order in which they build on one another.
std::string rootText(const Plan& plan, const GroupPlan& group, const KernelOptions& options) {
    const bool perLane = options.lanes == Lanes::molecule;
    std::string out;
    if (votes(group, options)) out += "#extension GL_ARB_shader_group_vote : require\n";
    const auto include = [&](bool need, const std::string& file) {
        if (need) out += concat("#include \"", file, "\"\n");
    };
    include(true, "fused/state.glsl");
    include(countsMuscles(group.needs), "generated/muscles.glsl");
    include(perLane, "generated/molecule.glsl");
    include(group.needs.steers, "fused/steering.glsl");
    include(!perLane, "generated/waves.glsl");
    include(true, perLane ? "generated/forces.glsl" : "fused/gather.glsl");
    // This include is never under a condition: a file that it includes would be left out with it, and a later
    // include of that file does nothing.
    include(group.needs.fields, "generated/fields.glsl");
    include(true, remembers(plan, group, options) ? "fused/loads.glsl" : "fused/no_loads.glsl");
    include(true, "fused/step.glsl");
    if (options.work == Work::births)
        return out + parameterLoads(group, options) + "#include \"births/spawn.glsl\"\n";
    if (solver(group.solver).implicit) {
        include(true, "fused/stage.glsl");
        include(group.factored(), "generated/factors.glsl");
        include(!solver(group.solver).spread, "generated/sweeps.glsl");
    }
    include(true, group.needs.collide ? "generated/colliders.glsl" : "fused/no_contact.glsl");
    include(true, solver(group.solver).history ? "fused/bdf2.glsl" : "fused/no_history.glsl");
    include(true, concat("solver/", solver(group.solver).shader(), ".glsl"));
    if (group.needs.collide) {
        include(true, "fused/answers.glsl");
        include(true, answersAsBody(group, options) ? "fused/body.glsl" : "fused/no_body.glsl");
        include(true, plan.jointContact ? "fused/joint_contact.glsl" : "fused/contact.glsl");
    }
    const bool normals = writesNormals(group, options);
    include(true, options.targets ? "fused/layers.glsl" : "fused/buffers.glsl");
    include(normals && !options.targets, "fused/new_normals.glsl");
    include(true, perLane ? "fused/lane.glsl" : "fused/group.glsl");
    include(normals && !perLane, "fused/group_normals.glsl");
    out += parameterLoads(group, options);
    if (options.work == Work::frame) {
        include(true, normals ? "fused/normals.glsl" : "fused/no_normals.glsl");
        include(true, raisesAlarm(options) ? "fused/alarm.glsl" : "fused/no_alarm.glsl");
        include(true, group.needs.life ? "particles/age.glsl" : "fused/ageless.glsl");
        include(true, "fused/frame.glsl");
    }
    include(options.work == Work::normals, "fused/only_normals.glsl");
    include(options.work == Work::watch, "fused/watch.frag");
    include(options.work == Work::touched, "fused/touched.frag");
    return out;
}

// A function that writes the values to a buffer.
std::string storeToBuffer(const std::vector<std::string>& values, const char* function, const char* elements,
                          const char* buffer) {
    std::string out = concat("\nvoid ", function,
                             "(int molecule)\n{\n    int first = firstElement(molecule, ", elements, ");\n");
    for (size_t e = 0; e < values.size(); ++e)
        out += concat("    ", buffer, "[first + ", e * BufferLayout::block, "] = stored(", values[e], ");\n");
    return out + "}\n";
}

// Declares so many colour targets.
std::string declareTargets(int count) {
    std::string out = "\n";
    for (int t = 0; t < count; ++t)
        out += concat("layout(location = ", t, ") out vec4 target", t, ";\n");
    return out;
}

// Declares the 4-vectors that a vertex hands to the fragment that stores them; `way`: "out" or "in".
std::string declareHanded(const char* way, int count) {
    std::string out = "\n";
    for (int t = 0; t < count; ++t)
        out += concat("flat ", way, " vec4 handed", t, ";\n");
    return out;
}

// A function that writes those of the values that this draw stores to variables of a name and a number.
std::string storeOfDraw(const std::vector<std::string>& values, const char* function, int targets,
                        const char* name) {
    std::string out = concat("\nuniform int firstStored;\n\nvoid ", function, "(int molecule)\n{\n");
    for (const int first : drawsOf(values.size(), targets)) {
        out += concat("    if (firstStored == ", first, ") {\n");
        for (int t = 0; t < targets; ++t)
            out += concat("        ", name, t, " = ", values[size_t(first + t)], ";\n");
        out += "    }\n";
    }
    return out + "}\n";
}

// The fragment: what it is handed, into the targets.
std::string newbornText(int targets) {
    std::string out = "// Stores what a vertex has made of a newborn (births/spawn.glsl).\n";
    out += declareHanded("in", targets) + declareTargets(targets) + "\nvoid main()\n{\n";
    for (int t = 0; t < targets; ++t)
        out += concat("    target", t, " = handed", t, ";\n");
    return out + "}\n";
}

// The GLSL of what draws store of a molecule, a 4-vector each, in the order of the layers
// (simulate/layer_state.h).
std::vector<std::string> storedByDraws(const GroupPlan& group, Work work) {
    if (work == Work::normals) return group.kernel.normals;
    std::vector<std::string> out = group.kernel.state;
    if (group.needs.records) out.emplace_back("recordNow()");
    if (work == Work::births && (group.needs.scale || group.needs.phase)) out.emplace_back("constantsNow()");
    return out;
}

int targetsOf(const std::vector<std::string>& values, const KernelOptions& options) {
    return std::min(*options.targets, int(values.size()));
}

// How a fragment, or a vertex that makes a newborn, loads and stores its molecule.
std::string packingOfDraw(const GroupPlan& group, const KernelOptions& options) {
    const std::string& load = group.kernel.load;
    if (options.work == Work::watch) return load;
    const std::vector<std::string> values = storedByDraws(group, options.work);
    const int targets = targetsOf(values, options);
    if (options.work == Work::births)
        return load + declareHanded("out", targets) + storeOfDraw(values, "storeState", targets, "handed");
    const char* function = options.work == Work::normals ? "storeNormals" : "storeState";
    return load + declareTargets(targets) + storeOfDraw(values, function, targets, "target");
}

// How a lane loads and stores its molecule.
std::string packingText(const GroupPlan& group, const KernelOptions& options) {
    if (options.targets) return packingOfDraw(group, options);
    const KernelText& kernel = group.kernel;
    std::string out = kernel.load + storeToBuffer(kernel.state, "storeState", "STATE_ELEMENTS", "newState");
    if (writesNormals(group, options))
        out += storeToBuffer(kernel.normals, "storeNormals", "POSITION_ELEMENTS", "newNormals");
    return out;
}

std::string factorsText(const GroupPlan& group, const KernelOptions& options) {
    if (!group.factored() || !options.factors.empty()) return options.factors;
    return corotatedBlock(blockPattern(group.shape, group.needs.pins));
}

// Writing out a long loop takes long to compile, mostly in the driver; keeping it costs a GPU its registers.
// Noise is too long to be written out for more than a few vertices. A CPU rasteriser has no registers that
// are looked up by index. It writes out loops of up to 32 turns by itself; a longer loop that is kept takes
// it several times as long to compile as one that is written out.
VertexLoops loopsOf(const Plan& plan, const GroupPlan& group, const KernelOptions& options) {
    using Form = VertexLoops::Form;
    const auto form = [](bool keep) { return keep ? Form::keep : Form::writeOut; };
    constexpr size_t longest = 48;  // calls of a field or a collider
    const auto vertices = size_t(verticesOfLane(group, options));
    const bool software = options.software;
    const bool isLong = plan.longFields || (!software && !plan.fields.noiseTiles.empty());
    return {int(vertices), Form::writeOut,
            form((isLong && vertices > (software ? 1 : 8)) ||
                 (!software && vertices * (plan.fieldCount + group.forces.pulls.size()) > longest)),
            form(!software && vertices * plan.colliderCount > longest), form(!software || vertices <= 32)};
}

const char* rootFile(const KernelOptions& options) {
    if (!options.targets) return "generated/fused.comp";
    return options.work == Work::births ? "generated/births.vert" : "generated/fused.frag";
}

// Whether only the GPU knows how far a step has to go.
bool reachesByControl(const GroupPlan& group, const KernelOptions& options) {
    return options.work == Work::frame && group.life && group.life->emits() &&
           group.life->cycle.allocator == Allocator::gpu;
}

}  // namespace

std::vector<int> drawsOf(size_t values, int targets) {
    std::vector<int> out;
    for (int first = 0; first < int(values); first += targets)
        out.push_back(std::max(0, std::min(first, int(values) - targets)));
    return out;
}

int verticesOfLane(const GroupPlan& group, const KernelOptions& options) {
    return options.lanes == Lanes::molecule ? group.vertexCount
                                            : workgroupShape(group.vertexCount, options.sharedBytes).vertices;
}

int workgroupMolecules(const GroupPlan& group, const KernelOptions& options) {
    return options.lanes == Lanes::molecule
               ? group.layout().lanes()
               : workgroupShape(group.vertexCount, options.sharedBytes).molecules;
}

gpu::ProgramOptions kernelProgram(const Plan& plan, size_t index, const KernelOptions& options) {
    const GroupPlan& group = plan.groups[index];
    gpu::ProgramOptions out;
    const bool born = options.work == Work::births;
    const std::string root = rootFile(options);
    if (!options.targets)
        out.compute = root;
    else if (born)
        out.vertex = root, out.fragment = "generated/newborn.frag";
    else
        out.vertex = reachesByControl(group, options) ? "births/reach.vert" : "passes/fullscreen.vert",
        out.fragment = root;
    out.defines = defines(plan, group, options);
    out.generated = {{root, rootText(plan, group, options)},
                     {"generated/molecule.glsl", group.kernel.molecule},
                     {"generated/muscles.glsl", group.kernel.muscles},
                     {"generated/waves.glsl", group.kernel.waves},
                     {"generated/forces.glsl", group.kernel.forces},
                     {"generated/stages.glsl", group.kernel.stages},
                     {"generated/sweeps.glsl", group.kernel.sweeps},
                     {"generated/factors.glsl", factorsText(group, options)},
                     {"generated/packing.glsl", packingText(group, options)},
                     {"generated/fields.glsl", plan.fields.source},
                     {"generated/emitters.glsl", group.life ? group.life->source : std::string()},
                     {"generated/scene_forces.glsl", group.forces.source},
                     {"generated/colliders.glsl", plan.colliders.source}};
    if (options.targets && born)
        out.generated["generated/newborn.frag"] =
            newbornText(targetsOf(storedByDraws(group, options.work), options));
    constexpr const char* labels[] = {"fused step", "normals", "watch", "contact touched", "births"};  // Work
    out.label = concat(labels[size_t(options.work)], " of ", group.name);
    if (options.work == Work::frame) out.seconds = secondsToCompile(plan, group, options.lanes);
    out.rewrite = [loops = loopsOf(plan, group, options)](gpu::ShaderSource& source) {
        expand(source, loops);
    };
    return out;
}

namespace {

// For givenNumbers of shaders/fused/state.glsl.
std::array<glm::vec4, 7> givenNumbers(const GroupPlan& group, const Frame& frame) {
    const Parameters& parameters = frame.parameters;
    const DragCoefficients drag = dragCoefficients(group, parameters, frame.h);
    const StageCoefficients stage = stageCoefficients(group, parameters, frame.h);
    const ReleaseLimits release = releaseLimits(group, frame);
    const glm::vec2 dragRate = glm::vec2(group.drag.normal, group.drag.tangent) * float(parameters.drag);
    return {
        glm::vec4(parameters.gravity, parameters.wind),
        glm::vec4(frame.h, parameters.frameTime, group.stiffness * parameters.stiffness,
                  group.damping * parameters.damping),
        glm::vec4(drag.decay, drag.phi),
        glm::vec4(drag.bend, dragRate),
        glm::vec4(driftOf(group.solver, frame.h, drag.slips), stage.eta),
        glm::vec4(stage.drag.decay, stage.drag.phi),
        glm::vec4(release.force, release.chance, 0, 0),
    };
}

}  // namespace

std::vector<glm::vec4> stepNumbers(const Plan& plan, const GroupPlan& group, const Frame& frame) {
    const auto given = givenNumbers(group, frame);
    std::vector<glm::vec4> out(given.begin(), given.end());
    out[1].y = 0;  // the frame's length acts on nothing
    const auto add = [&](const std::vector<glm::vec4>& more) {
        out.insert(out.end(), more.begin(), more.end());
    };
    if (group.needs.fields) add(fieldParameters(plan, frame));
    if (group.forces.any()) add(forceParameters(plan, group, frame));
    if (group.needs.collide) add(colliderParameters(plan, group, frame));
    return out;
}

void setStepUniforms(const gpu::Program& program, const Plan& plan, const GroupPlan& group,
                     const Frame& frame) {
    const DragCoefficients drag = dragCoefficients(group, frame.parameters, frame.h);
    program.set("givenCounts",
                glm::ivec4(frame.number, frame.parameters.substeps, int(drag.slips), int(frame.restarts)));
    const auto numbers = givenNumbers(group, frame);
    program.set("givenNumbers", std::span<const glm::vec4>(numbers));
    if (group.needs.fields)
        program.set("givenFieldParameters", std::span<const glm::vec4>(fieldParameters(plan, frame)));
    if (countsMuscles(group.needs))
        program.set("givenMuscleAngles", std::span<const glm::vec4>(muscleAngles(group.muscles, frame.time)));
    if (group.forces.any())
        program.set("givenForceParameters", std::span<const glm::vec4>(forceParameters(plan, group, frame)));
    if (group.needs.collide && !plan.colliders.moving.empty())
        program.set("givenColliderParameters",
                    std::span<const glm::vec4>(colliderParameters(plan, group, frame)));
}

std::string kernelShader(const std::string& shaderRoot, const Plan& plan, size_t group,
                         const KernelOptions& options) {
    const gpu::ProgramOptions program = kernelProgram(plan, group, options);
    gpu::ShaderSource source =
        gpu::resolveShader(shaderRoot, rootFile(options), program.defines, program.generated,
                           options.targets ? gpu::header330() : gpu::header430());
    program.rewrite(source);
    return source.text;
}

}  // namespace shoal
