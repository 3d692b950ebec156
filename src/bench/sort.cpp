#include "bench/sort.h"

#include <algorithm>
#include <memory>
#include <random>

#include "core/error.h"
#include "gpu/gl.h"

namespace shoal::bench {

namespace {

using KeyPairs = std::vector<KeyIndex>;

// One case, made once and run in turn with the others.
class SortRunner {
  public:
    virtual ~SortRunner() = default;
    virtual void restart() = 0;
    virtual void run() = 0;
    virtual void finish() { glFinish(); }
    virtual bool isSorted() = 0;
    int passes = 0;
};

bool ascending(const KeyPairs& pairs, size_t first, size_t end) {
    return std::is_sorted(pairs.begin() + ptrdiff_t(first), pairs.begin() + ptrdiff_t(end),
                          [](const KeyIndex& a, const KeyIndex& b) { return a.key < b.key; });
}

class DeviceSort final : public SortRunner {
  public:
    DeviceSort(const BenchDevice& device, SortMethod method, bool rowsOnly, int side, const KeyPairs& input)
        : input_(input),
          rowsOnly_(rowsOnly),
          side_(size_t(side)),
          sorter_(*device.context, method, input.size(),
                  method == SortMethod::radix || method == SortMethod::cpu ? 0 : side) {
        restart();
        if (rowsOnly)
            passes = int(bitonicPasses(side_).size());
        else
            passes = sorter_.passes();
    }
    void restart() override {
        sorter_.upload(input_);
        glFinish();
    }
    void run() override {
        if (rowsOnly_)
            sorter_.sortRows();
        else
            sorter_.sort();
    }
    bool isSorted() override {
        const KeyPairs out = sorter_.download();
        const size_t block = rowsOnly_ ? side_ : out.size();
        for (size_t first = 0; first < out.size(); first += block)
            if (!ascending(out, first, first + block)) return false;
        return true;
    }

  private:
    const KeyPairs& input_;
    bool rowsOnly_;
    size_t side_;
    Sorter sorter_;
};

// In memory, one thread, as 64-bit numbers with the key above the index.
class StdSort final : public SortRunner {
  public:
    explicit StdSort(const KeyPairs& input) : input_(input), pairs_(input.size()) { restart(); }
    void restart() override {
        std::transform(input_.begin(), input_.end(), pairs_.begin(),
                       [](const KeyIndex& pair) { return uint64_t(pair.key) << 32 | pair.index; });
    }
    void run() override { std::sort(pairs_.begin(), pairs_.end()); }
    void finish() override {}
    bool isSorted() override { return std::is_sorted(pairs_.begin(), pairs_.end()); }

  private:
    const KeyPairs& input_;
    std::vector<uint64_t> pairs_;
};

class PairCopy : public SortRunner {
  public:
    PairCopy(const BenchDevice& device, const KeyPairs& input)
        : from_(*device.context, gpu::Buffer::Use::storage, std::span<const KeyIndex>(input), "copied"),
          to_(*device.context, gpu::Buffer::Use::storage, std::span<const KeyIndex>(input), "copy") {}
    void restart() override {}
    void run() override { from_.copyTo(to_, to_.bytes()); }
    bool isSorted() override { return true; }

