#include <utility>

#include "measure/calibrate.h"

namespace shoal::measure {

Calibration calibrateContact(const Scene& scene, const CalibrationOptions& options,
                             const AccuracyDevice& device, bool& whole) {
    if (!options.solvers.empty() || !options.samplings.empty())
        throw Error(
            "--error chooses the substeps and iterations of contact where molecules touch, and no "
            "solver: remove --solver and --field-sampling");
    const Location place{scene.file, 0, 0, {}};
    ContactCurveOptions wanted{.duration = options.duration, .rounds = 2, .seconds = options.seconds};
    if (options.substeps) wanted.substeps = {*options.substeps};
    int told = 0;  // tenths
    wanted.tell = [&](double share) {
        if (int(10 * share) == std::exchange(told, int(10 * share)) || !options.tell) return;
        options.tell(concat("measuring contact, ", 10 * told, " per cent"));
    };
    const ContactCurve curve = measureContact(scene, wanted, device);
    const auto measured = [](const ContactPoint& point) {
        return point.outcome == Outcome::measured && point.time.samples > 0;
    };
    const ContactPoint *best = nullptr, *nearest = nullptr;
    size_t tried = 0, within = 0;
    whole = true;
    for (const ContactPoint& point : curve.points) {
        if (!measured(point)) {
            whole = whole && (point.outcome == Outcome::refused || point.outcome == Outcome::notFinite);
            continue;
        }
        ++tried;
        if (!nearest || point.errors.overlap < nearest->errors.overlap) nearest = &point;
        if (point.errors.overlap > options.error) continue;
        ++within;
        if (!best || point.time.min < best->time.min) best = &point;
    }
    if (!nearest) throw Error(place, concat("--error: contact was not measured: ", curve.points.front().why));
    const std::string found =
        concat(many(nearest->substeps, "substep", "substeps"), " with ",
               many(nearest->iterations, "iteration", "iterations"), ", where spheres overlap by ",
               formatted("%.2g", nearest->errors.overlap), " of their radius, RMS");
    if (!best && !whole)
        throw Error(place, concat("--error ", options.error, ": no step of contact was found to hold it in ",
                                  *options.seconds, " s: give it more time with ", options.limitOption,
                                  "; the nearest by then is ", found));
    if (!best)
        throw Error(place, concat("--error ", options.error,
                                  " is out of reach for contact between molecules: the nearest is ", found));
    Calibration out;
    out.target = options.error;
    out.substeps = best->substeps;
    out.error = best->errors.overlap;
    out.duration = curve.duration;
    out.contact = *best;
    out.why =
        concat("the cheapest of ", within, " of ", tried, " pairs of substeps and iterations that get there");
    return out;
}

}  // namespace shoal::measure
