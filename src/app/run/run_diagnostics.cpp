#include "app/run/run_diagnostics.h"

#include <algorithm>
#include <ostream>

#include "core/json_build.h"
#include "core/printable.h"

namespace shoal::app {

using measure::Requirement;

static bool requiresError(const Options& options) {
    return std::any_of(options.requirements.begin(), options.requirements.end(), [](const Requirement& each) {
        return each.quantity <= measure::Diagnostic::energyLost;
    });
}

static measure::DiagnosticsOptions limits(bool judgesError) {
    measure::DiagnosticsOptions out;
    if (judgesError) out.leastSeconds = 3;
    return out;
}

RunDiagnostics::RunDiagnostics(const Options& options, const Scene& scene, const Simulation& simulation)
    : options_(options),
      judgesError_(requiresError(options)),
      diagnostics_(scene, simulation, limits(judgesError_)) {
    for (const Requirement& required : options.requirements)
        if (const std::optional<Warning> why = diagnostics_.lacks(required.quantity))
            throw WrongUse(why->location, concat("--require ", required.text, ": ", why->message));
}

void RunDiagnostics::take(bool end) {
    readings_.push_back(*diagnostics_.reading());
    for (const Requirement& required : options_.requirements) {
        if (!broken_.empty()) return;
        const std::string why = whyBroken(required, readings_.back(), end);
        if (!why.empty()) broken_ = concat("--require ", required.text, " does not hold: ", why);
    }
}

bool RunDiagnostics::follow() {
    if (!diagnostics_.follow()) return false;
    take(false);
    return true;
}

void RunDiagnostics::finish(bool whole) {
    constexpr double seconds = 0.1, secondsToJudge = 10;
    if (!broken_.empty()) return;  // the reading that broke it is the last
    diagnostics_.finish(judgesError_ && whole ? secondsToJudge : seconds);
    take(whole);
}

void RunDiagnostics::print(std::ostream& out) const {
    for (const std::string& line : text(readings_.back()))
        out << printable(line) << "\n";
}

JsonValue RunDiagnostics::json() const {
    JsonValue out = asJson(readings_.back());
    append(out, key("readings", arrayOf(readings_, measure::asJson)));
    return out;
}

}  // namespace shoal::app
