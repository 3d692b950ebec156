#include "bench/reports.h"
#include "core/table.h"

namespace shoal::bench {

namespace {

const ContactTimes* find(const CollideReport& report, int quads) {
    for (const ContactTimes& times : report.contact)
        if (times.benchCase.density == "moderate" && times.benchCase.quads == quads && times.leftOut.empty())
            return &times;
    return nullptr;
}

// Ratios of the shortest times.
std::vector<Target> targets(const CollideReport& report) {
    const ContactTimes *small = find(report, 16384), *large = find(report, 131072);
    std::vector<Target> out = {
        {"contact of 16,384 quads of moderate density, over the baseline", 2},
        {"contact of 131,072 quads over 16,384, a quad", 1.3},
    };
    if (small) out[0].measured = small->ratio();
    if (small && large) out[1].measured = large->perQuad() / small->perQuad();
    return out;
}

constexpr Column contactColumns[] = {{"quads", "quads", 10, "%.0f"},
                                     {"contacts", "contacts", 10, "%.0f"},
                                     {"grid.minSeconds", "grid ms", 9, "%.2f", 1e3},
                                     {"search.minSeconds", "search", 8, "%.2f", 1e3},
                                     {"response.minSeconds", "response", 10, "%.2f", 1e3},
                                     {"contact.minSeconds", "contact", 9, "%.2f", 1e3},
                                     {"contact.medianSeconds", "median", 8, "%.2f", 1e3},
                                     {"deviceMinSeconds", "device", 8, "%.2f", 1e3},
                                     {"fusedStep.minSeconds", "fused", 8, "%.2f", 1e3},
                                     {"baseline.minSeconds", "baseline", 10, "%.2f", 1e3},
                                     {"overBaseline", "ratio", 7, "%.2f"},
                                     {"nanosecondsPerQuad", "ns/quad", 9, "%.0f"},
                                     {"contact.minSeconds", "ns/contact", 12, "%.0f", 1e9, "contacts"},
                                     {"dropped", "dropped", 9, "%.0f"}};
constexpr Column searchColumns[] = {{"search", "search", -12},
                                    {"spheresPerCell", "spheres a cell", 15, "%g"},
                                    {"contacts", "contacts", 10, "%.0f"},
                                    {"found", "found", 9, "%.1f%%", 100, "contacts"},
                                    {"nanosecondsPerContact", "ns each", 9, "%.0f"}};
constexpr Column speedColumns[] = {{"search", "search", -12},
                                   {"radiiInAStep", "radii a step", 15, "%g"},
                                   {"contacts", "contacts", 10, "%.0f"},
                                   {"found", "found", 9, "%.1f%%", 100, "contacts"}};

JsonValue asJson(const measure::Spread& spread) {
    return object(key("minSeconds", spread.min), key("medianSeconds", spread.median),
                  key("samples", spread.samples));
}

JsonValue asJson(const ContactTimes& t) {
    JsonValue out = object(key("density", t.benchCase.density), key("quads", t.benchCase.quads),
                           key("cubicMetresPerQuad", t.benchCase.room));
    if (!t.leftOut.empty()) return append(out, key("leftOut", t.leftOut));
    appendDeviceTime(out, t.device);
    return append(out, key("spheres", t.spheres), key("contacts", t.contacts),
                  key("baselineContacts", t.baselineContacts), key("dropped", t.dropped),
                  key("bytes", t.bytes), key("grid", asJson(t.grid)), key("search", asJson(t.search)),
                  key("response", asJson(t.response)), key("contact", asJson(t.contact)),
                  key("baseline", asJson(t.baseline)), key("fusedStep", asJson(t.fused)),
                  key("nanosecondsPerQuad", t.perQuad() * 1e9), key("overBaseline", t.ratio()));
}

JsonValue asJson(const SearchShare& share) {
    return object(key("search", name(share.search)), key("spheresPerCell", share.perCell),
                  key("contacts", share.contacts), key("found", share.found),
                  key("gridAndSearch", asJson(share.time)),
                  key("nanosecondsPerContact", share.perContact() * 1e9));
}

JsonValue asJson(const StepShare& step) {
    return object(key("search", name(step.search)), key("radiiInAStep", step.step),
                  key("contacts", step.contacts), key("found", step.found));
}

JsonValue asJson(const SearchReport& report) {
    return object(key("spheres", report.spheres), key("overDensity", arrayOf(report.shares, asJson)),
                  key("spheresInFlight", report.movingSpheres),
                  key("overSpeed", arrayOf(report.steps, asJson)));
}

// Says what the table's densities are.
std::string legend(const std::vector<ContactTimes>& contact) {
    std::vector<std::string> densities;
    for (const ContactTimes& times : contact) {
        const std::string text =
            formatted("%s: %.3g m³ a quad", times.benchCase.density.c_str(), times.benchCase.room);
        if (densities.empty() || densities.back() != text) densities.push_back(text);
    }
    return concat("one contact step of quads at random in a cube, a sphere of ", ContactCase::radius,
                  " m at each corner; ", joined(densities, ", "), "\n");
}

}  // namespace

std::string asText(const CollideReport& report) {
    const JsonValue json = asJson(report);
    std::string out = asText(report.machine) + "\n";
    if (!report.contact.empty())
        out += legend(report.contact) + tableText(contactColumns, json.find("contact")->items, "density") +
               targetText(json);
    if (!report.searches) return out;
    if (report.searches->shares.empty()) return out + "\nsearches left out: need OpenGL 4.3\n";
    const JsonValue& searches = *json.find("searches");
    return out + concat("\nthe contacts of ", report.searches->spheres,
                        " spheres that a search finds; ns: grid and search, for each contact found\n",
                        tableText(searchColumns, searches.find("overDensity")->items), "\nthe contacts of ",
                        report.searches->movingSpheres, " spheres in flight, ",
                        report.searches->movingPerCell, " a cell, that a look after every step finds\n",
                        tableText(speedColumns, searches.find("overSpeed")->items));
}

JsonValue asJson(const CollideReport& report) {
    JsonValue out = headOf(report.machine);
    return append(out, key("secondsAGroup", report.secondsAGroup),
                  key("contact", arrayOf(report.contact, asJson)),
                  key("searches", report.searches ? asJson(*report.searches) : JsonValue()),
                  key("targets", asJson(targets(report))));
}

}  // namespace shoal::bench
