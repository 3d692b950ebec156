#include "app/bench.h"

namespace shoal::app {

using namespace bench;

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

std::string contactText(const std::vector<ContactTimes>& all) {
    std::string out, density;
    for (const ContactTimes& t : all) {
        if (t.benchCase.density != density) {
            density = t.benchCase.density;
            out += formatted("\n%s: %.4g m^3 a quad, spheres of %g m at its corners; ms, shortest (median)\n",
                             density.c_str(), t.benchCase.room, ContactCase::radius);
            out +=
                "    quads  contacts            grid          search        response         contact"
                "       baseline  ratio  ns/quad  ns/contact     fused    device\n";
        }
        if (!t.leftOut.empty()) {
            out += formatted("%9s  left out: %s\n", grouped(t.benchCase.quads).c_str(), t.leftOut.c_str());
            continue;
        }
        out += formatted("%9s%10s", grouped(t.benchCase.quads).c_str(), grouped(int(t.contacts)).c_str());
        for (const measure::Spread* spread : {&t.grid, &t.search, &t.response, &t.contact, &t.baseline})
            out += formatted("%8.2f (%5.4g)", spread->min * 1e3, spread->median * 1e3);
        out += formatted("%7.2f%9.0f%12.0f%10.2f%10s\n", t.ratio(), t.perQuad() * 1e9,
                         t.contacts > 0 ? t.contact.min * 1e9 / double(t.contacts) : 0, t.fused.min * 1e3,
                         deviceMilliseconds(t.device).c_str());
        if (t.dropped > 0) out += formatted("%9s  contacts dropped: %u\n", "", t.dropped);
    }
    return out;
}

std::string searchText(const SearchReport& report) {
    if (report.shares.empty()) return "\nsearches left out: need OpenGL 4.3\n";
    std::string out = formatted(
        "\nshare of the contacts of %s spheres that a search finds; ns: grid and search,"
        " for each contact found\n",
        grouped(report.spheres).c_str());
    out += "  spheres a cell   contacts";
    const size_t kinds = 3;
    for (size_t s = 0; s < kinds; ++s)
        out += formatted("%12s      ns", name(report.shares[s].search));
    for (size_t i = 0; i < report.shares.size(); ++i) {
        const SearchShare& share = report.shares[i];
        if (i % kinds == 0)
            out += formatted("\n  %14g%11s", share.perCell, grouped(int(share.contacts)).c_str());
        out += formatted("%11.1f%%%8.0f", share.share() * 100, share.perContact() * 1e9);
    }
    const size_t steps = report.steps.size() / kinds;
    out += formatted(
        "\n\nshare of the contacts of %s spheres in flight, %g a cell, that a look after every step"
        " finds\n",
        grouped(report.movingSpheres).c_str(), report.movingPerCell);
    out += "  radii in a step  contacts";
    for (size_t s = 0; s < kinds; ++s)
        out += formatted("%12s", name(report.steps[s * steps].search));
    for (size_t i = 0; i < steps; ++i) {
        out +=
            formatted("\n  %15g%10s", report.steps[i].step, grouped(int(report.steps[i].contacts)).c_str());
        for (size_t s = 0; s < kinds; ++s)
            out += formatted("%11.1f%%", report.steps[s * steps + i].share() * 100);
    }
    return out + "\n";
}

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

}  // namespace

std::string asText(const CollideReport& report) {
    std::string out = asText(report.machine);
    out += "\n" + contactText(report.contact);
    if (report.searches) out += searchText(*report.searches);
    if (report.contact.empty()) return out;
    return out + "\n" + asText(targets(report), "%.2f");
}

JsonValue asJson(const CollideReport& report) {
    JsonValue out = headOf(report.machine);
    return append(out, key("secondsAGroup", report.secondsAGroup),
                  key("contact", arrayOf(report.contact, asJson)),
                  key("searches", report.searches ? asJson(*report.searches) : JsonValue()),
                  key("targets", asJson(targets(report))));
}

}  // namespace shoal::app
