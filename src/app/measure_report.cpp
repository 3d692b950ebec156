#include "app/measure.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "bench/case.h"
#include "core/error.h"
#include "core/printable.h"
#include "measure/timing.h"
#include "molecule/analysis.h"

namespace shoal::app {

using namespace measure;

namespace {

std::string exponent(double value) {
    return formatted("%.1e", value);
}

std::string steps(const AccuracyPoint& point) {
    if (point.step.split == 1) return std::to_string(point.step.substeps);
    return concat(point.step.split, " x ", point.step.substeps);
}

void addHead(std::ostringstream& out, const MeasureReport& report) {
    const AccuracyReport& a = report.accuracy;
    out << twoLines(report.machine) << "; " << name(a.path) << " path\n"
        << "\"" << printable(a.scene) << "\": " << a.duration << " s at " << a.frameRate
        << " frames a second\n";
    for (const AccuracyGroup& group : a.groups)
        out << "  " << printable(group.name) << ": " << many(group.vertices, "vertex", "vertices") << ", "
            << many(group.springs, "spring", "springs") << ", up to "
            << formatted("%.3g", hertz(group.highestFrequency)) << " Hz; error of " << group.measured
            << ", time of " << bench::grouped(group.timed) << "\n";
    if (!a.tooStiff.empty())
        out << "too stiff, so that no errors are given: " << printable(a.tooStiff) << "\n";
    else if (!a.chaotic.empty())
        out << "chaotic, so that no errors are given: " << printable(a.chaotic) << "\n";
    else
        out << "the reference is good to " << exponent(a.referenceError) << "\n";
}

constexpr int measureColumns[] = {12, 9, 9, 9, 9, 9, 11, 11, 9, 9, 9, 7};

void addPoint(std::ostringstream& out, const AccuracyPoint& point, const MeasureReport& report) {
    std::vector<std::string> cells = {steps(point), bench::grouped(int(std::lround(point.stepsPerSecond)))};
    const auto orDash = [](const auto& value, auto&& text) -> std::string {
        return value ? text(*value) : "-";
    };
    const auto part = [&](double ErrorParts::*member) {
        cells.push_back(orDash(point.error, [&](const ErrorParts& e) { return exponent(e.*member); }));
    };
    part(&ErrorParts::total);
    part(&ErrorParts::centroid);
    part(&ErrorParts::shape);
    part(&ErrorParts::worst);
    const bool timed = point.time.samples > 0;
    cells.push_back(timed ? nanoseconds(point.time.min) : "-");
    cells.push_back(timed ? nanoseconds(point.time.median) : "-");
    const auto drift = [&](double Drift::*member) {
        cells.push_back(orDash(point.drift, [&](const Drift& d) { return exponent(d.*member); }));
    };
    drift(&Drift::energy);
    drift(&Drift::momentum);
    drift(&Drift::angularMomentum);
    cells.push_back(&point == chosenPoint(report) ? "chosen" : point.front ? "front" : "");
    out << tableRow(cells, measureColumns);
}

void addCurve(std::ostringstream& out, const Method& method, const MeasureReport& report) {
    out << "\n" << measure::name(method) << "\n";
    bool head = false;
    const AccuracyPoint* refused = nullptr;
    const auto tellRefused = [&] {
        if (refused != nullptr)
            out << "  refused up to " << steps(*refused)
                << (refused->step.perFrame() == 1 ? " substep: " : " substeps: ") << printable(refused->why)
                << "\n";
        refused = nullptr;
    };
    for (const AccuracyPoint& point : report.accuracy.points) {
        if (point.method != method) continue;
        if (point.outcome == Outcome::refused) {
            refused = &point;
            continue;
        }
        tellRefused();
        if (point.outcome != Outcome::measured) {
            out << "  " << steps(point) << " substeps: " << name(point.outcome) << ": "
                << printable(point.why) << "\n";
            continue;
        }
        if (!head)
            out << tableRow({"substeps", "steps/s", "error", "centroid", "shape", "worst", "min ns",
                             "median ns", "energy", "momentum", "angular"},
                            measureColumns);
        head = true;
        addPoint(out, point, report);
    }
    tellRefused();
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

void addSpeedUps(std::ostringstream& out, const MeasureReport& report) {
    const std::vector<AccuracyPoint>& points = report.accuracy.points;
    const std::optional<BestOf> euler = bestOf(points, SolverKind::euler, report.target);
    bool head = false;
    for (const Solver& solver : solvers()) {
        const std::optional<BestOf> best = bestOf(points, solver.kind, report.target);
        if (!best) continue;
        if (!head)
            out << "\nan error of " << report.target
                << " of these molecules costs, ns per vertex and simulated second\n";
        head = true;
        out << "  " << std::left << std::setw(16) << solver.name << std::right << std::setw(10)
            << nanoseconds(best->cost.time) << "   " << name(best->method.sampling) << ", "
            << (best->cost.atLargestStep ? "at the largest step, " : "")
            << bench::grouped(int(std::lround(best->cost.stepsPerSecond))) << " steps a second";
        if (euler && solver.kind != SolverKind::euler)
            out << "; " << formatted("%.2g", euler->cost.time / best->cost.time) << " times as fast as euler";
        out << "\n";
    }
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

std::string quotedCell(const std::string& text) {
    std::string out = "\"";
    for (const char c : printable(text))
        out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
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
    std::string out = concat("measured ", exponent(calibration.error), " RMS");
    if (s.compared > s.measured) out += concat(" of ", s.measured, " molecules");
    out += concat(" and ", exponent(s.worst), " at worst of ", s.compared,
                  s.compared == 1 ? " molecule (" : " molecules (", calibration.how, ")");
    if (s.above > 0) out += concat(", ", s.above, " above");
    if (s.untold > 0) out += concat(", nothing known of ", s.untold, " more");
    return out;
}

std::string oneLine(const Calibration& calibration) {
    return concat("error ", calibration.target, ": ", shoal::name(calibration.method.solver), ", ",
                  calibration.substeps, calibration.substeps == 1 ? " substep" : " substeps",
                  " a frame, fields by ", shoal::name(calibration.method.sampling), "; ",
                  sampleText(calibration), "; ", nanoseconds(calibration.cost),
                  " ns per vertex and simulated second, ",
                  calibration.kept ? "as found before"
                                   : concat("found in ", formatted("%.1f", calibration.seconds), " s"));
}

std::string asText(const Calibration& calibration) {
    std::string out = concat(oneLine(calibration), ": ", printable(calibration.why), "\n");
    const char* row = "  %-30s%5s%10s%10s%9s";
    out += formatted(row, "method", "steps", "RMS", "worst", "ns") + "\n";
    for (const Candidate& candidate : calibration.candidates) {
        const std::string steps = candidate.substeps > 0 ? std::to_string(candidate.substeps) : "-",
                          rms = candidate.error ? exponent(*candidate.error) : "-",
                          worst = candidate.worst ? exponent(*candidate.worst) : "-",
                          cost = candidate.cost > 0 ? nanoseconds(candidate.cost) : "-";
        out += formatted(row, measure::name(candidate.method).c_str(), steps.c_str(), rms.c_str(),
                         worst.c_str(), cost.c_str());
        out += "   " + printable(candidate.why) + "\n";
    }
    return out;
}

std::string asText(const MeasureReport& report) {
    std::ostringstream out;
    addHead(out, report);
    for (const Method& method : methodsOf(report.accuracy.points))
        addCurve(out, method, report);
    addSpeedUps(out, report);
    addChosen(out, report);
    if (!report.accuracy.notes.empty()) out << "\n";
    for (const std::string& note : report.accuracy.notes)
        out << "note: " << printable(note) << "\n";
    return out.str();
}

JsonValue asJson(const MeasureReport& report) {
    const AccuracyReport& a = report.accuracy;
    const auto orNull = [](const std::string& text) { return text.empty() ? JsonValue() : toJson(text); };
    JsonValue out = object(
        key("version", SHOAL_VERSION),
        key("machine",
            object(key("processor", report.machine.processor), key("cores", report.machine.cores))),
        key("context", asJson(report.machine.context)), key("scene", a.scene), key("path", name(a.path)),
        key("frameRate", a.frameRate), key("duration", a.duration), key("seconds", a.seconds),
        key("groups", arrayOf(a.groups, asJson)), key("chaotic", orNull(a.chaotic)),
        key("tooStiff", orNull(a.tooStiff)),
        key("referenceError", a.hasErrors() ? std::optional(a.referenceError) : std::nullopt),
        key("target", report.target), key("chosen", report.chosen ? asJson(*report.chosen) : JsonValue()));
    if (!report.chosen) append(out, key("notChosen", report.notChosen));
    return append(out, key("notes", a.notes), key("points", arrayOf(a.points, asJson)));
}

std::string asCsv(const MeasureReport& report) {
    std::ostringstream out;
    out << std::setprecision(9)
        << "solver,fieldSampling,substeps,framesPerFrame,stepsPerSecond,outcome,error,centroid,shape,worst,"
           "energyDrift,momentumDrift,angularMomentumDrift,minSecondsPerVertexAndSecond,"
           "medianSecondsPerVertexAndSecond,samples,stateBytes,front,chosen,why\n";
    for (const AccuracyPoint& p : report.accuracy.points) {
        out << shoal::name(p.method.solver) << "," << shoal::name(p.method.sampling) << "," << p.step.substeps
            << "," << p.step.split << "," << p.stepsPerSecond << "," << name(p.outcome) << ",";
        if (p.error)
            out << p.error->total << "," << p.error->centroid << "," << p.error->shape << ","
                << p.error->worst << ",";
        else
            out << ",,,,";
        if (p.drift)
            out << p.drift->energy << "," << p.drift->momentum << "," << p.drift->angularMomentum << ",";
        else
            out << ",,,";
        if (p.time.samples > 0)
            out << p.time.min << "," << p.time.median << "," << p.time.samples << "," << p.stateBytes << ",";
        else
            out << ",,0,,";
        out << p.front << "," << (&p == chosenPoint(report)) << ","
            << (p.why.empty() ? "" : quotedCell(p.why)) << "\n";
    }
    return out.str();
}

}  // namespace shoal::app
