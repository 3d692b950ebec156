#include "bench/case.h"

#include <cmath>

#include "core/contract.h"
#include "core/error.h"
#include "measure/method_runner.h"
#include "molecule/molecule_file.h"
#include "scene/field_kinds.h"
#include "scene/known_colliders.h"

namespace shoal::bench {

namespace {

void add(std::vector<BenchCase>& out, BenchCase benchCase, const std::string& label) {
    benchCase.label = label;
    out.push_back(std::move(benchCase));
}

void addBaselines(std::vector<BenchCase>& out, BenchCase benchCase) {
    for (const Subject subject : {Subject::avx512, Subject::avx2, Subject::scalar}) {
        benchCase.subject = subject;
        add(out, benchCase, name(subject));
    }
}

BenchCase grouped(const char* molecule, const char* many, int count) {
    BenchCase out;
    out.group = bench::grouped(count) + " " + many;
    out.molecule = molecule;
    out.count = count;
    return out;
}

// One size of one molecule on everything that can run it.
void addSize(std::vector<BenchCase>& out, const BenchCase& base, bool pictures) {
    BenchCase benchCase = base;
    add(out, benchCase, "fused");
    benchCase.inPlace = true;
    add(out, benchCase, "fused, in place");
    benchCase = base;
    for (const Subject subject : {Subject::fragments, Subject::pingPong}) {
        benchCase.subject = subject;
        add(out, benchCase, name(subject));
    }
    addBaselines(out, base);
    benchCase = base;
    benchCase.drawn = pictures;
    if (pictures) {
        for (const Subject subject : {Subject::fused, Subject::fragments, Subject::pingPong}) {
            benchCase.subject = subject;
            add(out, benchCase, concat(name(subject), ", drawn"));
        }
    }
    benchCase = base;
    for (const Subject subject : {Subject::bufferCopy, Subject::kernelCopy, Subject::memoryCopy}) {
        benchCase.subject = subject;
        add(out, benchCase, name(subject));
    }
}

void addLeapfrog(std::vector<BenchCase>& out, const BenchCase& base) {
    BenchCase benchCase = base;
    benchCase.solver = SolverKind::leapfrog;
    for (const Subject subject : {Subject::fused, Subject::fragments, Subject::pingPong}) {
        benchCase.subject = subject;
        add(out, benchCase, concat(name(subject), ", leapfrog"));
    }
}

void addManySubsteps(std::vector<BenchCase>& out, const BenchCase& base) {
    BenchCase benchCase = base;
    benchCase.substeps = 16;
    for (const Subject subject : {Subject::fused, Subject::avx512, Subject::avx2}) {
        benchCase.subject = subject;
        add(out, benchCase, std::string(name(subject)) + ", 16 substeps");
    }
    benchCase = base;
    benchCase.subject = Subject::multiplyAdd;
    add(out, benchCase, name(benchCase.subject));
}

void addSamplings(std::vector<BenchCase>& out, int count) {
    BenchCase benchCase = grouped("quad", "quads in wind", count);
    for (const Wind wind : {Wind::uniform, Wind::gusts}) {
        benchCase.wind = wind;
        const std::string what = name(wind);
        benchCase.subject = Subject::fused;
        for (const FieldSampling sampling : measure::allSamplings) {
            benchCase.sampling = sampling;
            add(out, benchCase, "fused, " + what + ", " + shoal::name(sampling));
        }
        benchCase.sampling = FieldSampling::vertexSubstep;
        benchCase.subject = Subject::pingPong;
        add(out, benchCase, "ping-pong, " + what + ", " + shoal::name(benchCase.sampling));
    }
    benchCase.solver = SolverKind::leapfrog;
    benchCase.subject = Subject::fused;
    for (const FieldSampling sampling : measure::allSamplings) {
        benchCase.sampling = sampling;
        add(out, benchCase, std::string("fused, leapfrog, gusts, ") + shoal::name(sampling));
    }
}

// Large molecules: how a molecule is spread over the device.
void addLanes(std::vector<BenchCase>& out, const char* molecule, const char* many, int count) {
    BenchCase benchCase = grouped(molecule, many, count);
    for (const Lanes lanes : {Lanes::molecule, Lanes::vertex}) {
        benchCase.lanes = lanes;
        add(out, benchCase, std::string("fused, a lane a ") + shoal::name(lanes));
    }
    benchCase.lanes = Lanes::automatic;
    addBaselines(out, benchCase);
}

}  // namespace

const char* name(Subject subject) {
    static constexpr const char* names[] = {"fused",        "fragments",    "ping-pong",    "AVX-512",
                                            "AVX2",         "scalar",       "copy, buffer", "copy, kernel",
                                            "copy, memory", "multiply-adds"};
    return names[size_t(subject)];
}
const char* name(Wind wind) {
    return wind == Wind::uniform ? "uniform" : "gusts";
}
bool isPath(Subject subject) {
    return subject == Subject::fused || subject == Subject::fragments || subject == Subject::pingPong;
}
Path pathOf(Subject subject) {
    EXPECTS(isPath(subject));
    return subject == Subject::fused       ? Path::fused
           : subject == Subject::fragments ? Path::fragments
                                           : Path::pingPong;
}
bool isBaseline(Subject subject) {
    return subject == Subject::avx512 || subject == Subject::avx2 || subject == Subject::scalar;
}
bool isCopy(Subject subject) {
    return subject == Subject::bufferCopy || subject == Subject::kernelCopy || subject == Subject::memoryCopy;
}
bool needsCompute(Subject subject) {
    return subject == Subject::fused || subject == Subject::kernelCopy || subject == Subject::multiplyAdd;
}
bool isOnDevice(Subject subject) {
    return isPath(subject) || subject == Subject::bufferCopy || subject == Subject::kernelCopy ||
           subject == Subject::multiplyAdd;
}
Simd simdOf(Subject subject) {
    EXPECTS(isBaseline(subject));
    return subject == Subject::avx512 ? Simd::avx512 : subject == Subject::avx2 ? Simd::avx2 : Simd::scalar;
}

std::string grouped(int count) {
    std::string out = std::to_string(count);
    for (int position = int(out.size()) - 3; position > 0; position -= 3)
        out.insert(size_t(position), ",");
    return out;
}

std::vector<BenchCase> benchCases(bool quick) {
    std::vector<BenchCase> out;
    addSize(out, grouped("quad", "quads", 1024), true);
    BenchCase base = grouped("quad", "quads", 16384);
    addSize(out, base, true);
    addLeapfrog(out, base);
    base = grouped("quad", "quads", 131072);
    addSize(out, base, !quick);
    if (!quick) addLeapfrog(out, base);
    if (!quick) addManySubsteps(out, base);
    base = grouped("quad", "quads", 1048576);
    if (!quick) addSize(out, base, true);
    if (!quick) addManySubsteps(out, base);
    addSize(out, grouped("cross", "crosses", 16384), !quick);
    addSize(out, grouped("fish", "fish", 16384), !quick);
    if (quick) return out;
    addSamplings(out, 16384);
    addLanes(out, "fish", "fish in lanes", 4096);
    addLanes(out, "cloth", "cloths of 64 vertices in lanes", 1024);
    return out;
}

BenchMolecules::BenchMolecules(const std::string& folder)
    : quad(readMolecule(folder + "/quad.json")),
      cross(readMolecule(folder + "/cross.json")),
      fish(readMolecule(folder + "/fish.json")),
      cloth(bench::cloth(8)) {}

const Molecule& BenchMolecules::named(const std::string& name) const {
    if (name == "quad") return quad;
    if (name == "cross") return cross;
    if (name == "fish") return fish;
    EXPECTS(name == "cloth");
    return cloth;
}

Molecule cloth(int side) {
    Molecule out;
    out.name = "cloth";
    const auto vertexAt = [side](int row, int column) { return row * side + column; };
    const auto spring = [&](int a, int b) {
        Spring added;
        added.a = a;
        added.b = b;
        added.stiffness = 10;
        added.damping = 0.002;
        out.springs.push_back(added);
    };
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            Vertex vertex;
            vertex.position = glm::dvec3(column, 0, row) * 0.05;
            vertex.mass = 0.01;
            out.vertices.push_back(vertex);
            const bool right = column + 1 < side, down = row + 1 < side;
            if (right) spring(vertexAt(row, column), vertexAt(row, column + 1));
            if (down) spring(vertexAt(row, column), vertexAt(row + 1, column));
            if (!right || !down) continue;
            spring(vertexAt(row, column), vertexAt(row + 1, column + 1));
            spring(vertexAt(row, column + 1), vertexAt(row + 1, column));
            out.triangles.push_back(
                {vertexAt(row, column), vertexAt(row + 1, column), vertexAt(row, column + 1)});
            out.triangles.push_back(
                {vertexAt(row, column + 1), vertexAt(row + 1, column), vertexAt(row + 1, column + 1)});
        }
    }
    return out;
}