  private:
    gpu::Buffer from_, to_;
};

// The sorts that there are, with why one is left out; then std::sort and the copy.
std::vector<SortTime> sortsOf(int side, const gpu::ContextInfo& info) {
    std::vector<SortTime> out;
    for (const SortMethodRow& method : sortMethods()) {
        for (const bool rowsOnly : {false, true}) {
            if (rowsOnly && !method.rowsOnly) continue;
            SortTime& time = out.emplace_back();
            time.name = concat(method.name, rowsOnly ? ", rows only" : "");
            time.method = method.method;
            time.rowsOnly = rowsOnly;
            if (side > SortTable::mostOfAll && method.method != SortMethod::radix)
                time.leftOut = "too slow for so many";
            else if (!canRun(method.method, info))
                time.leftOut = concat("needs OpenGL ", method.major, ".", method.minor, "; this context has ",
                                      info.major, ".", info.minor);
        }
    }
    out.push_back({.name = "std::sort, one thread"});
    out.push_back({.name = "copy", .copy = true});
    return out;
}

std::unique_ptr<SortRunner> runnerOf(const SortTime& time, int side, const BenchDevice& device,
                                     const KeyPairs& input) {
    if (time.method) return std::make_unique<DeviceSort>(device, *time.method, time.rowsOnly, side, input);
    if (time.copy) return std::make_unique<PairCopy>(device, input);
    return std::make_unique<StdSort>(input);
}

class SortEntrant {
  public:
    SortEntrant(SortTime& time, int side, const BenchDevice& device, const KeyPairs& input)
        : time_(time),
          runner_(runnerOf(time, side, device, input)),
          ownTimes_(device.ownTimes && (time.method || time.copy)) {
        time.passes = runner_->passes;
    }
    void warmUp() {
        runner_->run();
        if (!runner_->isSorted()) throw Error(concat("bench sort: ", time_.name, " did not sort"));
        seconds = measure::secondsOf([&] {
            runner_->restart();
            runner_->run();
            runner_->finish();
        });
    }
    void visit() {
        runner_->restart();
        samples_.push_back(measure::secondsOf([&] {
            runner_->run();
            runner_->finish();
        }));
        if (!ownTimes_) return;
        runner_->restart();
        device_.push_back(timer_.secondsOf([&] { runner_->run(); }));
    }
    void finish() {
        time_.seconds = measure::spreadOf(std::move(samples_));
        time_.device = measure::spreadOf(std::move(device_));
    }

    double seconds = 0;  // of a visit

  private:
    SortTime& time_;
    std::unique_ptr<SortRunner> runner_;
    bool ownTimes_;
    gpu::DeviceTimer timer_;
    std::vector<double> samples_, device_;
};

}  // namespace

const SortTime* SortTable::find(SortMethod method, bool rowsOnly) const {
    for (const SortTime& time : times)
        if (time.method == method && time.rowsOnly == rowsOnly && time.leftOut.empty()) return &time;
    return nullptr;
}

std::optional<double> SortTable::shareOfCopy(const SortTime& time) const {
    if (time.method != SortMethod::radix || !time.leftOut.empty() || !copy().leftOut.empty()) return {};
    return time.passes * copy().seconds.min / time.seconds.min;
}

std::vector<KeyIndex> randomKeys(size_t count, uint32_t mask) {
    std::mt19937 random(1);
    std::vector<KeyIndex> out(count);
    for (size_t i = 0; i < count; ++i)
        out[i] = {uint32_t(random()) & mask, uint32_t(i)};
    return out;
}

SortTable measureSorts(int side, const BenchDevice& device, const measure::Schedule& schedule) {
    const KeyPairs input = randomKeys(size_t(side) * size_t(side));
    SortTable out{side, sortsOf(side, device.context->info())};
    measureInTurn(
        out.times, schedule, [](double) {},
        [&](SortTime& time) { return std::make_unique<SortEntrant>(time, side, device, input); });
    return out;
}

// Table 1 counts frames a second, keys and the moving of the particles included; the slides count items.
std::vector<PublishedSort> publishedSorts() {
    const auto fps = [](const char* where, double a, double b, double c, double d) {
        return PublishedSort{where,
                             {a * 128 * 128e-6, b * 256 * 256e-6, c * 512 * 512e-6, d * 1024 * 1024e-6}};
    };
    return {fps("UberFlow, table 1, FP, Radeon 9800 Pro", 22, 3.5, 1, 0.2),
            fps("UberFlow, table 1, GP/FP", 40, 10, 3, 0.4),
            fps("UberFlow, table 1, GP/FP packed", 148, 43, 10, 2),
            {"UberFlow, slides, Radeon 9800 Pro", {2.8, 2.8, 2.4, 2.0}},
            {"UberFlow, slides, Radeon X800 XT", {3.9, 7.2, 6.4, 5.1}}};
}

}  // namespace shoal::bench
