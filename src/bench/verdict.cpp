#include "bench/bench.h"

#include <algorithm>
#include <functional>

namespace shoal::bench {

namespace {

using Test = std::function<bool(const BenchCase&)>;

const BenchResult* find(const std::vector<BenchResult>& all, const Test& test) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const BenchResult& result) {
        return result.frame.min > 0 && test(result.benchCase);
    });
    return found == all.end() ? nullptr : &*found;
}

const BenchResult* labelled(const std::vector<BenchResult>& all, const std::string& group,
                            const std::string& label) {
    return find(all, [&](const BenchCase& benchCase) {
        return benchCase.group == group && benchCase.label == label;
    });
}

std::optional<double> over(const BenchResult* a, const BenchResult* b) {
    if (!a || !b) return std::nullopt;
    return a->frame.min / b->frame.min;
}

double bandwidthOf(const BenchResult& result) {
    return double(result.movedBytes) / result.frame.min;
}

bool comparable(const BenchCase& benchCase) {
    return !isCopy(benchCase.subject) && benchCase.subject != Subject::multiplyAdd;
}

// The baselines run the uniform wind and draw nothing.
std::optional<double> againstBaseline(const BenchResult& result, const std::vector<BenchResult>& all,
                                      Subject subject) {
    const BenchCase& benchCase = result.benchCase;
    if (benchCase.drawn || benchCase.wind != Wind::uniform || !comparable(benchCase)) return std::nullopt;
    return over(&result, find(all, [&](const BenchCase& other) {
        return other.group == benchCase.group && other.subject == subject &&
               other.substeps == benchCase.substeps;
    }));
}

std::optional<double> againstPingPong(const BenchResult& result, const std::vector<BenchResult>& all) {
    const BenchCase& benchCase = result.benchCase;
    if (!comparable(benchCase)) return std::nullopt;
    return over(find(all,
                     [&](const BenchCase& other) {
                         return other.group == benchCase.group && other.subject == Subject::pingPong &&
                                other.substeps == benchCase.substeps && other.solver == benchCase.solver &&
                                other.wind == benchCase.wind && other.drawn == benchCase.drawn;
                     }),
                &result);
}

std::optional<double> shareOfCopy(const BenchResult& result, const std::vector<BenchResult>& all) {
    const bool device = isPath(result.benchCase.subject);
    double best = 0;
    for (const BenchResult& other : all) {
        const bool alike = isCopy(other.benchCase.subject) &&
                           other.benchCase.group == result.benchCase.group &&
                           (other.benchCase.subject == Subject::memoryCopy) != device;
        if (alike && other.frame.min > 0) best = std::max(best, bandwidthOf(other));
    }
    if (best == 0) return std::nullopt;
    return bandwidthOf(result) / best;
}

// How many times as long `slow` takes as `fast`.
Target times(const std::string& what, double limit, bool atLeast, const BenchResult* slow,
             const BenchResult* fast) {
    Target out{what, limit, atLeast};
    if (!slow || !fast) return out;
    out.measured = slow->frame.min / fast->frame.min;
    out.ofMedians = slow->frame.median / fast->frame.median;
    return out;
}

void addSpeed(std::vector<Target>& out, const std::vector<BenchResult>& all) {
    const auto fused = [&](const std::string& group) { return labelled(all, group, "fused"); };
    for (const auto& [baseline, limit] : {std::pair("AVX-512", 4.0), std::pair("AVX2", 2.5)})
        for (const std::string group : {"16,384 quads", "131,072 quads", "16,384 crosses"})
            out.push_back(times(std::string("fused over the ") + baseline + " limit, " + group, limit, false,
                                fused(group), labelled(all, group, baseline)));
    const std::string fish = "16,384 fish", many = "131,072 quads";
    out.push_back(times("fused over the AVX-512 limit, " + fish, 6, false, fused(fish),
                        labelled(all, fish, "AVX-512")));
    out.push_back(times("fused faster than ping-pong, " + many, 10, true, labelled(all, many, "ping-pong"),
                        fused(many)));
    out.push_back(times("AVX-512 faster than plain scalar code, " + many, 15, true,
                        labelled(all, many, "scalar"), labelled(all, many, "AVX-512")));
}

