#include "simulate/places.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "gpu/buffer.h"

namespace shoal {

using gpu::Barrier;
using gpu::Buffer;
using gpu::Program;
using gpu::Traffic;

namespace {

constexpr double never = -std::numeric_limits<double>::infinity();

constexpr int wordsOfLane = 8, groupLanes = 128, scanLanes = 256;

int lanesOf(size_t places) {
    constexpr size_t placesOfLane = size_t(wordsOfLane) * 32;
    return int((places + placesOfLane - 1) / placesOfLane);
}

int groupsOf(const PlaceSet& set) {
    return (lanesOf(size_t(set.places)) + groupLanes - 1) / groupLanes;
}

}  // namespace

// A stack hands out the first places first.
Places::Places(Allocator allocator, size_t count) : allocator_(allocator), ends_(count, never), free_(count) {
    std::iota(free_.begin(), free_.end(), uint32_t(0));
    if (allocator == Allocator::stack) std::reverse(free_.begin(), free_.end());
}

void Places::giveBack(uint32_t place) {
    ends_[place] = never;
    free_.push_back(place);
    if (allocator_ == Allocator::heap) std::push_heap(free_.begin(), free_.end(), std::greater<>());
}

void Places::freeUntil(double time) {
    while (!next_.empty() && next_.top().first <= time) {
        giveBack(next_.top().second);
        next_.pop();
    }
    while (mark_ > 0 && ends_[size_t(mark_) - 1] == never)
        --mark_;
}

bool Places::take(double end, uint32_t& place) {
    if (free_.empty()) return false;
    if (allocator_ == Allocator::heap) std::pop_heap(free_.begin(), free_.end(), std::greater<>());
    place = free_.back();
    free_.pop_back();
    ends_[place] = end;
    next_.emplace(end, place);
    mark_ = std::max(mark_, int(place) + 1);
    return true;
}

std::vector<uint32_t> Places::stack() const {
    if (allocator_ != Allocator::stack) return {};
    std::vector<uint32_t> out = free_;
    out.resize(ends_.size());
    return out;
}

void Places::restore(const std::vector<double>& ends, const std::vector<uint32_t>& stack, double now) {
    ends_ = ends;
    free_.clear();
    next_ = {};
    mark_ = 0;
    for (uint32_t place = 0; place < ends_.size(); ++place) {
        if (ends_[place] > now) {
            next_.emplace(ends_[place], place);
            mark_ = int(place) + 1;
        } else {
            ends_[place] = never;
            free_.push_back(place);  // ascending: a heap as it is
        }
    }
    if (allocator_ != Allocator::stack) return;
    if (stack.size() == ends_.size())
        std::copy_n(stack.begin(), free_.size(), free_.begin());
    else
        std::reverse(free_.begin(), free_.end());
}

int mostPlaces(const Plan& plan) {
    int most = 1;
    for (const GroupPlan& group : plan.groups)
        if (group.life) most = std::max(most, group.count);
    return most;
}

void settleBirths() {
    gpu::barrier({Barrier::textureFetch, Barrier::storage, Barrier::command});
}

PlaceLists::PlaceLists(gpu::Context& context, size_t groups, size_t mostPlaces) {
    const auto program = [&](const char* file, bool deaths, int lanes) {
        gpu::ProgramOptions options;
        options.compute = concat("births/", file, ".comp");
        options.label = concat(file, deaths ? " of deaths" : " of places");
        options.defines = {concat("LANES ", lanes), concat("WORDS ", wordsOfLane)};
        if (deaths) options.defines.emplace_back("DEATHS");
        return Program(context, options);
    };
    count_ = program("bits_count", false, groupLanes);
    scanPlaces_ = program("bits_scan", false, scanLanes);
    listPlaces_ = program("bits_list", false, groupLanes);
    scanDeaths_ = program("bits_scan", true, scanLanes);
    listDeaths_ = program("bits_list", true, groupLanes);
    const size_t sums = size_t(std::max(1, lanesOf(mostPlaces)));
    sums_ = Buffer(context, Buffer::Use::storage, nullptr, sums * 2 * sizeof(uint32_t), "sums of places");
    const std::vector<uint32_t> none(groups * control::words);
    control_ = Buffer(context, Buffer::Use::storage, none.data(), none.size() * sizeof(uint32_t),
                      "control of births");
}

size_t PlaceLists::bytesOf(size_t places) {
    return size_t(lanesOf(places)) * wordsOfLane * sizeof(uint32_t);
}

void PlaceLists::setUp(const Program& program, const PlaceSet& set) const {
    program.use();
    program.storage("Counts", sums_);
    program.storage("Control", control_);
    program.set("laneCount", lanesOf(size_t(set.places)));
    program.set("placeCount", set.places);
    program.set("controlBase", int(control::of(set.group)));
}

void PlaceLists::setReach(const Program& program, const PlaceSet& set) const {
    program.storage("StepGroups", *set.stepGroups);
    program.set("stepLanes", set.stepLanes);
    program.set("partPlaces", set.partPlaces);
    program.set("partCount", set.partCount);
}

void PlaceLists::writeList(const Program& program, const PlaceSet& set, const Buffer& bits,
                           const Buffer& list, size_t at, std::span<const ListRange> ranges) const {
    program.storage("Bits", bits);
    for (const ListRange& range : ranges) {
        program.storage("List", list, (at + range.first) * sizeof(uint32_t), range.count * sizeof(uint32_t));
        program.set("listFirst", int(range.first));
        program.set("listCount", int(range.count));
        program.set("clears", int(&range == &ranges.back()));
        program.dispatch(groupsOf(set));
        settleBirths();
    }
}

void PlaceLists::sum(const PlaceSet& set, const Buffer& bits) {
    count_.use();
    count_.storage("Bits", bits);
    count_.storage("Counts", sums_);
    count_.set("laneCount", lanesOf(size_t(set.places)));
    count_.set("placeCount", set.places);
    count_.dispatch(groupsOf(set));
    settleBirths();
}

void PlaceLists::listDeaths(const PlaceSet& set, const Buffer& bits, const Buffer& list, size_t at,
                            std::span<const ListRange> ranges) {
    sum(set, bits);
    setUp(scanDeaths_, set);
    scanDeaths_.dispatch(1);
    settleBirths();
    setUp(listDeaths_, set);
    writeList(listDeaths_, set, bits, list, at, ranges);
}

void PlaceLists::countPlaces(const PlaceSet& set, const Buffer& bits, int scheduled,
                             std::span<const glm::ivec4> deaths, bool allocates) {
    sum(set, bits);
    setUp(scanPlaces_, set);
    scanPlaces_.set("scheduled", scheduled);
    scanPlaces_.set("allocates", int(allocates));
    setReach(scanPlaces_, set);
    scanPlaces_.set("deathRunCount", int(deaths.size()));
    scanPlaces_.set("deathRuns", deaths);
    scanPlaces_.dispatch(1);
    settleBirths();
}

void PlaceLists::listPlaces(const PlaceSet& set, const Buffer& bits, const Buffer& list,
                            std::span<const ListRange> ranges) {
    setUp(listPlaces_, set);
    setReach(listPlaces_, set);
    writeList(listPlaces_, set, bits, list, 0, ranges);
}

void PlaceLists::readControl(size_t group, uint32_t* words) const {
    control_.download(Traffic::Kind::control, control::of(group) * sizeof(uint32_t), words,
                      control::words * sizeof(uint32_t));
}

void PlaceLists::writeControl(size_t group, const uint32_t* words) {
    control_.update(Traffic::Kind::state, control::of(group) * sizeof(uint32_t), words,
                    control::words * sizeof(uint32_t));
}

}  // namespace shoal
