#include "app/measure/measure.h"

#include <algorithm>
#include <sstream>

#include "app/line/commit.h"
#include "bench/case.h"
#include "core/error.h"
#include "core/printable.h"
#include "core/table.h"
#include "molecule/analysis.h"

namespace shoal::app {

using namespace measure;

namespace {

std::string exponent(double value) {
    return formatted("%.1e", value);
}

void addHead(std::ostringstream& out, const MeasureReport& report) {
    const AccuracyReport& a = report.accuracy;
    out << asText(report.machine) << "; " << name(a.path) << " path\n"
        << "\"" << printable(a.scene) << "\": " << a.duration << " s at " << a.frameRate
        << " frames a second\n";
    for (const AccuracyGroup& group : a.groups)
        out << "  " << printable(group.name) << ": " << many(group.vertices, "vertex", "vertices") << ", "
            << many(group.springs, "spring", "springs") << ", up to "
            << formatted("%.3g", hertz(group.highestFrequency)) << " Hz; error of " << group.measured
            << ", time of " << bench::grouped(group.timed) << "\n";
    if (!a.tooStiff.empty())
        out << "no errors are given: " << printable(a.tooStiff) << "\n";
    else if (!a.chaotic.empty())
        out << "chaotic, so that no errors are given: " << printable(a.chaotic) << "\n";
    else
        out << "the reference is good to " << exponent(a.referenceError) << "\n";
}

constexpr Column pointColumns[] = {{"substeps", "substeps", 10, "%.0f"},
                                   {"framesPerFrame", "frames", 8, "%.0f"},
                                   {"stepsPerSecond", "steps/s", 9, "%.0f"},
                                   {"error.total", "error", 9, "%.1e"},
                                   {"error.centroid", "centroid", 9, "%.1e"},
                                   {"error.shape", "shape", 9, "%.1e"},
                                   {"error.worst", "worst", 9, "%.1e"},
                                   {"minSecondsPerVertexAndSecond", "min ns", 11, nullptr, 1e9},
                                   {"medianSecondsPerVertexAndSecond", "median ns", 11, nullptr, 1e9},
                                   {"drift.energy", "energy", 9, "%.1e"},
                                   {"drift.momentum", "momentum", 9, "%.1e"},
                                   {"drift.angularMomentum", "angular", 9, "%.1e"},
                                   {"mark", "", 7}};
const char
    *csvHead =
        "solver,fieldSampling,substeps,framesPerFrame,stepsPerSecond,outcome,error,centroid,shape,worst,"
        "energyDrift,momentumDrift,angularMomentumDrift,minSecondsPerVertexAndSecond,"
        "medianSecondsPerVertexAndSecond,samples,stateBytes,front,chosen,why",
    *csvKeys =
        "solver,fieldSampling,substeps,framesPerFrame,stepsPerSecond,outcome,error.total,error.centroid,"
        "error.shape,error.worst,drift.energy,drift.momentum,drift.angularMomentum,"
        "minSecondsPerVertexAndSecond,medianSecondsPerVertexAndSecond,samples,stateBytes,front,chosen,why";
constexpr Column candidateColumns[] = {{"solver", "solver", -16},
                                       {"fieldSampling", "fields", -15},
                                       {"substeps", "steps", 7, "%.0f"},
                                       {"error", "RMS", 10, "%.1e"},
                                       {"worst", "worst", 10, "%.1e"},
                                       {"secondsPerVertexAndSecond", "ns", 9, nullptr, 1e9},
                                       {"reached", "there", 7},
                                       {"", "", 3, ""},
                                       {"why", ""}};

// Of several steps that a method refuses the last one is told.
bool isToldLater(const std::vector<AccuracyPoint>& points, size_t i) {
    return i + 1 < points.size() && points[i].outcome == Outcome::refused &&
           points[i + 1].outcome == Outcome::refused && points[i].method == points[i + 1].method;
}

void addChosen(std::ostringstream& out, const MeasureReport& report) {
    out << "\n";
    if (!report.chosen) {
        out << "For an error of " << report.target << " nothing is chosen: " << printable(report.notChosen)
            << "\n";
        return;
    }
    out << asText(*report.chosen);
}

// Returns what a scene's file says to run as this point did.
std::string sceneLine(const AccuracyPoint& point, double frameRate) {
    JsonValue line = object(key("solver", object(key("method", shoal::name(point.method.solver)),
                                                 key("substeps", point.step.substeps),
                                                 key("fieldSampling", shoal::name(point.method.sampling)))));
    if (point.step.split > 1) append(line, key("frameRate", frameRate * point.step.split));
    const std::string text = writeJsonLine(line);
    return text.substr(1, text.size() - 2);
}

// Of the points on the front, from the cheapest on.
std::vector<const AccuracyPoint*> frontOf(const AccuracyReport& report) {
    std::vector<const AccuracyPoint*> out;
    for (const AccuracyPoint& point : report.points)
        if (point.front && point.error && point.time.samples > 0) out.push_back(&point);
    std::sort(out.begin(), out.end(),
              [](const AccuracyPoint* a, const AccuracyPoint* b) { return a->time.min < b->time.min; });
    return out;
}

// The fastest whose error does not show, that of which time and error have the least product, and the most
// exact.
void addBest(std::ostringstream& out, const MeasureReport& report,
             const std::vector<const AccuracyPoint*>& front) {
    constexpr double shows = 0.1;
    const AccuracyReport& a = report.accuracy;
    const auto tell = [&](const char* what, const AccuracyPoint& point) {
        const double seconds = point.time.min * report.vertices / a.frameRate;
        out << formatted("%-10s", what) << formatted("%8s", shortNumber(seconds * 1e3).c_str())
            << " ms a frame, error " << exponent(point.error->total) << "   " << sceneLine(point, a.frameRate)
            << "\n";
    };
    const auto fastest = std::find_if(
        front.begin(), front.end(), [](const AccuracyPoint* point) { return point->error->total <= shows; });
    const auto product = [](const AccuracyPoint* point) { return point->time.min * point->error->total; };
    const auto balanced = std::min_element(
        front.begin(), front.end(),
        [&](const auto* nearer, const auto* further) { return product(nearer) < product(further); });
    tell("fastest", fastest == front.end() ? *front.front() : **fastest);
    tell("balanced", **balanced);
    tell("exact", *front.back());
}

JsonValue asJson(const ErrorParts& error) {
    return object(key("total", error.total), key("centroid", error.centroid), key("shape", error.shape),
                  key("worst", error.worst), key("worstGroup", error.worstGroup),
                  key("worstMolecule", error.worstMolecule));
}

JsonValue asJson(const Drift& drift) {
    return object(key("energy", drift.energy), key("momentum", drift.momentum),
                  key("angularMomentum", drift.angularMomentum));
}

JsonValue asJson(const AccuracyPoint& point) {
    JsonValue out = object(key("solver", shoal::name(point.method.solver)),
                           key("fieldSampling", shoal::name(point.method.sampling)),
                           key("substeps", point.step.substeps), key("framesPerFrame", point.step.split),
                           key("stepsPerSecond", point.stepsPerSecond), key("outcome", name(point.outcome)));
    if (!point.why.empty()) append(out, key("why", point.why));
    if (point.outcome != Outcome::measured) return out;
    std::optional<double> min, median;
    if (point.time.samples > 0) {
        min = point.time.min;
        median = point.time.median;
    }
    return append(out, key("error", point.error ? asJson(*point.error) : JsonValue()),
                  key("drift", point.drift ? asJson(*point.drift) : JsonValue()),
                  key("samples", point.time.samples), key("minSecondsPerVertexAndSecond", min),
                  key("medianSecondsPerVertexAndSecond", median), key("stateBytes", point.stateBytes),
                  key("front", point.front));
}

JsonValue asJson(const AccuracyGroup& group) {
    return object(key("name", group.name), key("molecule", group.molecule), key("vertices", group.vertices),
                  key("springs", group.springs), key("size", group.size),
                  key("highestFrequency", hertz(group.highestFrequency)),
                  key("measuredMolecules", group.measured), key("timedMolecules", group.timed));
}

// The points with what only text and CSV say of them.
std::vector<JsonValue> pointRows(const MeasureReport& report) {
    std::vector<JsonValue> out;
    for (const AccuracyPoint& point : report.accuracy.points) {
        const bool chosen = &point == chosenPoint(report), measured = point.outcome == Outcome::measured;
        JsonValue& row = out.emplace_back(asJson(point));
        append(row, key("chosen", chosen),
               key("mark", chosen        ? "chosen"
                           : point.front ? "front"
                                         : ""),
               key("method", measure::name(point.method)));
        if (!measured)
            append(row, key("unmeasured", concat(name(point.outcome), ": ", point.why)), key("samples", 0),
                   key("front", false));
    }
    return out;
}

}  // namespace

const AccuracyPoint* chosenPoint(const MeasureReport& report) {
    if (!report.chosen) return nullptr;
    for (const AccuracyPoint& point : report.accuracy.points)
        if (point.method == report.chosen->method && point.step == Step{report.chosen->substeps, 1} &&
            point.outcome == Outcome::measured)
            return &point;
    return nullptr;
}

// Says how large the error is, and for which molecules that is claimed.
static std::string sampleText(const Calibration& calibration) {
    const SampleError& s = calibration.sample;
    std::string out =
        concat("measured after ", calibration.duration, " s: ", exponent(calibration.error), " RMS");
    out += concat(" and ", exponent(s.worst), " at worst of ", s.molecules,
                  s.molecules == 1 ? " molecule (" : " molecules (", calibration.how, ")");
    if (s.above > 0) out += concat(", ", s.above, " above");
    if (s.unknown > 0) out += concat(", nothing known of ", s.unknown);
    return out;
}

// What was chosen of contact: where molecules touch, no error of their paths is claimed.
static std::string contactText(const Calibration& calibration) {
    const ContactPoint& point = *calibration.contact;
    std::string out =
        concat("error ", calibration.target, ": ", many(calibration.substeps, "substep", "substeps"),
               " a frame with ", many(point.iterations, "iteration", "iterations"), " of contact; over ",
               calibration.duration, " s spheres overlap by ", exponent(point.errors.overlap), " RMS and ",
               exponent(point.errors.largestOverlap), " at most of their radius");
    if (point.errors.energyGiven)
        out += concat(", contact gives ", exponent(*point.errors.energyGiven), " of the energy");
    return concat(out, "; ", shortNumber(point.time.min * 1e3), " ms a frame");
}

static std::string foundText(const Calibration& calibration) {
    return calibration.kept ? "as found before"
                            : concat("found in ", formatted("%.1f", calibration.seconds), " s");
}

std::string oneLine(const Calibration& calibration) {
    if (calibration.contact) return concat(contactText(calibration), ", ", foundText(calibration));
    return concat("error ", calibration.target, ": ", shoal::name(calibration.method.solver), ", ",
                  calibration.substeps, calibration.substeps == 1 ? " substep" : " substeps",
                  " a frame, fields by ", shoal::name(calibration.method.sampling), "; ",
                  sampleText(calibration), "; ", shortNumber(calibration.cost * 1e9),
                  " ns per vertex and simulated second, ", foundText(calibration));
}

std::string asText(const Calibration& calibration) {
    if (calibration.contact)
        return concat(oneLine(calibration), ": ", printable(calibration.why),
                      "; paths part where molecules touch, so no error of them is claimed\n");
    return concat(oneLine(calibration), ": ", printable(calibration.why), "\n",
                  tableText(candidateColumns, measure::asJson(calibration).find("candidates")->items));
}

std::string asText(const MeasureReport& report, bool all) {
    std::ostringstream out;
    addHead(out, report);
    const std::vector<const AccuracyPoint*> front = frontOf(report.accuracy);
    if (all || front.empty()) {
        std::vector<JsonValue> rows = pointRows(report), told;
        for (size_t i = 0; i < rows.size(); ++i)
            if (!isToldLater(report.accuracy.points, i)) told.push_back(std::move(rows[i]));
        out << tableText(pointColumns, told, "method");
    }
    if (all || front.empty() || report.isTargetAsked) addChosen(out, report);
    if (!report.accuracy.notes.empty()) out << "\n";
    for (const std::string& note : report.accuracy.notes)
        out << "note: " << printable(note) << "\n";
    if (front.empty()) return out.str();
    out << "\n";
    addBest(out, report, front);
    return out.str();
}

JsonValue firstKeys(const bench::MeasuredOn& machine) {
    return object(key("version", machine.version), key("commit", commit()), key("date", today()),
                  key("machine", object(key("processor", machine.processor), key("cores", machine.cores))),
                  key("context", bench::asJson(machine.context)));
}

JsonValue asJson(const MeasureReport& report) {
    const AccuracyReport& a = report.accuracy;
    const auto orNull = [](const std::string& text) { return text.empty() ? JsonValue() : toJson(text); };
    JsonValue out = firstKeys(report.machine);
    append(out, key("scene", a.scene), key("path", name(a.path)), key("frameRate", a.frameRate),
           key("duration", a.duration), key("seconds", a.seconds), key("groups", arrayOf(a.groups, asJson)),
           key("chaotic", orNull(a.chaotic)), key("tooStiff", orNull(a.tooStiff)),
           key("referenceError", a.hasErrors() ? std::optional(a.referenceError) : std::nullopt),
           key("target", report.target), key("chosen", report.chosen ? asJson(*report.chosen) : JsonValue()));
    if (!report.chosen) append(out, key("notChosen", report.notChosen));
    return append(out, key("notes", a.notes), key("points", arrayOf(a.points, asJson)));
}

std::string asCsv(const MeasureReport& report) {
    return tableCsv(csvHead, csvKeys, pointRows(report));
}

}  // namespace shoal::app
