#include "app/measure_read.h"

#include <filesystem>

#include "app/options.h"
#include "core/json.h"

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
            samplingNamed("fieldSampling", at(value, "fieldSampling").text)};
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

}  // namespace

std::optional<ReportEntry> readMeasured(const std::string& file) {
    std::error_code none;
    if (!std::filesystem::exists(file, none)) return std::nullopt;
    try {
        const JsonValue value = readJson(file);
        if (at(value, "version").text != SHOAL_VERSION) return std::nullopt;
        return entryOf(value);
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace shoal::app
