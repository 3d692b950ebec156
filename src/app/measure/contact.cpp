// `shoal measure --contact`: how contact between molecules errs, against what it costs.
#include <iostream>
#include <sstream>

#include "app/measure/measure.h"
#include "core/file.h"
#include "core/printable.h"
#include "core/table.h"
#include "gpu/program_cache.h"
#include "measure/contact_curve.h"
#include "run/progress.h"

namespace shoal::app {

using namespace measure;

namespace {

constexpr Column contactColumns[] = {{"iterations", "iterations", 12},
                                     {"overlap", "overlap", 10, "%.1e"},
                                     {"largestOverlap", "largest", 10, "%.1e"},
                                     {"energyGiven", "energy", 10, "%.1e"},
                                     {"momentum", "momentum", 10, "%.1e"},
                                     {"contacts", "contacts", 10},
                                     {"minSeconds", "min ms", 10, "%.3g", 1e3},
                                     {"medianSeconds", "median ms", 10, "%.3g", 1e3},
                                     {"secondsPerContact", "ns each", 9, "%.3g", 1e9},
                                     {"marks", "", -20}};
const char *contactCsvHead =
               "substeps,iterations,outcome,overlap,largestOverlap,energyGiven,momentum,contacts,steps,"
               "minSeconds,medianSeconds,samples,front,scenes,why",
           *contactCsvKeys = contactCsvHead;

JsonValue pointAsJson(const ContactPoint& point) {
    JsonValue out = object(key("substeps", point.substeps), key("iterations", point.iterations),
                           key("outcome", name(point.outcome)));
    if (!point.why.empty()) append(out, key("why", point.why));
    if (point.outcome != Outcome::measured) return out;
    append(out, key("overlap", point.errors.overlap), key("largestOverlap", point.errors.largestOverlap),
           key("energyGiven", point.errors.energyGiven), key("momentum", point.errors.momentum),
           key("contacts", point.contacts), key("steps", point.steps), key("samples", point.time.samples));
    if (point.time.samples > 0)
        append(out, key("minSeconds", point.time.min), key("medianSeconds", point.time.median),
               key("secondsPerContact", point.secondsPerContact()));
    return append(out, key("front", point.front), key("scenes", point.scenes));
}

JsonValue curveAsJson(const ContactCurve& curve, const bench::MeasuredOn& machine) {
    JsonValue out = firstKeys(machine);
    return append(out, key("scene", curve.scene), key("solver", curve.solver),
                  key("frameRate", curve.frameRate), key("duration", curve.duration),
                  key("molecules", curve.molecules), key("spheres", curve.spheres), key("notes", curve.notes),
                  key("points", arrayOf(curve.points, pointAsJson)));
}

std::vector<JsonValue> rowsOf(const ContactCurve& curve) {
    std::vector<JsonValue> out;
    for (const ContactPoint& point : curve.points) {
        JsonValue& row = out.emplace_back(pointAsJson(point));
        append(row, key("group", many(point.substeps, "substep", "substeps")),
               key("marks", concat(point.front ? "  front" : "", point.scenes ? "  the scene's" : "")));
        if (point.outcome == Outcome::measured) continue;
        append(row, key(point.outcome == Outcome::leftOut ? "leftOut" : "failed", point.why));
    }
    return out;
}

std::string curveAsText(const ContactCurve& curve, const bench::MeasuredOn& machine) {
    std::ostringstream out;
    out << bench::asText(machine) << "\n\"" << printable(curve.scene) << "\": " << curve.duration << " s at "
        << curve.frameRate << " frames a second, " << many(curve.molecules, "molecule", "molecules") << ", "
        << many(curve.spheres, "sphere", "spheres") << ", " << curve.solver << "\n"
        << "overlap: RMS over all contacts and frames, of the radius of the smaller sphere; energy: given, "
           "of "
           "the largest kinetic energy; ms: a frame\n"
        << tableText(contactColumns, rowsOf(curve), "group");
    for (const std::string& note : curve.notes)
        out << "note: " << printable(note) << "\n";
    return out.str();
}

}  // namespace

int contactCommand(const Options& options) {
    if (!options.csv.empty()) checkWritable(options.csv);
    const Scene scene = readScene(options.files.front(), options);
    tellWarnings(scene.warnings);
    gpu::Context context(hiddenContext(options));
    ContactCurve curve;
    {
        Progress bar("contact, per cent", 100);
        curve = measureContact(scene,
                               {.duration = options.duration,
                                .substeps = options.eachSubsteps,
                                .iterations = options.eachIterations,
                                .seconds = options.seconds,
                                .tell = [&](double share) { bar.reach(int(100 * share)); }},
                               accuracyDevice(options, context));
    }
    const bench::MeasuredOn machine = bench::measuredOn(context, SHOAL_VERSION);
    tellWarnings(context.cache().takeWarnings());
    std::cout << (options.json ? writeJson(curveAsJson(curve, machine)) : curveAsText(curve, machine));
    if (!options.csv.empty()) writeFile(options.csv, tableCsv(contactCsvHead, contactCsvKeys, rowsOf(curve)));
    if (!options.csv.empty() && !options.json) std::cout << "\ntable: " << printable(options.csv) << "\n";
    return 0;
}

}  // namespace shoal::app
