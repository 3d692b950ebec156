#include <algorithm>

#include "bench/reports.h"
#include "core/table.h"

namespace shoal::bench {

namespace {

// Ratios of the shortest times of one size, the largest of this run for which all sorts ran.
std::vector<Target> targets(const SortReport& report) {
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

}  // namespace

JsonValue asJson(const SortReport& report) {
    JsonValue cases = JsonValue::makeArray();
    for (const SortTable& table : report.tables)
        for (const SortTime& time : table.times)
            cases.items.push_back(asJson(table, time));
    JsonValue out = headOf(report.machine);
    return append(out, key("secondsASize", report.secondsASize), key("cases", cases),
                  key("published", arrayOf(publishedSorts(), asJson)),
                  key("targets", bench::asJson(targets(report))));
}

std::string asText(const SortReport& report) {
    const JsonValue json = asJson(report);
    std::string out =
        bench::asText(report.machine) + "\n" + tableText(sortColumns, json.find("cases")->items, "side");
    out += "\npublished, million/s\n";
    for (const PublishedSort& published : publishedSorts()) {
        out += formatted("  %-40s", published.where);
        for (const double millions : published.millionItems)
            out += formatted("%9.2f", millions);
        out += "\n";
    }
    return out + targetText(json);
}

}  // namespace shoal::bench
