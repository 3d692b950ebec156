#include <iostream>

#include "app/commands.h"
#include "core/json.h"
#include "molecule/analysis.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "scene/scene_file.h"

namespace shoal::app {

namespace {

struct Verdict {
    std::string kind;  // "molecule" or "scene"
    std::vector<Warning> warnings;
    JsonValue facts = JsonValue::makeObject();
    std::string summary;
};

// The format key decides; a file without one is refused by the reader of its likely kind.
bool isScene(const std::string& file) {
    const JsonValue json = readJson(file);
    const JsonValue* format = json.find("format");
    return format ? format->text.rfind("shoal-scene", 0) == 0 : json.find("groups") != nullptr;
}

Verdict checkMolecule(const std::string& file) {
    const Molecule molecule = readMolecule(file);
    const Analysis free = analyse(molecule, false);
    Verdict out;
    out.kind = "molecule";
    out.warnings = check(molecule);
    out.facts.add("name", JsonValue::makeString(molecule.name))
        .add("vertices", JsonValue::makeNumber(double(molecule.vertices.size())))
        .add("springs", JsonValue::makeNumber(double(molecule.springs.size())))
        .add("triangles", JsonValue::makeNumber(double(molecule.triangles.size())))
        .add("totalMass", JsonValue::makeNumber(free.totalMass))
        .add("restEnergy", JsonValue::makeNumber(free.restEnergy))
        .add("zeroModes", JsonValue::makeNumber(free.zeroModes))
        .add("lowestFrequency", JsonValue::makeNumber(free.lowestFrequency))
        .add("highestFrequency", JsonValue::makeNumber(free.highestFrequency));
    out.summary = concat("molecule \"", molecule.name, "\": ", molecule.vertices.size(), " vertices, ",
                         molecule.springs.size(), " springs, ", molecule.triangles.size(), " triangles, mass ",
                         free.totalMass, " kg, rest energy ", free.restEnergy, " J");
    if (molecule.springs.empty()) return out;
    out.summary += concat("\n  frequencies ", free.lowestFrequency, " to ", free.highestFrequency, " rad/s, ",
                          free.zeroModes, " zero-stiffness modes\n  stable steps: euler ", free.stableStepEuler,
                          " s, leapfrog ", free.stableStepLeapfrog, " s");
    out.facts.add("stableStepEuler", JsonValue::makeNumber(free.stableStepEuler))
        .add("stableStepLeapfrog", JsonValue::makeNumber(free.stableStepLeapfrog));
    return out;
}

Verdict checkScene(const std::string& file) {
    const Scene scene = readScene(file);
    const Plan plan = compile(scene);
    Verdict out;
    out.kind = "scene";
    out.warnings = plan.warnings;
    for (const Group& group : scene.groups)
        for (const Warning& warning : check(group.molecule)) out.warnings.push_back(warning);
    int molecules = 0;
    for (const GroupPlan& group : plan.groups) molecules += group.count;
    out.facts.add("name", JsonValue::makeString(scene.name))
        .add("groups", JsonValue::makeNumber(double(plan.groups.size())))
        .add("molecules", JsonValue::makeNumber(molecules));
    out.summary = concat("scene \"", scene.name, "\": ", plan.groups.size(), " groups, ", molecules, " molecules, ",
                         scene.fields.size(), " fields, ", scene.colliders.size(), " colliders");
    return out;
}

}  // namespace

int checkCommand(const Options& options) {
    JsonValue report = JsonValue::makeArray();
    bool failed = false;
    for (const std::string& file : options.files) {
        JsonValue entry = JsonValue::makeObject();
        entry.add("file", JsonValue::makeString(file));
        try {
            Verdict verdict = isScene(file) ? checkScene(file) : checkMolecule(file);
            JsonValue warnings = JsonValue::makeArray();
            for (const Warning& warning : verdict.warnings) warnings.items.push_back(JsonValue::makeString(text(warning)));
            entry.add("ok", JsonValue::makeBoolean(true))
                .add("kind", JsonValue::makeString(verdict.kind))
                .add("warnings", std::move(warnings))
                .add(verdict.kind, std::move(verdict.facts));
            if (!options.json) {
                std::cout << file << ": " << verdict.summary << "\n";
                for (const Warning& warning : verdict.warnings) std::cout << "  warning: " << text(warning) << "\n";
            }
        } catch (const Error& error) {
            failed = true;
            entry.add("ok", JsonValue::makeBoolean(false)).add("error", JsonValue::makeString(error.what()));
            if (!options.json) std::cerr << "shoal: " << error.what() << "\n";
        }
        report.items.push_back(std::move(entry));
    }
    if (options.json) std::cout << writeJson(report);
    return failed ? 1 : 0;
}

}  // namespace shoal::app
