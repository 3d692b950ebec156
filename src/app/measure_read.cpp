#include "app/measure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace shoal::app {

using namespace measure;

namespace {

// A member that must be there.
const JsonValue& member(const JsonValue& object, const char* key) {
    const JsonValue* found = object.find(key);
    if (found == nullptr) throw Error(concat("\"", key, "\" is missing"));
    return *found;
}

Method methodOf(const JsonValue& value) {
    return {solverOf(member(value, "solver").text).value_or(SolverKind::leapfrog),
            samplingOf(member(value, "fieldSampling").text)};
}

AccuracyPoint pointOf(const JsonValue& value) {
    AccuracyPoint out;
    out.method = methodOf(value);
    out.step = {int(member(value, "substeps").number), int(member(value, "framesPerFrame").number)};
    out.stepsPerSecond = member(value, "stepsPerSecond").number;
    for (const Outcome outcome : {Outcome::measured, Outcome::refused, Outcome::notFinite, Outcome::leftOut})
        if (member(value, "outcome").text == name(outcome)) out.outcome = outcome;
    if (out.outcome != Outcome::measured) return out;
    const JsonValue& error = member(value, "error");
    if (error.kind == JsonValue::Kind::object)
        out.error = ErrorParts{member(error, "total").number, member(error, "centroid").number,
                               member(error, "shape").number, member(error, "worst").number};
    out.time = {member(value, "minSecondsPerVertexAndSecond").number,
                member(value, "medianSecondsPerVertexAndSecond").number,
                int(member(value, "samples").number)};
    out.front = member(value, "front").boolean;
    return out;
}

ReportEntry entryOf(const JsonValue& value) {
    ReportEntry out;
    out.accuracy.scene = member(value, "scene").text;
    out.accuracy.seconds = member(value, "seconds").number;
    out.accuracy.chaotic = member(value, "chaotic").text;
    if (const JsonValue* tooStiff = value.find("tooStiff")) out.accuracy.tooStiff = tooStiff->text;
    for (const JsonValue& point : member(value, "points").items)
        out.accuracy.points.push_back(pointOf(point));
    const JsonValue& chosen = member(value, "chosen");
    if (chosen.kind != JsonValue::Kind::object) return out;
    out.chosen.emplace();
    out.chosen->target = member(chosen, "target").number;
    out.chosen->method = methodOf(chosen);
    out.chosen->substeps = int(member(chosen, "substeps").number);
    out.chosen->error = member(chosen, "error").number;
    return out;
}

MeasuredWith withOf(const JsonValue& value) {
    const JsonValue &machine = member(value, "machine"), &context = member(value, "context");
    MeasuredWith out;
    out.processor = member(machine, "processor").text;
    out.cores = int(member(machine, "cores").number);
    out.renderer = member(context, "renderer").text;
    out.context = member(context, "kind").text;
    out.opengl = member(context, "version").text;
    out.path = member(value, "path").text;
    out.scene = member(value, "scene").text;
    out.frameRate = member(value, "frameRate").number;
    out.duration = member(value, "duration").number;
    out.target = member(value, "target").number;
    for (const JsonValue& group : member(value, "groups").items) {
        out.molecules.emplace_back(member(group, "measuredMolecules").number,
                                   member(group, "timedMolecules").number);
        out.shapes.emplace_back(member(group, "vertices").number, member(group, "springs").number);
    }
    for (const JsonValue& point : member(value, "points").items) {
        out.solvers.insert(member(point, "solver").text);
        out.samplings.insert(member(point, "fieldSampling").text);
    }
    return out;
}

bool alike(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b));
}

}  // namespace

std::string difference(const MeasuredWith& found, const MeasuredWith& wanted) {
    const std::pair<const char*, bool> same[] = {
        {"the processor", found.processor == wanted.processor && found.cores == wanted.cores},
        {"the renderer", found.renderer == wanted.renderer && found.context == wanted.context &&
                             found.opengl == wanted.opengl},
        {"the path", wanted.path.empty() || found.path == wanted.path},
        {"the scene", found.scene == wanted.scene && found.shapes == wanted.shapes &&
                          alike(found.frameRate, wanted.frameRate)},
        {"the duration", alike(found.duration, wanted.duration)},
        {"the number of molecules", found.molecules == wanted.molecules},
        {"the error wanted", alike(found.target, wanted.target)},
        {"the solvers", found.solvers == wanted.solvers},
        {"the field samplings", found.samplings == wanted.samplings}};
    for (const auto& [what, agrees] : same)
        if (!agrees) return what;
    return {};
}

std::optional<Measured> readMeasured(const std::string& file) {
    std::error_code none;
    if (!std::filesystem::exists(file, none)) return std::nullopt;
    try {
        const JsonValue value = readJson(file);
        if (member(value, "version").text != SHOAL_VERSION) return std::nullopt;
        return Measured{entryOf(value), withOf(value)};
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace shoal::app
