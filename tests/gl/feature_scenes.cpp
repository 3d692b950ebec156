#include "gl/feature_scenes.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "gl/gl_test.h"
#include "molecule/molecule_file.h"
#include "scene/field_kinds.h"
#include "scene/json/scene_file.h"
#include "support/every_kind.h"

namespace shoal::test {

namespace {

constexpr const char* sourceFolder = SHOAL_SOURCE_DIR "/";
const glm::dvec3 down{0, -9.81, 0};

SolverKind solverOf(size_t number) {
    const std::vector<SolverKind> all = explicitSolvers();
    return all[number % all.size()];
}

// Without compute shaders there is one: kernels in fragments have the text of compute shaders and take
// minutes to compile with every solver.
std::vector<SolverKind> solversHere() {
    if (!testContext().info().computeShaders) return {SolverKind::leapfrog};
    return explicitSolvers();
}

Group& groupOf(Scene& scene) {
    return scene.groups[0];
}

// Leaves of 1 m, each scene with one kind of field, which pushes across the surface more than along it.
void addFields(std::vector<FeatureScene>& out) {
    const std::vector<Field> fields = everyField();
    for (size_t kind = 0; kind < fields.size(); ++kind) {
        Scene scene = swarm(leaf(150, 1), 70, solverOf(kind));
        scene.gravity = down;
        scene.fields = {fields[kind]};
        groupOf(scene).drag = {3, 0.8};
        setStableSubsteps(scene);
        out.push_back({"field " + std::to_string(kind), std::move(scene)});
    }
}

void addPins(std::vector<FeatureScene>& out) {
    for (const SolverKind solver : solversHere()) {
        Scene held = swarm(shippedMolecule("leaf"), 45, solver);
        held.gravity = down;
        held.fields = everyField();
        groupOf(held).drag = {9, 0.9};
        setStableSubsteps(held);
        out.push_back({concat("pins hold, ", name(solver)), held});

        Scene byForce = held;
        groupOf(byForce).count = 257;
        groupOf(byForce).release = Release{0.02, {}, 1.0};
        out.push_back({concat("pins let go by force, ", name(solver)), std::move(byForce)});

        Scene byRate = held;
        groupOf(byRate).count = 257;
        groupOf(byRate).release = Release{{}, 1.0, 0};
        out.push_back({concat("pins let go by rate, ", name(solver)), byRate});

        // what flies apart is far from its anchor, where formulas that round otherwise differ by more
        if (solver == SolverKind::verlet || shoal::solver(solver).rungeKutta()) continue;
        groupOf(byRate).molecule.springs.clear();  // nothing pulls: only the rate releases them
        // All are held: what flew metres off beside a pin would be rounded by 1e-5 of a leaf.
        for (Vertex& vertex : groupOf(byRate).molecule.vertices)
            vertex.pinned = true;
        out.push_back({concat("pins without springs let go, ", name(solver)), std::move(byRate)});
    }
}

// To and fro, turning by an angle about a slanted axis.
ColliderPath swing(const glm::dvec3& way, double angle) {
    ColliderPath path;
    path.repeats = true;
    const glm::dquat turned = glm::angleAxis(angle, glm::dvec3(0.6, 0.8, 0));
    path.keyframes = {{0, {}}, {0.7, {way, turned}}, {1.3, {}}};
    return path;
}

// A floor of spheres, boxes and capsules.
std::vector<Collider> pebbles(int count) {
    std::vector<Collider> out(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(0.4 * (i % 10 - 4.5), 0.05 * (i % 4), 0.4 * (i / 10 - 4));
        Collider& one = out[size_t(i)];
        one.thickness = 0.01;
        one.restitution = 0.1 * (i % 5);
        one.shape = SphereCollider{place, 0.3};
        if (i % 3 == 1)
            one.shape = BoxCollider{place, {0.5, 0.4, 0.5}, glm::angleAxis(0.3 * i, glm::dvec3(0, 1, 0))};
        if (i % 3 == 2) one.shape = CapsuleCollider{place, place + glm::dvec3(0.2, 0.1, 0), 0.25};
    }
    return out;
}

void addContact(std::vector<FeatureScene>& out) {
    const std::vector<Collider> colliders = everyCollider();
    const auto addOn = [&](const std::string& what, const std::vector<Collider>& some, SolverKind solver) {
        Scene scene = swarm(shippedMolecule("quad"), 301, solver);
        scene.gravity = down;
        scene.colliders = some;
        groupOf(scene).drag = {2, 2};
        setStableSubsteps(scene);
        out.push_back({concat(what, ", ", name(solver)), std::move(scene)});
    };
    // Each kind alone, and all of them with each solver: a kernel that lacks one is noticed either way.
    for (size_t kind = 0; kind < colliders.size(); ++kind)
        addOn(concat("contact ", kind), {colliders[kind]}, solverOf(kind));
    for (const SolverKind solver : solversHere()) {
        addOn("contact with every kind", colliders, solver);
        Scene moving = swarm(shippedMolecule("quad"), 130, solver);
        moving.gravity = down;
        moving.colliders = {colliders[0], colliders[4], colliders[1]};
        moving.colliders[0].path = swing({0.3, 0.1, 0}, 0);
        moving.colliders[1].path = swing({0.4, 0.2, -0.1}, 0.8);
        groupOf(moving).drag = {2, 2};
        setStableSubsteps(moving);
        out.push_back({concat("moving colliders, ", name(solver)), std::move(moving)});

        Scene many = swarm(shippedMolecule("fish"), 40, solver);  // more vertices than contacts at once
        many.gravity = down;
        many.colliders = {colliders[0], colliders[2]};
        groupOf(many).drag = {2, 0.5};
        setStableSubsteps(many);
        out.push_back({concat("contact of 24 vertices, ", name(solver)), std::move(many)});
    }
    // More than uniforms hold; how they are stored is the same for all solvers.
    for (const SolverKind solver : {SolverKind::leapfrog, SolverKind::rk4}) {
        Scene table = swarm(shippedMolecule("quad"), 130, solver);
        table.gravity = down;
        table.colliders = pebbles(90);
        groupOf(table).drag = {2, 2};
        setStableSubsteps(table);
        out.push_back({concat("many colliders, ", name(solver)), std::move(table)});
    }
}

void addShapes(std::vector<FeatureScene>& out) {
    for (const SolverKind solver : solversHere()) {
        Molecule swimmer = shippedMolecule("fish");
        addMuscles(swimmer, 0.2);
        // over 1,024, where a row of a texture ends; points below are so for every solver
        Scene fish = swarm(swimmer, solver == SolverKind::leapfrog ? 1030 : 130, solver);
        groupOf(fish).drag = {4, 0.5};
        groupOf(fish).phaseSpread = 6;
        setStableSubsteps(fish);
        out.push_back({concat("muscles, ", name(solver)), std::move(fish)});

        Molecule bare = leaf(150, 1);
        bare.springs.clear();
        Scene springless = swarm(bare, 97, solver);
        springless.gravity = down;
        springless.fields = {everyField()[1]};
        groupOf(springless).drag = {3, 1};
        out.push_back({concat("no springs, ", name(solver)), std::move(springless)});

        Scene chain = swarm(pair(1, 0.5, 80, 0), 33, solver);  // no damping, no triangles
        chain.fields = {everyField()[3]};
        groupOf(chain).drag = {0.5, 0.5};
        setStableSubsteps(chain);
        out.push_back({concat("no triangles, ", name(solver)), std::move(chain)});

        Scene points = swarm(point(0.3), 1025, solver);
        points.gravity = down;
        points.fields = {everyField()[4]};
        points.colliders = everyCollider();
        groupOf(points).drag = {1, 1};
        out.push_back({concat("one vertex, ", name(solver)), std::move(points)});

        Scene far = swarm(leaf(150, 1), 65, solver, {1e5, 2, -1e5});
        far.gravity = down;
        far.fields = {field(UniformField{{2, 0.5, 1}}), field(shear())};
        std::get<ShearField>(*far.fields[1].shape).origin = {1e5, 0, -1e5};
        far.colliders = {everyCollider()[0]};
        groupOf(far).drag = {3, 0.8};
        groupOf(far).velocity = {20, 0, 5};
        setStableSubsteps(far);
        out.push_back({concat("far away, ", name(solver)), std::move(far)});
    }
    Scene two = swarm(sheet(3, 3, true), 40, SolverKind::leapfrog);
    two.groups.push_back(swarm(leaf(150, 1), 31, SolverKind::leapfrog).groups[0]);
    two.gravity = down;
    two.fields = everyField();
    two.colliders = {everyCollider()[1], everyCollider()[3]};
    for (Group& group : two.groups)
        group.drag = {3, 0.8};
    two.groups[1].stiffness = 1.5, two.groups[1].damping = 0.5;
    setStableSubsteps(two);
    out.push_back({"two groups", std::move(two)});
}

}  // namespace

Molecule sheet(int columns, int rows, bool pinned) {
    Molecule out;
    out.name = concat("sheet of ", columns, " x ", rows);
    const double gap = 1.0 / (std::max(columns, rows) - 1);
    for (int z = 0; z < rows; ++z)
        for (int x = 0; x < columns; ++x)
            out.vertices.push_back(
                {.position = {gap * x, 0.1 * std::sin(2.0 * gap * x + gap * z), gap * z}, .mass = 0.05});
    const auto at = [columns](int x, int z) { return z * columns + x; };
    const auto spring = [&](int x, int z, int dx, int dz) {
        if (x + dx < 0 || x + dx >= columns || z + dz >= rows) return;
        Spring one{at(x, z), at(x + dx, z + dz), 40, 0.05, {}, {}};
        if (out.springs.size() % 5 == 0) one.actuation = Actuation{0.05, 1.3, 0.2 * x};
        out.springs.push_back(one);
    };
    for (int z = 0; z < rows; ++z) {
        for (int x = 0; x < columns; ++x) {
            for (const glm::ivec2 d : {glm::ivec2(1, 0), {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}})
                spring(x, z, d.x, d.y);
            if (x + 1 == columns || z + 1 == rows) continue;
            out.triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
            out.triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
        }
    }
    out.vertices[0].pinned = pinned;
    return out;
}

Molecule shippedMolecule(const std::string& name) {
    return readMolecule(concat(sourceFolder, "molecules/", name, ".json"));
}

void addMuscles(Molecule& molecule, double amplitude) {
    for (Spring& spring : molecule.springs)
        spring.actuation =
            Actuation{amplitude, 1.5, 3 * molecule.vertices[size_t(spring.a)].position.x / molecule.size()};
}

Scene swarm(const Molecule& molecule, int count, SolverKind solver, const glm::dvec3& middle) {
    Scene scene;
    scene.name = molecule.name;
    scene.solver.kind = solver;
    Group group;
    group.name = molecule.name;
    group.molecule = molecule;
    group.count = count;
    group.place.kind = Placement::Kind::volume;
    group.place.box = {middle - 2.0, middle + 2.0};
    group.place.turn = Placement::Turn::any;
    group.place.scale = {0.5, 1.5};
    scene.groups.push_back(std::move(group));
    return scene;
}

void setStableSubsteps(Scene& scene) {
    scene.solver.substeps = maxSubsteps;
    scene.solver.substeps = 1 + substepsNeeded(compile(scene), 1 / scene.frameRate, 1, 1, 1, 3);
}

HeightFieldCollider rolling(bool sampledNormals) {
    HeightFieldCollider out;
    out.columns = 33, out.rows = 25;
    out.low = {-2, -2}, out.high = {2, 2};
    out.sampledNormals = sampledNormals;
    for (int z = 0; z < out.rows; ++z)
        for (int x = 0; x < out.columns; ++x)
            out.heights.push_back(float(0.4 + 0.2 * std::sin(0.4 * x) * std::cos(0.5 * z)));
    return out;
}

std::vector<Collider> everyCollider() {
    std::vector<Collider> out(6);
    std::set<size_t> kinds;
    out[0].shape = PlaneCollider{};
    SphereCollider sphere;
    sphere.center = {0.4, 0.5, -0.3};
    sphere.radius = 0.8;
    out[1].shape = sphere;
    out[2].shape = rolling(false);
    out[3].shape = rolling(true);
    out[4].shape =
        BoxCollider{{0.2, 0.3, 0.1}, {1.6, 0.7, 1.1}, glm::angleAxis(0.4, glm::dvec3(0.6, 0, 0.8))};
    out[5].shape = CapsuleCollider{{-0.9, 0.3, 0.2}, {0.8, 0.6, -0.3}, 0.35};
    for (const Collider& collider : out)
        kinds.insert(collider.shape->index());
    for (const KindOfCollider& kind : kindsOfCollider())
        if (kinds.insert(kind.shape.index()).second) out.emplace_back().shape = kind.shape;
    for (Collider& collider : out)
        collider.thickness = 0.01;
    return out;
}

namespace {

// Reading them all takes seconds, of which their models are most.
const std::vector<Scene>& everyShippedScene() {
    static const std::vector<Scene> scenes = [] {
        std::vector<std::string> files;
        const std::string folder = concat(sourceFolder, "models");
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.path().string().ends_with(".scene.json")) files.push_back(entry.path().string());
        std::sort(files.begin(), files.end());
        std::vector<Scene> out;
        for (const std::string& file : files)
            out.push_back(readScene(file));
        return out;
    }();
    return scenes;
}

}  // namespace

std::vector<FeatureScene> shippedScenes(int mostMolecules, bool fusedOnly) {
    std::vector<FeatureScene> out;
    for (const Scene& shipped : everyShippedScene()) {
        if (std::any_of(shipped.groups.begin(), shipped.groups.end(),
                        [](const Group& g) { return g.contact || g.life || g.school; }) != fusedOnly)
            continue;
        Scene scene = shipped;
        for (Group& group : scene.groups) {
            group.count = std::min(group.count, mostMolecules);
            if (group.life) group.life->capacity = std::min(group.life->capacity, 4 * mostMolecules);
        }
        out.push_back({scene.name, std::move(scene)});
    }
    return out;
}

std::vector<FeatureScene> featureScenes() {
    std::vector<FeatureScene> out;
    addFields(out);
    addPins(out);
    addContact(out);
    addShapes(out);
    return out;
}

}  // namespace shoal::test
