// `shoal bench sort`: the sorts in million items a second, beside what others published.
#include <algorithm>
#include <iostream>

#include "app/bench.h"
#include "app/commands.h"
#include "bench/sort.h"
#include "core/cache_folder.h"
#include "core/json.h"
#include "measure/timing.h"
#include "run/data_paths.h"
#include "run/progress.h"

namespace shoal::app {

using namespace bench;

namespace {

struct Report {
    MeasuredOn machine;
    double secondsASize = 0;
    std::vector<SortTable> tables;
};

// Ratios of the shortest times of one size, the largest of this run.
std::vector<Target> targets(const Report& report) {
    const SortTable& table = report.tables.back();
    const SortTime* radix = table.find(SortMethod::radix);
    const SortTime* bitonic = table.find(SortMethod::bitonic);
    const auto over = [&](const SortTime* slow) -> std::optional<double> {
        if (!radix || !slow) return {};
        return slow->seconds.min / radix->seconds.min;
    };
    const std::string at = concat(" at ", table.side, " x ", table.side);
    std::vector<Target> out = {{"radix, times as fast as bitonic" + at, 10, true, over(bitonic)},
                               {"radix, times as fast as std::sort" + at, 1, true, over(&table.stdSort())}};
    if (!report.machine.context.software && radix)
        out.push_back(
            {"radix, share of the copy bandwidth in each pass" + at, 0.25, true, table.shareOfCopy(*radix)});
    return out;
}

void printRates(const Report& report) {
    std::cout << "million items/s, by the shortest time     ";
    for (const SortTable& table : report.tables)
        std::cout << measure::formatted("%10.0f", table.side) << measure::formatted(" x %-4.0f", table.side);
    std::cout << "\n";
    const auto begin = [](std::string label) {
        label.resize(std::max<size_t>(label.size(), 40), ' ');
        std::cout << "  " << label;
    };
    for (size_t i = 0; i < report.tables[0].times.size(); ++i) {
        const SortTime& first = report.tables[0].times[i];
        begin(first.name);
        if (!first.leftOut.empty()) {
            std::cout << "  left out: " << first.leftOut << "\n";
            continue;
        }
        for (const SortTable& table : report.tables)
            std::cout << measure::formatted("%17.2f", table.itemsPerSecond(table.times[i]) * 1e-6);
        std::cout << "\n";
    }
    for (const PublishedSort& published : publishedSorts()) {
        begin(published.where);
        for (size_t i = 0; i < report.tables.size(); ++i)
            std::cout << measure::formatted("%17.2f", published.millionItems[i]);
        std::cout << "\n";
    }
}

void printTimes(const Report& report) {
    for (const SortTable& table : report.tables) {
        std::cout << "\n"
                  << table.side << " x " << table.side
                  << "                          passes    min ms  median ms  samples  GB/s a pass  copy\n";
        for (const SortTime& time : table.times) {
            if (!time.leftOut.empty()) continue;
            std::cout << "  " << time.name << std::string(32 - std::min<size_t>(32, time.name.size()), ' ')
                      << (time.passes > 0 ? measure::formatted("%6.0f", time.passes) : "     -")
                      << measure::formatted("%10.3f", time.seconds.min * 1e3)
                      << measure::formatted("%11.3f", time.seconds.median * 1e3)
                      << measure::formatted("%9.0f", time.seconds.samples);
            const double passes = time.copy ? 1 : time.passes;
            if (passes > 0)
                std::cout << measure::formatted("%13.2f",
                                                passes * 16e-9 * double(table.pairs()) / time.seconds.min);
            if (const auto share = table.shareOfCopy(time))
                std::cout << measure::formatted("%5.0f%%", 100 * *share);
            std::cout << "\n";
        }
    }
}

void print(const Report& report) {
    std::cout << asText(report.machine);
    std::cout << "\n\n";
    printRates(report);
    printTimes(report);
    std::cout << "\n" << asText(targets(report), "%.2f");
}

JsonValue asJson(const SortTable& table, const SortTime& time) {
    JsonValue out = JsonValue::makeObject();
    out.add("side", JsonValue::makeNumber(table.side))
        .add("pairs", JsonValue::makeNumber(double(table.pairs())))
        .add("case", JsonValue::makeString(time.name));
    if (!time.leftOut.empty()) return out.add("leftOut", JsonValue::makeString(time.leftOut));
    const std::optional<double> share = table.shareOfCopy(time);
    return out.add("passes", JsonValue::makeNumber(time.passes))
        .add("samples", JsonValue::makeNumber(time.seconds.samples))
        .add("minSeconds", JsonValue::makeNumber(time.seconds.min))
        .add("medianSeconds", JsonValue::makeNumber(time.seconds.median))
        .add("millionItemsPerSecond", JsonValue::makeNumber(table.itemsPerSecond(time) * 1e-6))
        .add("shareOfCopy", share ? JsonValue::makeNumber(*share) : JsonValue());
}

JsonValue asJson(const Report& report) {
    JsonValue cases = JsonValue::makeArray(), published = JsonValue::makeArray();
    for (const SortTable& table : report.tables)
        for (const SortTime& time : table.times)
            cases.items.push_back(asJson(table, time));
    for (const PublishedSort& row : publishedSorts()) {
        JsonValue rates = JsonValue::makeArray();
        for (const double rate : row.millionItems)
            rates.items.push_back(JsonValue::makeNumber(rate));
        published.items.push_back(JsonValue::makeObject()
                                      .add("where", JsonValue::makeString(row.where))
                                      .add("millionItemsPerSecond", std::move(rates)));
    }
    JsonValue out = headOf(report.machine);
    return out.add("secondsASize", JsonValue::makeNumber(report.secondsASize))
        .add("cases", std::move(cases))
        .add("published", std::move(published))
        .add("targets", app::asJson(targets(report)));
}

}  // namespace

int benchSortCommand(const Options& options) {
    gpu::Context context(hiddenContext(options));
    gpu::ProgramCache cache(context, cacheFolder());
    Report report;
    report.machine = measuredOn(context);
    report.machine.pinned = measure::pinRasteriserThreads();
    report.secondsASize = options.seconds.value_or(options.quick ? 1 : 8);
    measure::Schedule schedule;
    schedule.seconds = report.secondsASize;
    std::vector<int> sides = {128, 256, 512, 1024};
    if (options.quick) sides.resize(2);
    std::cerr << "This takes about " << roughly(double(sides.size()) * (report.secondsASize + 1)) << ".\n";
    Progress progress("sizes", int(sides.size()));
    for (const int side : sides) {
        report.tables.push_back(measureSorts(side, {&context, shaderRoot(), &cache}, schedule));
        progress.step();
    }
    tellWarnings(cache.takeWarnings());
    if (options.json)
        std::cout << writeJson(asJson(report));
    else
        print(report);
    return 0;
}

}  // namespace shoal::app
