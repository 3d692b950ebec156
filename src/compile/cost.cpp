#include "compile/cost.h"

#include <algorithm>

#include "core/contract.h"
#include "scene/field_kinds.h"

namespace shoal {

namespace {

// Hand counts of shaders/physics/noise.glsl, for noise that is computed: a corner of the lattice hashes (28),
// makes a gradient and weighs it.
constexpr double gradientNoiseOperations = 8 * 57, curlNoiseOperations = 16 * 145;
// Hand counts of shaders/physics/field.glsl and state/noise_tile.glsl, for noise by table: the place of a
// gust (40) and its wind (6); two moments of curl noise (62) and their blend (20). A filtered read of a tile
// is one fetch.
constexpr ReadingCost gustFromTile = {46, 1}, curlNoiseFromTile = {82, 2};
constexpr double undampedSpring = 24, muscleSpring = 9, directionalDrag = 25;
constexpr double triangle = 18, vertexNormal = 8;  // of normals

struct FieldCosts {
    ReadingCost operator()(const UniformField&) const { return {3, 0}; }
    ReadingCost operator()(const OscillatingField&) const { return {6, 0}; }
    ReadingCost operator()(const GustField& gust) const {
        return gust.noise == NoiseForm::table ? gustFromTile
                                              : ReadingCost{2 * gradientNoiseOperations + 45, 0};
    }
    ReadingCost operator()(const ShearField&) const { return {18, 0}; }
    ReadingCost operator()(const VortexField&) const { return {39, 0}; }
    ReadingCost operator()(const AbcField&) const { return {18, 0}; }
    ReadingCost operator()(const TaylorGreenField&) const { return {13, 0}; }
    ReadingCost operator()(const CurlNoiseField& noise) const {
        return noise.noise == NoiseForm::table ? curlNoiseFromTile
                                               : ReadingCost{noise.octaves * (curlNoiseOperations + 20), 0};
    }
    ReadingCost operator()(const GridField& grid) const {
        return grid.times.empty() ? ReadingCost{55, 8} : ReadingCost{110, 16};
    }
    ReadingCost operator()(const WavesField& waves) const { return {30.0 * double(waves.trains.size()), 0}; }
    ReadingCost operator()(const HurricaneField&) const { return {60, 0}; }
};

ReadingCost& operator+=(ReadingCost& a, const ReadingCost& b) {
    a.operations += b.operations;
    a.fetches += b.fetches;
    return a;
}

template <typename Shaped>
ReadingCost costOfAll(const std::vector<Shaped>& all) {
    ReadingCost out;
    for (const Shaped& shaped : all)
        out += costOf(*shaped.shape);
    return out;
}

// Counts a molecule and a frame.
ReadingCost stepCost(const Scene& scene, const Plan& plan, const GroupPlan& group) {
    const Molecule& molecule = scene.groups[group.index].molecule;
    const Needs& needs = group.needs;
    const Solver& solver = shoal::solver(group.solver);
    const double vertices = group.vertexCount, substeps = plan.substeps;
    const auto muscles =
        double(std::count_if(molecule.springs.begin(), molecule.springs.end(),
                             [](const Spring& spring) { return spring.actuation.has_value(); }));
    ReadingCost out;
    if (needs.springs) {
        const double springs =
            double(molecule.springs.size()) * (needs.springDamping ? springOperations : undampedSpring);
        out.operations +=
            (substeps * solver.evaluations + solver.perFrame) * (springs + muscleSpring * muscles);
    }
    // a stage evaluates all of the motion
    const double motions = std::max(1, solver.tableau.stages);
    double motion = motionOperations * vertices;
    if (needs.directionalDrag)
        motion += directionalDrag * vertices + triangle * double(molecule.triangles.size()) +
                  vertexNormal * vertices;
    out.operations += substeps * motions * motion;
    // a matrix of 3V x 3V, twice a substep
    if (group.factored()) out.operations += substeps * 2 * 2 * 9 * vertices * vertices;
    if (needs.collide) {
        const ReadingCost found = costOfAll(scene.colliders);
        // clusters of a table that are too far away are passed over
        const double looked = plan.colliders.turns > 0
                                  ? std::min(1.0, double(plan.colliders.turns) / double(plan.colliderCount))
                                  : 1;
        out.operations += substeps * vertices * looked * found.operations;
        out.fetches += substeps * vertices * looked * found.fetches;
    }
    if (needs.fields) {
        const ReadingCost read = costOfAll(scene.fields);
        const double readings = plan.fieldSampling == FieldSampling::vertexSubstep
                                    ? substeps * motions * vertices
                                : plan.fieldSampling == FieldSampling::vertexFrame ? vertices
                                                                                   : 1;
        out.operations += readings * read.operations;
        out.fetches += readings * read.fetches;
    }
    return out;
}

// 32-bit registers a lane (cost.h says what is counted).
int registersOf(const GroupPlan& group, int vertices) {
    constexpr int beside = 24;
    const int vectors = 2 + solver(group.solver).vectors + (group.needs.directionalDrag ? 1 : 0);
    return beside + 3 * vectors * vertices;
}

double occupancyOf(const KernelCost& cost, int workgroup) {
    constexpr double lanes = 2048, registers = 65536, shared = 100 * 1024;
    double held = std::min(lanes, registers / std::min(cost.registers, 255));
    if (cost.sharedBytes > 0) held = std::min(held, shared / cost.sharedBytes * workgroup);
    return held / lanes;
}

}  // namespace

ReadingCost costOf(const FieldShape& shape) {
    return std::visit(FieldCosts(), shape);
}

size_t bytesPerMolecule(const GroupPlan& group, bool drawn) {
    const BufferLayout layout = group.layout();
    const Needs& needs = group.needs;
    const size_t state = 2 * size_t(layout.stateElements());
    const size_t records = 1;  // read; written only when an anchor moves
    const size_t normals = drawn && needs.normals ? size_t(layout.positionElements()) : 0;
    const size_t constants = needs.scale || needs.phase ? 1 : 0;
    return (state + records + normals + constants) * sizeof(glm::vec4);
}

std::vector<KernelCost> kernelCosts(const Scene& scene, const Plan& plan, const PathChoice& choice,
                                    const PathLimits& limits) {
    EXPECTS(choice.path == Path::fused || choice.path == Path::fragments);
    std::vector<KernelCost> out;
    for (const GroupPlan& group : plan.groups) {
        KernelCost& cost = out.emplace_back();
        cost.group = group.name;
        cost.molecules = group.count;
        const BufferLayout layout = group.layout();
        const ReadingCost step = stepCost(scene, plan, group);
        cost.stateFetches =
            double(layout.stateElements()) + 1 + (group.needs.scale || group.needs.phase ? 1 : 0);
        cost.bytes = double(bytesPerMolecule(group, false));
        if (choice.path == Path::fragments) {
            const int stored = layout.stateElements() + (group.needs.records ? 1 : 0);
            cost.draws = (stored + limits.targets - 1) / limits.targets;
            cost.bytes += double(cost.draws - 1) * cost.stateFetches * sizeof(glm::vec4);
        } else {
            cost.lanes = chooseLanes(plan, group, choice.lanes, limits);
        }
        cost.operations = cost.draws * step.operations;
        cost.tableFetches = cost.draws * step.fetches;
        cost.stateFetches *= cost.draws;
        if (cost.lanes == Lanes::vertex) {
            const WorkgroupShape shape = workgroupShape(group.vertexCount, limits.maxSharedBytes);
            cost.sharedBytes = shape.molecules * FusedLimits::sharedBytes(group.vertexCount);
            cost.registers = registersOf(group, shape.vertices);
            cost.occupancy = occupancyOf(cost, shape.molecules * shape.rows);
        } else {
            cost.registers = registersOf(group, group.vertexCount);
            cost.occupancy = occupancyOf(cost, 0);
        }
    }
    return out;
}

}  // namespace shoal