void addFlatness(std::vector<Target>& out, const std::vector<BenchResult>& all) {
    std::vector<double> medians, minima;
    for (const char* group : {"16,384 quads", "131,072 quads", "1,048,576 quads"}) {
        const BenchResult* result = labelled(all, group, "fused");
        if (!result) continue;
        medians.push_back(result->frame.median / result->benchCase.count);
        minima.push_back(result->frame.min / result->benchCase.count);
    }
    Target flat{"fused, slowest over fastest time per quad from 16,384 to 1,048,576", 1.25, false};
    const auto spread = [](const std::vector<double>& values) {
        return *std::max_element(values.begin(), values.end()) /
               *std::min_element(values.begin(), values.end());
    };
    if (medians.size() == 3) {
        flat.measured = spread(minima);
        flat.ofMedians = spread(medians);
    }
    out.push_back(flat);
}

void addMemory(std::vector<Target>& out, const std::vector<BenchResult>& all) {
    const std::string group = "16,384 quads";
    const auto bytes = [&](const char* label) -> std::optional<double> {
        const BenchResult* result = labelled(all, group, label);
        if (!result) return std::nullopt;
        return double(result->stateBytes) / result->benchCase.count;
    };
    const std::optional<double> twoSides = bytes("fused"), inPlace = bytes("fused, in place"),
                                drawn = bytes("fused, drawn");
    out.push_back({"device memory of a quad, two sides", 290, false, twoSides, {}});
    out.push_back({"device memory of a quad, in place", 160, false, inPlace, {}});
    std::optional<double> more;
    if (twoSides && drawn) more = *drawn - *twoSides;
    out.push_back({"device memory of a quad, more when drawn", 64, false, more, {}});
    std::optional<double> bus;
    for (const BenchResult& result : all)
        if (result.benchCase.subject == Subject::fused && result.frame.samples > 0)
            bus = std::max(bus.value_or(0), result.busStateBytes);
    out.push_back({"state over the bus a frame, fused", 0, false, bus, {}});
}

}  // namespace

Ratios ratiosOf(const BenchResult& result, const std::vector<BenchResult>& all) {
    Ratios out;
    if (!(result.frame.min > 0)) return out;
    out.avx512 = againstBaseline(result, all, Subject::avx512);
    out.avx2 = againstBaseline(result, all, Subject::avx2);
    out.pingPong = againstPingPong(result, all);
    if (result.operations > 0) out.arithmetic = result.operations / result.frame.min;
    const BenchResult* peak = labelled(all, result.benchCase.group, name(Subject::multiplyAdd));
    if (out.arithmetic && peak && isPath(result.benchCase.subject))
        out.shareOfPeak = *out.arithmetic / (peak->operations / peak->frame.min);
    if (result.movedBytes == 0 || result.benchCase.drawn) return out;
    out.bandwidth = bandwidthOf(result);
    if (!isCopy(result.benchCase.subject)) out.shareOfCopy = shareOfCopy(result, all);
    return out;
}

std::vector<Target> targets(const std::vector<BenchResult>& all, bool software) {
    std::vector<Target> out;
    addSpeed(out, all);
    addFlatness(out, all);
    addMemory(out, all);
    if (software) return out;
    Target share{"share of the copy bandwidth, fused, 1,048,576 quads", 0.6, true};
    if (const BenchResult* result = labelled(all, "1,048,576 quads", "fused"))
        share.measured = ratiosOf(*result, all).shareOfCopy;
    out.push_back(share);
    return out;
}

const BenchResult* speedOf(const BenchError& error, int count, const std::vector<BenchResult>& all) {
    return find(all, [&](const BenchCase& benchCase) {
        return benchCase.molecule == "quad" && benchCase.count == count &&
               benchCase.subject == error.subject && benchCase.solver == error.solver &&
               benchCase.wind == error.wind && benchCase.sampling == error.sampling &&
               benchCase.substeps == 4 && !benchCase.drawn && !benchCase.inPlace;
    });
}

int disturbed(const std::vector<BenchResult>& all) {
    constexpr double much = 1.3;
    return int(std::count_if(all.begin(), all.end(), [](const BenchResult& result) {
        return result.frame.min > 0 && result.frame.median > much * result.frame.min;
    }));
}

std::vector<std::string> distances(const std::vector<BenchResult>& all) {
    std::vector<std::string> out;
    for (const BenchResult& result : all) {
        if (result.benchCase.subject != Subject::fused || result.benchCase.inPlace) continue;
        const Ratios ratios = ratiosOf(result, all);
        if (!ratios.shareOfPeak || !ratios.shareOfCopy) continue;
        out.push_back(
            formatted("%s: %.3g GB/s, %.0f%% of a copy; about %.3g Gflop/s, %.0f%% of multiply-adds alone",
                      result.benchCase.name().c_str(), *ratios.bandwidth * 1e-9, *ratios.shareOfCopy * 100,
                      *ratios.arithmetic * 1e-9, *ratios.shareOfPeak * 100));
    }
    return out;
}

}  // namespace shoal::bench
