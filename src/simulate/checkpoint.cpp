#include "simulate/checkpoint.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "core/file.h"
#include "simulate/checkpoint_head.h"

namespace shoal {

using checkpoint::Checksum;
using checkpoint::Head;

namespace {

// Begins and ends as PNG's signature does, which shows that a file was sent as text or cut at once.
constexpr char magic[8] = {'\x8c', 'S', 'h', 'o', 'a', 'l', '\r', '\n'};
constexpr uint32_t ownOrder = 0x01020304, otherOrder = 0x04030201;
constexpr uint64_t longestHead = uint64_t(1) << 24;  // bytes
constexpr int mostSubsteps = 1000000;                // that sliders can ask for: substepsNeeded

// ---- Reading

void readAll(FileReader& file, void* data, size_t bytes) {
    if (file.read(data, bytes) != bytes) throw Error(file.location(), "is cut short: its end is missing");
}

template <typename T>
T readOne(FileReader& file) {
    T value;
    readAll(file, &value, sizeof value);
    return value;
}

Head readHead(FileReader& file) {
    const Location& location = file.location();
    char start[sizeof magic] = {};
    if (file.read(start, sizeof start) != sizeof start || std::memcmp(start, magic, sizeof magic) != 0)
        throw Error(location, "is not a checkpoint of Shoal");
    const auto order = readOne<uint32_t>(file);
    if (order == otherOrder) throw Error(location, "was written by a machine with another byte order");
    if (order != ownOrder) throw Error(location, "is damaged: its byte order is none");
    const auto version = readOne<uint32_t>(file);
    if (version != checkpointVersion)
        throw Error(location, concat("is a checkpoint of version ", version, ", this program reads version ",
                                     checkpointVersion));
    const auto length = readOne<uint64_t>(file);
    if (length > longestHead) throw Error(location, "is damaged: its head has no sensible length");
    std::string bytes(size_t(length), '\0');
    readAll(file, bytes.data(), bytes.size());
    Checksum sum;
    sum.add(version);
    sum.add(length);
    sum.add(bytes.data(), bytes.size());
    if (readOne<uint64_t>(file) != sum.sum())
        throw Error(location, "is damaged: the checksum of its head is wrong");
    return checkpoint::unpack(bytes, location);
}

// All arrays of a group in the file's order. A new member of GroupState has to find its place here.
template <typename State, typename Visit>
void forEachArray(State& state, Visit visit) {
    auto& [positions, velocities, anchors, released, displacements, velocityChanges, lives, seeds, looks,
           clocks, totals, ends, freed, steering] = state;
    const auto visitAll = [&](auto&... arrays) { (visit(arrays), ...); };
    visitAll(positions, velocities, anchors, released, displacements, velocityChanges, lives, seeds, looks,
             clocks, totals, ends, freed, steering);
}

// Room for what the file holds, by what its head says.
GroupState emptyState(const GroupPlan& group, int32_t keeps) {
    const bool history = (keeps & checkpoint::keepsHistory) != 0;
    const size_t molecules = size_t(group.count), vertices = molecules * size_t(group.vertexCount);
    GroupState state;
    state.positions.resize(vertices);
    state.velocities.resize(vertices);
    state.anchors.resize(molecules);
    state.released.resize(molecules);
    state.displacements.resize(history ? vertices : 0);
    state.velocityChanges.resize(history ? vertices : 0);
    if (keeps & checkpoint::keepsSteering) state.steering.resize(molecules * steeringElements);
    if (!group.life) return state;
    const Lifecycle& life = group.life->cycle;
    state.lives.resize(molecules);
    state.seeds.resize(molecules);
    state.looks.resize(molecules);
    state.clocks.resize(life.emitters.size());
    state.totals.resize(2);
    if (!group.life->emits()) return state;
    if (life.allocator == Allocator::stack || life.allocator == Allocator::heap) state.ends.resize(molecules);
    if (life.allocator == Allocator::stack) state.freed.resize(molecules);
    return state;
}

// The arrays of what contacts remember in the file's order, with how many elements the head says.
template <typename Memory, typename Visit>
void forEachArray(Memory& memory, const Head& head, Visit visit) {
    visit(memory.counts, head.spheres);
    visit(memory.partners, head.contacts);
    visit(memory.pushes, head.contacts);
    visit(memory.anchors, head.contacts);
    visit(memory.known, head.spheres);
    visit(memory.loads, head.spheres);
    visit(memory.calm, head.spheres);
    visit(memory.walls, head.walls);
    visit(memory.wallPushes, head.walls / 2);
}

// Takes memory as the file has it, and not as its head claims.
template <typename T>
void readGrowing(FileReader& file, std::vector<T>& values, uint64_t count) {
    constexpr uint64_t most = 1 << 16;
    while (values.size() < count) {
        const size_t have = values.size();
        values.resize(have + size_t(std::min(most, count - have)));
        readAll(file, values.data() + have, (values.size() - have) * sizeof(T));
    }
}

void readBody(FileReader& file, const Head& head, const Plan& plan, SavedState& out) {
    Checksum sum;
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        GroupState& state = out.groups.emplace_back(emptyState(plan.groups[g], head.groups[g].keeps));
        forEachArray(state, [&](auto& values) {
            const size_t bytes = values.size() * sizeof values[0];
            readAll(file, values.data(), bytes);
            sum.add(values.data(), bytes);
        });
    }
    forEachArray(out.contacts, head, [&](auto& values, uint64_t count) {
        readGrowing(file, values, count);
        sum.add(values.data(), values.size() * sizeof values[0]);
    });
    if (readOne<uint64_t>(file) != sum.sum())
        throw Error(file.location(), "is damaged: the checksum of its state is wrong");
    char more = 0;
    if (file.read(&more, 1) != 0) throw Error(file.location(), "is damaged: something follows its end");
}

// ---- What a run can go on from

bool sensible(const Parameters& p) {
    for (const double* value : checkpoint::numbersOf(p))
        if (!std::isfinite(*value)) return false;
    return p.frameTime > 0 && p.substeps >= 1 && p.substeps <= mostSubsteps;
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Checksums that fit do not make sense of what was never right.
void checkHead(const Head& head, const Location& location) {
    if (!std::isfinite(head.time) || !std::isfinite(head.step) || head.frames < 0 ||
        !sensible(head.parameters) || !sensible(head.own))
        throw Error(location,
                    "nothing can go on from it: its time, frame number or parameters make no sense");
}

void checkState(const GroupState& state, const GroupPlan& group, const Location& location) {
    const auto refuse = [&](const std::string& what) {
        throw Error(location, concat("nothing can go on from it: group \"", group.name, "\"", what));
    };
    const size_t vertices = size_t(group.vertexCount);
    forEachArray(state, [&](const auto& values) {
        if constexpr (std::is_same_v<decltype(values[0]), const glm::vec3&>) {
            const bool perVertex = values.size() == state.positions.size();
            const auto wrong = std::find_if_not(values.begin(), values.end(), finite);
            if (wrong == values.end()) return;
            const size_t i = size_t(wrong - values.begin());
            refuse(concat(", molecule ", perVertex ? i / vertices : i,
                          perVertex ? concat(", vertex ", i % vertices) : std::string(), " is not finite"));
        }
    });
    const auto any = [](const auto& values, auto wrong) {
        return std::any_of(values.begin(), values.end(), wrong);
    };
    if (any(state.steering, [](const glm::vec4& value) { return !finite(value) || !std::isfinite(value.w); }))
        refuse(" steers by numbers that are not finite");
    const auto places = uint32_t(group.count);
    if (any(state.lives,
            [](const glm::vec2& life) {
                return !std::isfinite(life.x) || !std::isfinite(life.y) || life.x < 0 || life.y < 0;
            }) ||
        any(state.seeds, [](uint32_t seed) { return seed >= 1u << 24; }) ||
        any(state.looks,
            [](const glm::vec2& look) { return !std::isfinite(look.x) || !std::isfinite(look.y); }) ||
        any(state.clocks, [](const BirthClock& clock) { return !(clock.due >= 0 && clock.due < 1); }) ||
        any(state.ends, [](double end) { return std::isnan(end); }) ||
        any(state.freed, [places](uint32_t place) { return place >= places; }))
        refuse(" has births or deaths that make no sense");
    if (std::any_of(state.released.begin(), state.released.end(), [](uint8_t flag) { return flag > 1; }))
        refuse(" has pins that neither hold nor let go");
}

void checkContacts(const ContactMemory& memory, const Location& location) {
    const auto finite4 = [](const glm::vec4& value) { return finite(value) && std::isfinite(value.w); };
    uint64_t contacts = 0;
    for (const uint32_t count : memory.counts)
        contacts += count;
    bool sensible = contacts == memory.partners.size();
    for (const uint32_t partner : memory.partners)
        sensible = sensible && partner < memory.counts.size();
    for (const auto* values : {&memory.pushes, &memory.anchors, &memory.known, &memory.loads, &memory.calm,
                               &memory.walls, &memory.wallPushes})
        sensible = sensible && std::all_of(values->begin(), values->end(), finite4);
    const size_t walls = 2 * size_t(ContactPlan::mostColliders) * memory.counts.size();
    sensible = sensible && (memory.walls.empty() || memory.walls.size() == walls);
    if (!sensible) throw Error(location, "nothing can go on from it: its contacts make no sense");
}

// Returns where a slider had been moved to, unless the scene says otherwise now than it did then.
template <typename T>
T follow(const T& stood, const T& was, const T& ours) {
    return stood != was && was == ours ? stood : ours;
}

Parameters parametersNow(const Head& head, const Plan& plan) {
    const Parameters &stood = head.parameters, &was = head.own, ours = parametersOf(plan);
    Parameters out;
    out.gravity = follow(stood.gravity, was.gravity, ours.gravity);
    out.wind = follow(stood.wind, was.wind, ours.wind);
    out.drag = follow(stood.drag, was.drag, ours.drag);
    out.stiffness = follow(stood.stiffness, was.stiffness, ours.stiffness);
    out.damping = follow(stood.damping, was.damping, ours.damping);
    out.forces = ours.forces;
    out.frameTime = follow(stood.frameTime, was.frameTime, ours.frameTime);
    out.substeps = follow(stood.substeps, was.substeps, ours.substeps);
    // as the sliders do: the step stays stable
    if (out.stiffness != 1 || out.damping != 1)
        out.substeps =
            substepsNeeded(plan, out.frameTime, out.stiffness, out.damping, out.drag, out.substeps);
    return out;
}

// Whether a slider is no longer where it stood.
bool changed(const Head& head, Parameters present) {
    present.forces = head.parameters.forces;  // not in the file
    return jumps(head.parameters, present);
}

}  // namespace

void writeCheckpoint(const std::filesystem::path& path, const Plan& plan, const Checkpoint& saved) {
    const SavedState& state = saved.state;
    Head content{state.time,
                 state.step,
                 checkpoint::forcesAt(plan, state.time),
                 state.frames,
                 saved.parameters,
                 parametersOf(plan),
                 checkpoint::groupsOf(plan),
                 state.contacts.counts.size(),
                 state.contacts.partners.size(),
                 state.contacts.walls.size()};
    for (size_t g = 0; g < state.groups.size(); ++g)
        content.groups[g].keeps = (state.groups[g].displacements.empty() ? 0 : checkpoint::keepsHistory) |
                                  (state.groups[g].steering.empty() ? 0 : checkpoint::keepsSteering);
    const std::string head = checkpoint::pack(content);
    FileWriter file(path);
    Checksum sum;
    const auto write = [&](const void* data, size_t bytes) {
        file.write(data, bytes);
        sum.add(data, bytes);
    };
    const auto finishPart = [&] {
        const uint64_t value = std::exchange(sum, {}).sum();
        file.write(&value, sizeof value);
    };
    const auto length = uint64_t(head.size());
    file.write(magic, sizeof magic);
    file.write(&ownOrder, sizeof ownOrder);
    write(&checkpointVersion, sizeof checkpointVersion);
    write(&length, sizeof length);
    write(head.data(), head.size());
    finishPart();
    for (const GroupState& group : state.groups)
        forEachArray(group,
                     [&](const auto& values) { write(values.data(), values.size() * sizeof values[0]); });
    forEachArray(state.contacts, content, [&](const auto& values, uint64_t) {
        write(values.data(), values.size() * sizeof values[0]);
    });
    finishPart();
    file.finish();
}

Checkpoint readCheckpoint(const std::filesystem::path& path, const Plan& plan) {
    FileReader file(path);
    const Location& location = file.location();
    const Head head = readHead(file);
    const std::string differs = checkpoint::difference(head.groups, checkpoint::groupsOf(plan));
    if (!differs.empty()) throw Error(location, concat("is of another scene: ", differs));
    checkHead(head, location);
    Checkpoint out;
    out.parameters = parametersNow(head, plan);
    out.state.time = head.time;
    out.state.frames = head.frames;
    // Forces that differ from those of the saved scene begin with a jump.
    const bool goesOn =
        head.forces == checkpoint::forcesAt(plan, head.time) && !changed(head, out.parameters);
    out.state.step = goesOn ? head.step : 0;
    readBody(file, head, plan, out.state);
    for (size_t g = 0; g < plan.groups.size(); ++g)
        checkState(out.state.groups[g], plan.groups[g], location);
    checkContacts(out.state.contacts, location);
    return out;
}

}  // namespace shoal
