// `shoal bench sort`: the sorts in million items a second, beside what others published.
#include <algorithm>
#include <iostream>

#include "app/bench/bench.h"
#include "app/line/commands.h"
#include "bench/sort.h"
#include "core/table.h"

namespace shoal::app {

using namespace bench;

namespace {

struct Report {
    MeasuredOn machine;
    double secondsASize = 0;
    std::vector<SortTable> tables;
};

// Ratios of the shortest times of one size, the largest of this run for which all sorts ran.
std::vector<Target> targets(const Report& report) {
    const auto last = std::find_if(report.tables.rbegin(), report.tables.rend(),
                                   [](const SortTable& table) { return table.side <= SortTable::mostOfAll; });
    const SortTable& table = *last;
    const SortTime* radix = table.find(SortMethod::radix);
    const SortTime* bitonic = table.find(SortMethod::bitonic);
    const auto over = [&](const SortTime* slow) -> std::optional<double> {
        if (!radix || !slow) return {};
        return slow->seconds.min / radix->seconds.min;
    };
    const std::string suffix = concat(" at ", table.side, " x ", table.side);
    std::vector<Target> out = {
        {"radix, times as fast as bitonic" + suffix, 10, true, over(bitonic)},
        {"radix, times as fast as std::sort" + suffix, 1, true, over(&table.stdSort())}};
    if (!report.machine.context.software && radix)
        out.push_back({"radix, share of the copy bandwidth in each pass" + suffix, 0.25, true,
                       table.shareOfCopy(*radix)});
    const SortTable& most = report.tables.back();
    const SortTime* many = most.find(SortMethod::radix);
    if (!report.machine.context.software && many && most.side > table.side)
        out.push_back({concat("radix, billion items a second at ", most.side, " x ", most.side), 5, true,
                       most.itemsPerSecond(*many) * 1e-9});
    return out;
}

constexpr Column sortColumns[] = {{"case", "case", -32},
                                  {"millionItemsPerSecond", "million/s", 11, "%.2f"},
                                  {"passes", "passes", 8, "%.0f"},
                                  {"minSeconds", "min ms", 10, "%.3f", 1e3},
                                  {"medianSeconds", "median ms", 11, "%.3f", 1e3},
                                  {"deviceMinSeconds", "device ms", 11, "%.3f", 1e3},
                                  {"samples", "samples", 9, "%.0f"},
                                  {"shareOfCopy", "copy", 6, "%.0f%%", 100}};

JsonValue asJson(const SortTable& table, const SortTime& time) {
    JsonValue out = object(key("side", table.side), key("pairs", table.pairs()), key("case", time.name));
    if (!time.leftOut.empty()) return append(out, key("leftOut", time.leftOut));
    append(out, key("passes", time.passes), key("samples", time.seconds.samples),
           key("minSeconds", time.seconds.min), key("medianSeconds", time.seconds.median));
    appendDeviceTime(out, time.device);
    return append(out, key("millionItemsPerSecond", table.itemsPerSecond(time) * 1e-6),
                  key("shareOfCopy", table.shareOfCopy(time)));
}

JsonValue asJson(const PublishedSort& published) {
    return object(key("where", published.where), key("millionItemsPerSecond", published.millionItems));
}

JsonValue asJson(const Report& report) {
    JsonValue cases = JsonValue::makeArray();
    for (const SortTable& table : report.tables)
        for (const SortTime& time : table.times)
            cases.items.push_back(asJson(table, time));
    JsonValue out = headOf(report.machine);
    return append(out, key("secondsASize", report.secondsASize), key("cases", cases),
                  key("published", arrayOf(publishedSorts(), asJson)),
                  key("targets", app::asJson(targets(report))));
}

std::string asText(const Report& report) {
    const JsonValue json = asJson(report);
    std::string out =
        app::asText(report.machine) + "\n" + tableText(sortColumns, json.find("cases")->items, "side");
    out += "\npublished, million/s\n";
    for (const PublishedSort& published : publishedSorts()) {
        out += formatted("  %-40s", published.where);
        for (const double millions : published.millionItems)
            out += formatted("%9.2f", millions);
        out += "\n";
    }
    return out + targetText(json);
}

}  // namespace

int benchSortCommand(const Options& options) {
    BenchSession session(options, 8, 1);
    Report report;
    report.machine = session.machine;
    report.machine.pinned = measure::pinRasteriserThreads();
    report.secondsASize = session.schedule.seconds;
    std::vector<int> sides = {128, 256, 512, SortTable::mostOfAll, 4096};
    if (options.quick) sides.resize(2);
    std::cerr << "This takes about " << roughly(double(sides.size()) * (report.secondsASize + 1)) << ".\n";
    Progress progress("sizes", int(sides.size()));
    for (const int side : sides) {
        report.tables.push_back(measureSorts(side, session.device, session.schedule));
        progress.step();
    }
    session.end();
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

}  // namespace shoal::app
