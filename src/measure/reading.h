// The quantities that a run tells of itself as it goes on, and what may be required of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"

namespace shoal::measure {

// All but contactsDropped are relative. Errors and energies are at the ends of stretches of a second, of
// sampled molecules, against the double-precision reference (measure/accuracy_reference.h) from their own
// states at the start; strains are of other sampled molecules, now; contacts are all of the last step.
enum class Diagnostic {
    error,        // RMS over the molecules, of the size
    worstError,   // of the molecule that is farthest off
    energyGiven,  // by the method: what the reference does not have, mean over the molecules, of E of Drift
    energyLost,   // likewise what it alone has
    strain,       // largest |length / rest length - 1|
    rmsStrain,    // over all springs
    overlap,      // depth of the deepest contact, of the radius of the smaller sphere
    rmsOverlap,   // over all contacts
    contactResidual,  // what the last sweep over the contacts left: ContactConvergence
    contactsDropped,  // left out so far, because a sphere touched more than a list holds
};
constexpr size_t diagnosticCount = 10;
const char* name(Diagnostic quantity);     // "rmsStrain": the word of --require, JSON and Python
std::vector<std::string> quantityNames();  // in the order of the enumeration

struct Reading {
    double time = 0;  // s, simulated
    int frame = 0;
    std::array<std::optional<double>, diagnosticCount>
        values;  // nothing: there is none, or it is not known yet
    std::array<std::string, diagnosticCount>
        places;           // of the largest: "molecule 3 of \"leaf\""; empty: no one's
    double duration = 0;  // s, of the last stretch after which an error was taken
    int judged = 0;       // molecules that the reference was asked for, the last ones
    int unknown = 0;      // of them, whose error is not known: chaotic, or too stiff for the time there was
    std::string noError;  // why some groups have no error, in a sentence; empty: all have

    std::optional<double>& operator[](Diagnostic quantity) { return values[size_t(quantity)]; }
    const std::optional<double>& operator[](Diagnostic quantity) const { return values[size_t(quantity)]; }
};

// "error 3.1e-04, strain 0.012": the largest of each kind, of what is known.
std::string shortText(const Reading& reading);
// All of it, in lines for people.
std::vector<std::string> text(const Reading& reading);
// Its quantities by name, with null for what is not known; time, frame, and of what the error is.
JsonValue asJson(const Reading& reading);

// "strain<0.01"
struct Requirement {
    Diagnostic quantity = Diagnostic::error;
    double limit = 0;
    std::string text;  // as it was given
};
// Reads "overlap<1e-4, error<1e-3". Error: says what is wrong in it.
std::vector<Requirement> requirementsOf(const std::string& text);
// Why the reading does not hold to it, in a clause; empty: it does, or what it asks for is not known yet. At
// the end of a run, what is not known does not hold.
std::string whyBroken(const Requirement& requirement, const Reading& reading, bool end);

}  // namespace shoal::measure
