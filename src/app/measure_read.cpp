#include "app/measure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace shoal::app {

using namespace measure;

namespace {

// A member that must be there.
const JsonValue& at(const JsonValue& object, const char* key) {
    const JsonValue* found = object.find(key);
    if (found == nullptr) throw Error(concat("\"", key, "\" is missing"));
    return *found;
}

Method methodOf(const JsonValue& value) {
    return {solverOf(at(value, "solver").text).value_or(SolverKind::leapfrog),
            samplingOf(at(value, "fieldSampling").text)};
}

AccuracyPoint pointOf(const JsonValue& value) {
    AccuracyPoint out;
    out.method = methodOf(value);
    out.step = {int(at(value, "substeps").number), int(at(value, "framesPerFrame").number)};
    out.stepsPerSecond = at(value, "stepsPerSecond").number;
    for (const Outcome one : {Outcome::measured, Outcome::refused, Outcome::notFinite, Outcome::leftOut})
        if (at(value, "outcome").text == name(one)) out.outcome = one;
    if (out.outcome != Outcome::measured) return out;
    const JsonValue& error = at(value, "error");
    if (error.kind == JsonValue::Kind::object)
        out.error = ErrorParts{at(error, "total").number, at(error, "centroid").number,
                               at(error, "shape").number, at(error, "worst").number};
    out.time = {at(value, "minSecondsPerVertexAndSecond").number,
                at(value, "medianSecondsPerVertexAndSecond").number, int(at(value, "samples").number)};
    out.front = at(value, "front").boolean;
    return out;
}

ReportEntry entryOf(const JsonValue& value) {
    ReportEntry out;
    out.accuracy.scene = at(value, "scene").text;
    out.accuracy.seconds = at(value, "seconds").number;
    out.accuracy.chaotic = at(value, "chaotic").text;
    if (const JsonValue* tooStiff = value.find("tooStiff")) out.accuracy.tooStiff = tooStiff->text;
    for (const JsonValue& point : at(value, "points").items)
        out.accuracy.points.push_back(pointOf(point));
    const JsonValue& chosen = at(value, "chosen");
    if (chosen.kind != JsonValue::Kind::object) return out;
    out.chosen.emplace();
    out.chosen->target = at(chosen, "target").number;
    out.chosen->method = methodOf(chosen);
    out.chosen->substeps = int(at(chosen, "substeps").number);
    out.chosen->error = at(chosen, "error").number;
    return out;
}

MeasuredWith withOf(const JsonValue& value) {
    const JsonValue &machine = at(value, "machine"), &context = at(value, "context");
    MeasuredWith out;
    out.processor = at(machine, "processor").text;
    out.cores = int(at(machine, "cores").number);
    out.renderer = at(context, "renderer").text;
    out.context = at(context, "kind").text;
    out.opengl = at(context, "version").text;
    out.path = at(value, "path").text;
    out.scene = at(value, "scene").text;
    out.frameRate = at(value, "frameRate").number;
    out.duration = at(value, "duration").number;
    out.target = at(value, "target").number;
    for (const JsonValue& group : at(value, "groups").items) {
        out.molecules.emplace_back(at(group, "measuredMolecules").number, at(group, "timedMolecules").number);
        out.shapes.emplace_back(at(group, "vertices").number, at(group, "springs").number);
    }
    for (const JsonValue& point : at(value, "points").items) {
        out.solvers.insert(at(point, "solver").text);
        out.samplings.insert(at(point, "fieldSampling").text);
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
    for (const auto& [what, is] : same)
        if (!is) return what;
    return {};
}

std::optional<Measured> readMeasured(const std::string& file) {
    std::error_code none;
    if (!std::filesystem::exists(file, none)) return std::nullopt;
    try {
        const JsonValue value = readJson(file);
        if (at(value, "version").text != SHOAL_VERSION) return std::nullopt;
        return Measured{entryOf(value), withOf(value)};
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace shoal::app
