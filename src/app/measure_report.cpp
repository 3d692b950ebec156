#include "app/measure.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "bench/case.h"
#include "core/error.h"
#include "core/printable.h"
#include "measure/timing.h"

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
            << formatted("%.3g", group.highestFrequency) << " rad/s; error of " << group.measured
            << ", time of " << bench::grouped(group.timed) << "\n";
    if (!a.tooStiff.empty())
        out << "too stiff, so that no errors are given: " << printable(a.tooStiff) << "\n";
    else if (!a.chaotic.empty())
        out << "chaotic, so that no errors are given: " << printable(a.chaotic) << "\n";
    else
        out << "the reference is good to " << exponent(a.referenceError) << "\n";
}

constexpr int columns[] = {10, 9, 9, 9, 9, 9, 11, 11, 9, 9, 9, 7};

void addRow(std::ostringstream& out, const std::vector<std::string>& cells) {
    std::ostringstream line;
    line << "  ";
    for (size_t i = 0; i < cells.size(); ++i)
        line << std::right << std::setw(columns[i]) << cells[i];
    const std::string text = line.str();
    out << text.substr(0, text.find_last_not_of(' ') + 1) << "\n";
}

void addPoint(std::ostringstream& out, const AccuracyPoint& point, const MeasureReport& report) {
    std::vector<std::string> cells = {steps(point), bench::grouped(int(point.stepsPerSecond + 0.5))};
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
    addRow(out, cells);
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
            addRow(out, {"substeps", "steps/s", "error", "centroid", "shape", "worst", "min ns", "median ns",
                         "energy", "momentum", "angular"});
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
        const std::optional<BestOf> one = bestOf(points, solver.kind, report.target);
        if (!one) continue;
        if (!head) out << "\nan error of " << report.target << " costs, ns per vertex and simulated second\n";
        head = true;
        out << "  " << std::left << std::setw(16) << solver.name << std::right << std::setw(10)
            << nanoseconds(one->cost.time) << "   " << name(one->method.sampling) << ", "
            << (one->cost.atLargestStep ? "at the largest step, " : "")
            << bench::grouped(int(one->cost.stepsPerSecond + 0.5)) << " steps a second";
        if (euler && solver.kind != SolverKind::euler)
            out << "; " << formatted("%.2g", euler->cost.time / one->cost.time) << " times as fast as euler";
        out << "\n";
    }
}

JsonValue asJson(const ErrorParts& error) {
    JsonValue out = JsonValue::makeObject();
    out.add("total", JsonValue::makeNumber(error.total))
        .add("centroid", JsonValue::makeNumber(error.centroid))
        .add("shape", JsonValue::makeNumber(error.shape))
        .add("worst", JsonValue::makeNumber(error.worst))
        .add("worstGroup", JsonValue::makeNumber(double(error.worstGroup)))
        .add("worstMolecule", JsonValue::makeNumber(error.worstMolecule));
    return out;
}

JsonValue asJson(const Drift& drift) {
    JsonValue out = JsonValue::makeObject();
    out.add("energy", JsonValue::makeNumber(drift.energy))
        .add("momentum", JsonValue::makeNumber(drift.momentum))
        .add("angularMomentum", JsonValue::makeNumber(drift.angularMomentum));
    return out;
}

JsonValue asJson(const AccuracyPoint& point) {
    JsonValue out = JsonValue::makeObject();
    out.add("solver", JsonValue::makeString(shoal::name(point.method.solver)))
        .add("fieldSampling", JsonValue::makeString(shoal::name(point.method.sampling)))
        .add("substeps", JsonValue::makeNumber(point.step.substeps))
        .add("framesPerFrame", JsonValue::makeNumber(point.step.split))
        .add("stepsPerSecond", JsonValue::makeNumber(point.stepsPerSecond))
        .add("outcome", JsonValue::makeString(name(point.outcome)));
    if (!point.why.empty()) out.add("why", JsonValue::makeString(point.why));
    if (point.outcome != Outcome::measured) return out;
    out.add("error", point.error ? asJson(*point.error) : JsonValue())
        .add("drift", point.drift ? asJson(*point.drift) : JsonValue());
    const bool timed = point.time.samples > 0;
    const auto seconds = [&](double value) { return timed ? JsonValue::makeNumber(value) : JsonValue(); };
    out.add("samples", JsonValue::makeNumber(point.time.samples))
        .add("minSecondsPerVertexAndSecond", seconds(point.time.min))
        .add("medianSecondsPerVertexAndSecond", seconds(point.time.median))
        .add("stateBytes", JsonValue::makeNumber(double(point.stateBytes)))
        .add("front", JsonValue::makeBoolean(point.front));
    return out;
}

