// `shoal molecule from-mesh` and `new`: makes a molecule, says what it made, and writes it.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "app/line/commands.h"
#include "app/molecule/molecule_report.h"
#include "author/shapes.h"
#include "core/error.h"
#include "core/file.h"
#include "core/image.h"
#include "core/json_build.h"
#include "core/printable.h"
#include "geometry/mesh.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"

namespace shoal::app {

namespace {

namespace fs = std::filesystem;

struct Report {
    std::string file, output;
    size_t sourceTriangles = 0, sourceVertices = 0;
    MadeMolecule made;
    Analysis analysis;
    std::vector<Warning> warnings;
    std::optional<Trial> trial;  // of what is written
    double seconds = 0;
};

// Before any work is done for nothing.
void checkOutput(const MoleculeOptions& options) {
    if (options.output.empty()) return;
    const Location where{options.output, 0, 0, {}};
    std::error_code code;
    if (fs::is_directory(options.output, code))
        throw Error(where, "is a folder, expected the name of a file");
    if (fs::exists(options.output, code) && !options.force)
        throw Error(where, "is there already: give --force to write over it");
}

MadeMolecule make(const std::string& file, const Mesh& mesh, const MoleculeOptions& options) {
    MadeMolecule made;
    FromMesh asked = options.fromMesh;
    asked.images = options.texture.empty() && options.color.empty();
    try {
        made = makeMolecule(mesh, asked);
    } catch (const Error& error) {
        throw Error(Location{file, 0, 0, {}}, error.message());
    }
    Material& material = made.molecule.material;
    material.texture = options.texture;
    if (!options.color.empty())
        material.color = parsePaint(options.color);
    else if (!options.texture.empty())
        material.color = glm::dvec3(1);
    if (!options.texture.empty() && !options.output.empty())
        readPng(fs::path(options.output).parent_path() / options.texture);
    return made;
}

// The image of the skin's colours, beside the molecule's file.
void writeImage(const MoleculeOptions& options, MadeMolecule& made) {
    if (!made.image) return;
    const fs::path file = fs::path(options.output).replace_extension(".png");
    std::error_code code;
    if (fs::exists(file, code) && !options.force)
        throw Error(Location{file.string(), 0, 0, {}},
                    "is there already, and would hold the skin's colours: give --force to write over it, or "
                    "--texture to use it");
    writePng(file, *made.image);
    made.molecule.material.texture = file.filename().string();
}

double round3(double value) {
    if (value == 0 || !std::isfinite(value)) return value;
    const double power = std::pow(10, 2 - std::floor(std::log10(std::abs(value))));
    return std::round(value * power) / power;
}

// Runs what the written file would say, so that anything lost in writing would show, and writes it.
Trial write(const Options& options, MadeMolecule& made) {
    const std::string& file = options.molecule.output;
    const std::string text = writeMolecule(made.molecule);
    Trial trial;
    try {
        made.molecule = parseMolecule(text, {});  // of no file yet
        trial = tryOut(made.molecule, options);
    } catch (const Error& error) {
        throw Error(Location{file, 0, 0, {}},
                    "is not written, because the molecule does not run: ", error.message(),
                    error.location().path.empty() ? "" : concat(" (at ", error.location().path, ")"));
    }
    writeImage(options.molecule, made);
    writeFile(file, made.image ? writeMolecule(made.molecule) : text);
    return trial;
}

std::string asText(const Trial& trial) {
    if (!trial.untried.empty()) return concat("it was not tried out: ", printable(trial.untried));
    return concat("two seconds above a floor: ", trial.solver, " with ",
                  many(int64_t(trial.substeps), "substep", "substeps"),
                  " a frame; its springs change by at most ", round3(100 * trial.change),
                  " %, and at the end it moves at ", round3(trial.speed), " m/s",
                  trial.substeps > SolverSettings().substeps
                      ? concat("; a scene says \"solver\": {\"substeps\": ", trial.substeps, "}")
                      : "");
}

std::string asText(const StandsFor& beam) {
    const BeamMaterial& material = beam.material;
    std::string out = concat(
        material.thickness > 0 ? concat("a sheet of ", round3(1000 * material.thickness), " mm") : "a body",
        ", E = ", round3(material.modulus / 1e6), " MPa, ", round3(material.density),
        " kg/m^3: free, its first frequency is ", round3(beam.free.molecule), " Hz, the beam's ",
        round3(beam.free.beam));
    if (!beam.clamped) return out;
    const Likeness &sag = beam.clamped->sag, &first = beam.clamped->frequencies.front();
    constexpr double small =
        0.2;  // of the length; beyond, a sag to first order is no length that can be seen
    out += concat("; held by its pins, with ", round3(1000 * beam.reach), " mm free, ");
    out += sag.beam < small * beam.reach
               ? concat("it sags by ", round3(1000 * sag.molecule), " mm under its weight, the beam by ",
                        round3(1000 * sag.beam))
               : concat("it sags by ", round3(100 * sag.molecule / sag.beam), " % of what the beam does");
    return concat(out, ", and its first frequency is ", round3(first.molecule), " Hz, the beam's ",
                  round3(first.beam));
}

constexpr double frameSeconds = 1.0 / 60;  // s

int substeps(const Report& report) {
    return int(std::max(1.0, std::ceil(frameSeconds / report.analysis.stableStepLeapfrog)));
}

std::string asText(const Report& r) {
    const MadeMolecule& made = r.made;
    const Molecule& molecule = made.molecule;
    std::string out = concat(printable(r.file), ": ", many(r.sourceVertices, "vertex", "vertices"), ", ",
                             many(r.sourceTriangles, "triangle", "triangles"), ", ", round3(made.extent.x),
                             " x ", round3(made.extent.y), " x ", round3(made.extent.z), " m, ",
                             made.solid ? concat("a volume of ", round3(made.volume), " m^3")
                                        : concat("a sheet of ", round3(made.area), " m^2"));
    size_t pinned = 0;
    for (const Vertex& vertex : molecule.vertices)
        pinned += vertex.pinned ? 1 : 0;
    out += concat("\nmolecule \"", printable(molecule.name),
                  "\": ", many(molecule.vertices.size(), "vertex", "vertices"),
                  pinned > 0 ? concat(" (", pinned, " pinned)") : "", ", ",
                  many(molecule.triangles.size(), "triangle", "triangles"), ", ", made.material, ", ",
                  round3(r.analysis.totalMass), " kg");
    out += concat("\n  ", many(molecule.springs.size(), "spring", "springs"), ": ", made.edges, " edges, ",
                  made.shears, " shear, ", made.bends, " bending, ", made.braces, " through the inside, ",
                  made.repairs, " repairs");
    if (made.beam) out += "\n  stands for " + asText(*made.beam);
    const double highest = hertz(r.analysis.highestFrequency);
    out += concat("\n  frequencies ", round3(made.lowestFrequency), " to ", round3(highest),
                  " Hz, damping ratio ", round3(made.dampingRatio), " to ",
                  round3(made.dampingRatio * highest / made.lowestFrequency), ", ",
                  many(int64_t(r.analysis.zeroModes), "zero-stiffness mode", "zero-stiffness modes"));
    out += concat("\n  stable step ", round3(r.analysis.stableStepLeapfrog),
                  " s (leapfrog): ", many(int64_t(substeps(r)), "substep", "substeps"), " at 60 Hz");
    if (!molecule.skin.empty())
        out += concat("\n  skin: ", many(molecule.skin.vertices.size(), "vertex", "vertices"), ", ",
                      many(molecule.skin.triangles.size(), "triangle", "triangles"), ", at rest within ",
                      round3(made.skinError / molecule.size()), " of its size, all of it within ",
                      round3(made.skinReach / glm::length(made.extent)), " of a simulated vertex",
                      made.image ? concat(", coloured by an image of ", made.image->width, " x ",
                                          made.image->height, " texels")
                                 : "");
    out += "\n";
    for (const std::string& note : made.notes)
        out += "  note: " + printable(note) + "\n";
    for (const Warning& warning : r.warnings)
        out += "  warning: " + text(warning) + "\n";
    if (r.trial) out += "  " + asText(*r.trial) + "\n";
    out += concat(
        r.output.empty() ? std::string("not written (give -o FILE.json)") : "wrote " + printable(r.output),
        ", ", round3(r.seconds), " s\n");
    return out;
}

JsonValue asJson(const Warning& warning) {
    return toJson(text(warning));
}

JsonValue asJson(const Likeness& figure) {
    return object(key("molecule", figure.molecule), key("beam", figure.beam));
}

JsonValue asJson(const StandsFor& beam) {
    JsonValue out = object(key("modulus", beam.material.modulus), key("density", beam.material.density));
    if (beam.material.thickness > 0) append(out, key("thickness", beam.material.thickness));
    append(out, key("free", asJson(beam.free)));
    if (!beam.clamped) return out;
    append(out, key("reach", beam.reach));
    append(out, key("sag", asJson(beam.clamped->sag)));
    append(out, key("clamped", asJson(beam.clamped->frequencies.front())));
    return out;
}

JsonValue asJson(const Report& r) {
    const MadeMolecule& made = r.made;
    const Molecule& molecule = made.molecule;
    const JsonValue springs =
        object(key("edge", made.edges), key("shear", made.shears), key("bending", made.bends),
               key("brace", made.braces), key("repair", made.repairs));
    JsonValue out = object(
        key("file", r.file), key("output", r.output), key("sourceVertices", r.sourceVertices),
        key("sourceTriangles", r.sourceTriangles), key("solid", made.solid), key("area", made.area),
        key("volume", made.volume), key("extent", made.extent), key("vertices", molecule.vertices.size()),
        key("triangles", molecule.triangles.size()), key("springs", springs), key("material", made.material),
        key("totalMass", r.analysis.totalMass), key("lowestFrequency", made.lowestFrequency),
        key("highestFrequency", hertz(r.analysis.highestFrequency)), key("dampingRatio", made.dampingRatio),
        key("zeroModes", r.analysis.zeroModes), key("rigidModes", r.analysis.rigidModes),
        key("stableStepLeapfrog", r.analysis.stableStepLeapfrog), key("substepsAt60Hz", substeps(r)),
        key("skinVertices", molecule.skin.vertices.size()),
        key("skinTriangles", molecule.skin.triangles.size()),
        key("skinError", made.skinError / molecule.size()),
        key("skinReach", made.skinReach / glm::length(made.extent)), key("skinLever", made.skinLever),
        key("notes", made.notes), key("warnings", arrayOf(r.warnings, asJson)), key("seconds", r.seconds));
    if (made.beam) append(out, key("standsFor", asJson(*made.beam)));
    if (r.trial && r.trial->untried.empty())
        append(out, key("trial", object(key("solver", r.trial->solver), key("substeps", r.trial->substeps),
                                        key("change", r.trial->change), key("speed", r.trial->speed))));
    return out;
}

}  // namespace

static int makeOf(const std::string& what, const Mesh& mesh, const Options& options,
                  std::chrono::steady_clock::time_point start) {
    Report report;
    report.file = what;
    report.output = options.molecule.output;
    report.sourceTriangles = mesh.triangles.size();
    report.sourceVertices = mesh.weldedPositions.size();
    report.made = make(report.file, mesh, options.molecule);
    if (!report.output.empty()) report.trial = write(options, report.made);
    report.analysis = analyse(report.made.molecule, false);
    report.warnings = check(report.made.molecule);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!options.molecule.report.empty()) writeMoleculeReport(options, report.made.molecule, asText(report));
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

int moleculeFromMeshCommand(const Options& options) {
    const auto start = std::chrono::steady_clock::now();
    checkOutput(options.molecule);
    const std::string& file = options.files.front();
    const Mesh mesh = loadMesh(file, options.lenient);
    if (mesh.triangles.empty()) throw Error(Location{file}, noTriangles);
    return makeOf(file, mesh, options, start);
}

// Every vertex of the shape is simulated, and its triangles are drawn.
int moleculeNewCommand(const Options& options) {
    const auto start = std::chrono::steady_clock::now();
    checkOutput(options.molecule);
    const Shape& shape = shapeNamed(options.molecule.shape);
    const Mesh mesh = shapeMesh(shape, options.molecule.divisions.value_or(shape.divisions));
    Options made = options;
    made.molecule.fromMesh = ofShape(shape, mesh, options.molecule.fromMesh);
    return makeOf(shape.name, mesh, made, start);
}

}  // namespace shoal::app
