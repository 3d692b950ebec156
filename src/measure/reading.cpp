#include "measure/reading.h"

#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/json_build.h"

namespace shoal::measure {

namespace {

constexpr std::array<const char*, diagnosticCount> quantityWords = {
    "error",     "worstError", "energyGiven", "energyLost",      "strain",
    "rmsStrain", "overlap",    "rmsOverlap",  "contactResidual", "contactsDropped"};

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

Requirement requirementOf(const std::string& text) {
    const size_t below = text.find('<');
    if (text.empty() || below == std::string::npos)
        throw Error("expected a quantity, \"<\" and a number, such as strain<0.01, found \"", text, "\"");
    const std::string word = trimmed(text.substr(0, below)), number = trimmed(text.substr(below + 1));
    Requirement out;
    out.text = text;
    size_t index = 0;
    while (index < diagnosticCount && word != quantityWords[index])
        ++index;
    if (index == diagnosticCount)
        throw Error("unknown quantity \"", word, "\"", suggestion(word, quantityNames()));
    out.quantity = Diagnostic(index);
    const char* end = number.data() + number.size();
    const auto [stop, code] = std::from_chars(number.data(), end, out.limit);
    if (code != std::errc() || stop != end || !std::isfinite(out.limit) || out.limit <= 0)
        throw Error("expected a number above 0 behind \"", word, "<\", found \"", number, "\"");
    return out;
}

std::string number(double value) {
    return formatted("%.2g", value);
}

// "strain 0.012 (RMS 0.004), at molecule 3 of "leaf""
std::string pairText(const Reading& reading, const char* word, Diagnostic largest, Diagnostic rms) {
    if (!reading[largest]) return {};
    const std::string& place = reading.places[size_t(largest)];
    return concat(word, " ", number(*reading[largest]), " (RMS ", number(*reading[rms]), ")",
                  place.empty() ? "" : concat(", at ", place));
}

}  // namespace

const char* name(Diagnostic quantity) {
    return quantityWords[size_t(quantity)];
}

std::vector<std::string> quantityNames() {
    return {quantityWords.begin(), quantityWords.end()};
}

std::string shortText(const Reading& reading) {
    std::vector<std::string> out;
    for (const Diagnostic quantity : {Diagnostic::error, Diagnostic::strain, Diagnostic::overlap})
        if (reading[quantity]) out.push_back(concat(name(quantity), " ", number(*reading[quantity])));
    return joined(out, ", ");
}

std::vector<std::string> text(const Reading& reading) {
    std::vector<std::string> out;
    const std::string unknown = reading.unknown > 0 ? concat(", ", reading.unknown, " more not known") : "";
    if (reading[Diagnostic::error]) {
        out.push_back(concat("error ", number(*reading[Diagnostic::error]), " of the size after ",
                             number(reading.duration), " s (RMS of ",
                             many(reading.judged - reading.unknown, "molecule", "molecules"), unknown,
                             "), largest ", number(*reading[Diagnostic::worstError]), ", ",
                             reading.places[size_t(Diagnostic::worstError)]));
        out.push_back(concat("energy given by the method ", number(*reading[Diagnostic::energyGiven]),
                             ", lost ", number(*reading[Diagnostic::energyLost])));
    } else if (reading.unknown > 0) {
        out.push_back(concat("error not known: ", many(reading.unknown, "molecule is", "molecules are"),
                             " chaotic, or too stiff for a reference in the time there was"));
    }
    if (!reading.noError.empty()) out.push_back(concat("no error: ", reading.noError));
    std::vector<std::string> rest;
    for (const std::string& each :
         {pairText(reading, "strain", Diagnostic::strain, Diagnostic::rmsStrain),
          pairText(reading, "overlap", Diagnostic::overlap, Diagnostic::rmsOverlap)})
        if (!each.empty()) rest.push_back(each);
    if (reading[Diagnostic::contactResidual])
        rest.push_back(concat("contact residual ", number(*reading[Diagnostic::contactResidual])));
    if (!rest.empty()) out.push_back(joined(rest, "; "));
    return out;
}

JsonValue asJson(const Reading& reading) {
    JsonValue out = object(key("time", reading.time), key("frame", reading.frame));
    for (size_t i = 0; i < diagnosticCount; ++i)
        append(out, key(quantityWords[i], reading.values[i]));
    append(out, key("errorDuration", reading.duration), key("errorMolecules", reading.judged),
           key("errorUnknown", reading.unknown));
    if (!reading.noError.empty()) append(out, key("noError", reading.noError));
    return out;
}

std::vector<Requirement> requirementsOf(const std::string& text) {
    std::vector<Requirement> out;
    for (size_t first = 0; first <= text.size();) {
        const size_t comma = std::min(text.find(',', first), text.size());
        out.push_back(requirementOf(trimmed(text.substr(first, comma - first))));
        first = comma + 1;
    }
    return out;
}

std::string whyBroken(const Requirement& requirement, const Reading& reading, bool end) {
    const Diagnostic quantity = requirement.quantity;
    const bool ofError = quantity <= Diagnostic::energyLost;
    const std::optional<double>& value = reading[quantity];
    if (value && !(*value < requirement.limit)) {
        const std::string& place = reading.places[size_t(quantity)];
        return concat(name(quantity), " is ", number(*value), " at ", reading.time, " s, frame ",
                      reading.frame, place.empty() ? "" : concat(", ", place));
    }
    // as --error claims: 99 of 100 molecules are known to be below
    if (ofError && 100 * reading.unknown > reading.judged)
        return concat("the error of ", reading.unknown, " of ", many(reading.judged, "molecule", "molecules"),
                      " is not known at ", reading.time, " s, frame ", reading.frame,
                      ": chaotic, or too stiff for a reference in the time there was");
    if (!value && end) return concat(name(quantity), " is not known by the end, frame ", reading.frame);
    return {};
}

}  // namespace shoal::measure
