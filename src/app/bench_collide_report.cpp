#include "app/bench.h"

namespace shoal::app {

using namespace bench;

namespace {

const ContactTimes* find(const CollideReport& report, int quads) {
    for (const ContactTimes& times : report.contact)
        if (times.one.density == "moderate" && times.one.quads == quads && times.leftOut.empty())
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
        if (t.one.density != density) {
            density = t.one.density;
            out += print("\n%s: %.4g m^3 a quad, spheres of %g m at its corners; ms, shortest (median)\n",
                         density.c_str(), t.one.room, ContactCase::radius);
            out +=
                "    quads  contacts            grid          search        response         contact"
                "       baseline  ratio  ns/quad  ns/contact     fused\n";
        }
        if (!t.leftOut.empty()) {
            out += print("%9s  left out: %s\n", grouped(t.one.quads).c_str(), t.leftOut.c_str());
            continue;
        }
        out += print("%9s%10s", grouped(t.one.quads).c_str(), grouped(int(t.contacts)).c_str());
        for (const measure::Spread* spread : {&t.grid, &t.search, &t.response, &t.contact, &t.baseline})
            out += print("%8.2f (%5.4g)", spread->min * 1e3, spread->median * 1e3);
        out += print("%7.2f%9.0f%12.0f%10.2f\n", t.ratio(), t.perQuad() * 1e9,
                     t.contacts > 0 ? t.contact.min * 1e9 / double(t.contacts) : 0, t.fused.min * 1e3);
        if (t.dropped > 0) out += print("%9s  contacts dropped: %u\n", "", t.dropped);
    }
    return out;
}

std::string label(const UberFlowTimes& times) {
    return times.experiment + (times.how.empty() ? "" : ", " + times.how);
}

size_t placeOf(int side) {
    return side == 256 ? 0 : side == 512 ? 1 : 2;
}

std::string uberFlowText(const std::vector<UberFlowTimes>& all) {
    std::string out;
    int side = 0;
    for (const UberFlowTimes& t : all) {
        if (t.side != side) {
            side = t.side;
            out += print(
                "\nUberFlow's experiments, %d x %d particles; ms of a frame's parts, shortest of each\n",
                side, side);
            out += print("  %-34s%9s%9s%9s%9s%9s%9s%11s%11s\n", "", "motion", "contact", "sort", "draw",
                         "frame", "fps", "undrawn", "published");
        }
        out += print("  %-34s", label(t).c_str());
        if (!t.leftOut.empty()) {
            out += " left out: " + t.leftOut + "\n";
            continue;
        }
        for (const measure::Spread* spread : {&t.motion, &t.contact, &t.sort, &t.draw, &t.frame})
            out += spread->min > 0 ? print("%9.2f", spread->min * 1e3) : print("%9s", "-");
        out += print("%9.3g%11.4g", t.framesPerSecond(), t.undrawnFramesPerSecond());
        if (!t.published.empty()) out += print("%11g", t.published[placeOf(side)]);
        out += "\n";
    }
    return out;
}

std::string searchText(const SearchReport& report) {
    if (report.shares.empty()) return "\nsearches left out: need OpenGL 4.3\n";
    std::string out = print(
        "\nshare of the contacts of %s spheres that a search finds; ns: grid and search,"
        " for each contact found\n",
        grouped(report.spheres).c_str());
    out += "  spheres a cell   contacts";
    const size_t kinds = 3;
    for (size_t s = 0; s < kinds; ++s)
        out += print("%12s      ns", name(report.shares[s].search));
    for (size_t i = 0; i < report.shares.size(); ++i) {
        const SearchShare& share = report.shares[i];
        if (i % kinds == 0) out += print("\n  %14g%11s", share.perCell, grouped(int(share.contacts)).c_str());
        out += print("%11.1f%%%8.0f", share.share() * 100, share.perContact() * 1e9);
    }
    const size_t steps = report.steps.size() / kinds;
    out += print(
        "\n\nshare of the contacts of %s spheres in flight, %g a cell, that a look after every step"
        " finds\n",
        grouped(report.movingSpheres).c_str(), report.movingPerCell);
    out += "  radii in a step  contacts";
    for (size_t s = 0; s < kinds; ++s)
        out += print("%12s", name(report.steps[s * steps].search));
    for (size_t i = 0; i < steps; ++i) {
        out += print("\n  %15g%10s", report.steps[i].step, grouped(int(report.steps[i].contacts)).c_str());
        for (size_t s = 0; s < kinds; ++s)
            out += print("%11.1f%%", report.steps[s * steps + i].share() * 100);
    }
    return out + "\n";
}

JsonValue number(double value) {
    return JsonValue::makeNumber(value);
}

JsonValue asJson(const measure::Spread& spread) {
    JsonValue out = JsonValue::makeObject();
    return out.add("minSeconds", number(spread.min))
        .add("medianSeconds", number(spread.median))
        .add("samples", number(spread.samples));
}

JsonValue asJson(const ContactTimes& t) {
    JsonValue out = JsonValue::makeObject();
    out.add("density", JsonValue::makeString(t.one.density))
        .add("quads", number(t.one.quads))
        .add("cubicMetresPerQuad", number(t.one.room));
    if (!t.leftOut.empty()) return out.add("leftOut", JsonValue::makeString(t.leftOut));
    return out.add("spheres", number(double(t.spheres)))
        .add("contacts", number(double(t.contacts)))
        .add("baselineContacts", number(double(t.baselineContacts)))
        .add("dropped", number(t.dropped))
        .add("bytes", number(double(t.bytes)))
        .add("grid", asJson(t.grid))
        .add("search", asJson(t.search))
        .add("response", asJson(t.response))
        .add("contact", asJson(t.contact))
        .add("baseline", asJson(t.baseline))
        .add("fusedStep", asJson(t.fused))
        .add("nanosecondsPerQuad", number(t.perQuad() * 1e9))
        .add("overBaseline", number(t.ratio()));
}

JsonValue asJson(const UberFlowTimes& t) {
    JsonValue out = JsonValue::makeObject();
    out.add("experiment", JsonValue::makeString(t.experiment))
        .add("how", JsonValue::makeString(t.how))
        .add("side", number(t.side));
    if (!t.leftOut.empty()) return out.add("leftOut", JsonValue::makeString(t.leftOut));
    return out.add("motion", asJson(t.motion))
        .add("contact", asJson(t.contact))
        .add("sort", asJson(t.sort))
        .add("draw", asJson(t.draw))
        .add("frame", asJson(t.frame))
        .add("framesPerSecond", number(t.framesPerSecond()))
        .add("undrawnFramesPerSecond", number(t.undrawnFramesPerSecond()))
        .add("publishedFramesPerSecond",
             t.published.empty() ? JsonValue() : number(t.published[placeOf(t.side)]));
}

JsonValue asJson(const SearchReport& report) {
    JsonValue shares = JsonValue::makeArray(), steps = JsonValue::makeArray();
    for (const SearchShare& share : report.shares) {
        JsonValue one = JsonValue::makeObject();
        one.add("search", JsonValue::makeString(name(share.search)))
            .add("spheresPerCell", number(share.perCell))
            .add("contacts", number(double(share.contacts)))
            .add("found", number(double(share.found)))
            .add("gridAndSearch", asJson(share.time))
            .add("nanosecondsPerContact", number(share.perContact() * 1e9));
        shares.items.push_back(std::move(one));
    }
    for (const StepShare& step : report.steps) {
        JsonValue one = JsonValue::makeObject();
        one.add("search", JsonValue::makeString(name(step.search)))
            .add("radiiInAStep", number(step.step))
            .add("contacts", number(double(step.contacts)))
            .add("found", number(double(step.found)));
        steps.items.push_back(std::move(one));
    }
    JsonValue out = JsonValue::makeObject();
    return out.add("spheres", number(report.spheres))
        .add("overDensity", std::move(shares))
        .add("spheresInFlight", number(report.movingSpheres))
        .add("overSpeed", std::move(steps));
}

}  // namespace

std::string asText(const CollideReport& report) {
    std::string out = asText(report.machine);
    out += "\n" + contactText(report.contact) + uberFlowText(report.uberFlow);
    if (report.searches) out += searchText(*report.searches);
    if (report.contact.empty()) return out;
    return out + "\n" + asText(targets(report), "%.2f");
}

JsonValue asJson(const CollideReport& report) {
    JsonValue contact = JsonValue::makeArray(), uberFlow = JsonValue::makeArray();
    for (const ContactTimes& times : report.contact)
        contact.items.push_back(asJson(times));
    for (const UberFlowTimes& times : report.uberFlow)
        uberFlow.items.push_back(asJson(times));
    JsonValue out = headOf(report.machine);
    return out.add("secondsAGroup", number(report.secondsAGroup))
        .add("contact", std::move(contact))
        .add("uberFlow", std::move(uberFlow))
        .add("searches", report.searches ? asJson(*report.searches) : JsonValue())
        .add("targets", app::asJson(targets(report)));
}

}  // namespace shoal::app