Scene benchScene(const BenchCase& benchCase, const Molecule& molecule) {
    Scene scene;
    scene.name = benchCase.name();
    scene.gravity = {0, -9.81, 0};
    scene.solver.kind = benchCase.solver;
    scene.solver.substeps = benchCase.substeps;
    scene.solver.fieldSampling = benchCase.sampling;
    if (benchCase.wind == Wind::uniform) {
        scene.fields.emplace_back().shape = UniformField{{2, 0, 0.5}};
    } else {
        GustField gust;
        gust.direction = {2, 0, 0.5};
        gust.speed = 2;
        scene.fields.emplace_back().shape = gust;
        CurlNoiseField noise;
        noise.octaves = 2;
        scene.fields.emplace_back().shape = noise;
    }
    scene.colliders.emplace_back();  // a plane, y = 0
    Group group;
    group.name = benchCase.molecule;
    group.molecule = molecule;
    group.count = benchCase.count;
    group.place.box = {{-20, 0.2, -20}, {20, 6, 20}};
    group.place.turn = Placement::Turn::any;
    group.drag = {1, 1};
    scene.groups.push_back(group);
    scene.camera.eye = {0, 8, 34};
    scene.camera.target = {0, 2, 0};
    return scene;
}

BaselineStep baselineStep(const Scene& scene) {
    const double h = 1 / scene.frameRate / scene.solver.substeps;
    const double gamma = scene.groups[0].drag.tangent;
    const Collider& ground = scene.colliders[0];
    const auto& plane = *kindOf<PlaneCollider>(*ground.shape);
    BaselineStep out;
    out.h = float(h);
    out.substeps = scene.solver.substeps;
    out.gravity = scene.gravity;
    out.wind = std::get<UniformField>(*scene.fields[0].shape).velocity;
    out.decay = float(-std::expm1(-gamma * h));
    out.phi = float(-std::expm1(-gamma * h) / gamma);
    out.planePoint = plane.point;
    out.planeNormal = glm::normalize(plane.normal);
    out.restitution = float(ground.restitution);
    out.friction = float(ground.friction);
    out.thickness = float(ground.thickness);
    return out;
}

}  // namespace shoal::bench