JsonValue asJson(const AccuracyGroup& group) {
    JsonValue out = JsonValue::makeObject();
    out.add("name", JsonValue::makeString(group.name))
        .add("molecule", JsonValue::makeString(group.molecule))
        .add("vertices", JsonValue::makeNumber(group.vertices))
        .add("springs", JsonValue::makeNumber(group.springs))
        .add("size", JsonValue::makeNumber(group.size))
        .add("highestFrequency", JsonValue::makeNumber(group.highestFrequency))
        .add("measuredMolecules", JsonValue::makeNumber(group.measured))
        .add("timedMolecules", JsonValue::makeNumber(group.timed));
    return out;
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
static std::string sampleText(const Calibration& one) {
    const SampleError& s = one.sample;
    std::string out = concat("measured ", exponent(one.error), " RMS");
    if (s.compared > s.measured) out += concat(" of ", s.measured, " molecules");
    out += concat(" and ", exponent(s.worst), " at worst of ", s.compared,
                  s.compared == 1 ? " molecule (" : " molecules (", one.how, ")");
    if (s.above > 0) out += concat(", ", s.above, " above");
    if (s.untold > 0) out += concat(", nothing known of ", s.untold, " more");
    return out;
}

std::string oneLine(const Calibration& one) {
    return concat("error ", one.target, ": ", shoal::name(one.method.solver), ", ", one.substeps,
                  one.substeps == 1 ? " substep" : " substeps", " a frame, fields by ",
                  shoal::name(one.method.sampling), "; ", sampleText(one), "; ", nanoseconds(one.cost),
                  " ns per vertex and simulated second, ",
                  one.kept ? "as found before" : concat("found in ", formatted("%.1f", one.seconds), " s"));
}

std::string asText(const Calibration& one) {
    std::ostringstream out;
    out << oneLine(one) << ": " << printable(one.why) << "\n  " << std::left << std::setw(30) << "method"
        << std::right << std::setw(5) << "steps" << std::setw(10) << "RMS" << std::setw(10) << "worst"
        << std::setw(9) << "ns"
        << "\n";
    for (const Candidate& candidate : one.candidates) {
        out << "  " << std::left << std::setw(30) << measure::name(candidate.method) << std::right
            << std::setw(5) << (candidate.substeps > 0 ? std::to_string(candidate.substeps) : "-")
            << std::setw(10) << (candidate.error ? exponent(*candidate.error) : "-") << std::setw(10)
            << (candidate.worst ? exponent(*candidate.worst) : "-") << std::setw(9)
            << (candidate.cost > 0 ? nanoseconds(candidate.cost) : "-") << "   " << printable(candidate.why)
            << "\n";
    }
    return out.str();
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
    JsonValue machine = JsonValue::makeObject();
    machine.add("processor", JsonValue::makeString(report.machine.processor))
        .add("cores", JsonValue::makeNumber(report.machine.cores));
    JsonValue groups = JsonValue::makeArray(), points = JsonValue::makeArray(),
              notes = JsonValue::makeArray();
    for (const AccuracyGroup& group : a.groups)
        groups.items.push_back(asJson(group));
    for (const AccuracyPoint& point : a.points)
        points.items.push_back(asJson(point));
    for (const std::string& note : a.notes)
        notes.items.push_back(JsonValue::makeString(note));
    JsonValue out = JsonValue::makeObject();
    out.add("version", JsonValue::makeString(SHOAL_VERSION))
        .add("machine", std::move(machine))
        .add("context", asJson(report.machine.context))
        .add("scene", JsonValue::makeString(a.scene))
        .add("path", JsonValue::makeString(name(a.path)))
        .add("frameRate", JsonValue::makeNumber(a.frameRate))
        .add("duration", JsonValue::makeNumber(a.duration))
        .add("seconds", JsonValue::makeNumber(a.seconds))
        .add("groups", std::move(groups))
        .add("chaotic", a.chaotic.empty() ? JsonValue() : JsonValue::makeString(a.chaotic))
        .add("tooStiff", a.tooStiff.empty() ? JsonValue() : JsonValue::makeString(a.tooStiff))
        .add("referenceError", a.hasErrors() ? JsonValue::makeNumber(a.referenceError) : JsonValue())
        .add("target", JsonValue::makeNumber(report.target))
        .add("chosen", report.chosen ? asJson(*report.chosen) : JsonValue());
    if (!report.chosen) out.add("notChosen", JsonValue::makeString(report.notChosen));
    return out.add("notes", std::move(notes)).add("points", std::move(points));
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
