// "life" and "emitters" of a group: what is born and dies.
#include <algorithm>
#include <cmath>

#include "scene/json/reader.h"
#include "scene/json/scene_file.h"
#include "scene/selection.h"

namespace shoal {

static constexpr double pi = 3.14159265358979323846;

template <typename V>
static void members(V&& v, Either<Burst> auto& burst) {
    v.number("time", burst.time, Range::atLeast(0));
    v.number("count", burst.count, Range::between(1, maxGroupCount));
    v.unlessZero("every", burst.every, aboveZero());
}

// But for those of the place, which differ.
template <typename V>
static void members(V&& v, Either<Emitter> auto& emitter) {
    v.direction("direction", emitter.direction);
    v.number("spread", emitter.spread, Range::between(0, pi + 1e-9));
    v.span("speed", emitter.speed, Range::atLeast(0));
}

// When it bears, unless deaths do.
template <typename V>
static void timesOf(V&& v, Either<Emitter> auto& emitter) {
    v.number("rate", emitter.rate, Range::atLeast(0));
    v.flag("random", emitter.random);
    v.number("begin", emitter.begin, Range::atLeast(0));
}

// Of newborn molecules: points have no shape to scale or turn.
template <typename V>
static void newbornOf(V&& v, Either<Lifecycle> auto& life) {
    v.span("scale", life.scale, aboveZero());
    v.word("turn", life.turn, {"none", "yaw", "any"});
    v.number("spin", life.spin, Range::atLeast(0));
    v.number("grow", life.grow, Range::atLeast(0));
    v.number("shrink", life.shrink, Range::atLeast(0));
}

namespace {

const std::vector<std::string> fromWords = {"point", "line", "disc", "sphere", "box", "surface", "death"};
const std::vector<std::string> alongWords = {"direction", "outward"};
const std::vector<std::string> allocatorWords = {"gpu", "ring", "stack", "heap"};
const Range capacities = Range::between(1, maxGroupCount), perDeaths = Range::between(1, 1024);

Burst readBurst(JsonReader& r) {
    const Burst burst = readMembers<Burst>(r, {"count"});
    r.finish();
    return burst;
}

void checkArea(const Emitter& emitter, const std::vector<Model>& models, const Where& where) {
    if (!(selectedArea(models[size_t(emitter.model)].mesh, emitter.select) > 0))
        throw Error(where.here(),
                    concat("nothing of model \"", models[size_t(emitter.model)].name,
                           "\" matches the selection, expected triangles with an area to emit from"));
}

void checkEnd(const Emitter& emitter, const Where& where) {
    if (!(emitter.end > emitter.begin))
        throw Error(where.at("until"),
                    concat("expected a time after \"begin\" (", emitter.begin, " s), found ", emitter.end));
}

void checkAlong(const Emitter& emitter, const Where& where) {
    if (emitter.along == Emitter::Along::outward &&
        (emitter.from == Emitter::From::line || emitter.from == Emitter::From::box))
        throw Error(where.at("along"), "nothing is outward of a line or a box: expected a \"direction\"");
}

void checkMoves(const Emitter& emitter, const Where& where) {
    if (emitter.from == Emitter::From::surface || emitter.from == Emitter::From::death)
        throw Error(where.at("path"), "an emitter from a surface or from deaths does not move by itself");
}

void checkCapacity(int count, const Lifecycle& life, const Where& where) {
    if (life.capacity < count)
        throw Error(where.at("capacity"), concat("expected a capacity of at least the count at the start, ",
                                                 count, ", found ", life.capacity));
}

// The keys of one kind of place.
void readFrom(JsonReader& r, Emitter& emitter, const std::vector<Model>& models) {
    using From = Emitter::From;
    switch (emitter.from) {
    case From::point:
        r.get("position", emitter.position);
        break;
    case From::line:
        r.need("start", emitter.lineFrom);
        r.need("end", emitter.lineTo);
        break;
    case From::disc:
    case From::sphere:
        r.get("position", emitter.position);
        r.need("radius", emitter.radius, aboveZero());
        r.get("hollow", emitter.hollow, Range::between(0, 1));
        break;
    case From::box:
        r.require("box");
        getBox(r, "box", emitter.box, true);
        break;
    case From::surface:
        emitter.model = needModel(r, "model", models);
        if (auto chosen = r.object("select"))
            emitter.select = readSelection(*chosen, models[size_t(emitter.model)]);
        checkArea(emitter, models, r);
        break;
    case From::death:
        r.need("of", emitter.group);
        break;
    }
}

void readWhen(JsonReader& r, Emitter& emitter) {
    if (emitter.from == Emitter::From::death) {
        r.get("count", emitter.perDeath, perDeaths);
        return;
    }
    timesOf(ReadScene(r), emitter);
    if (r.get("until", emitter.end, Range::atLeast(0))) checkEnd(emitter, r);
    for (JsonReader& burst : r.objects("bursts"))
        emitter.bursts.push_back(readBurst(burst));
    if (!r.has("rate") && emitter.bursts.empty())
        throw Error(r.here(), "expected a \"rate\" or \"bursts\": this emitter bears nothing");
}

void readVelocity(JsonReader& r, Emitter& emitter) {
    using From = Emitter::From;
    const auto outwardByNature = [](From from) {
        return from == From::sphere || from == From::surface || from == From::death;
    };
    if (outwardByNature(emitter.from) && !r.has("direction")) emitter.along = Emitter::Along::outward;
    ReadScene(r).word("along", emitter.along, alongWords);
    checkAlong(emitter, r);
    members(ReadScene(r), emitter);
    emitter.spread = std::min(emitter.spread, pi);
    const bool carried = emitter.from == From::death || r.has("path");
    if (r.get("inherit", emitter.inherit, Range::any()) && !carried)
        throw Error(r.at("inherit"),
                    "nothing to inherit from: only an emitter with a \"path\", or from "
                    "\"death\", has a velocity of its own");
}

Emitter readEmitter(JsonReader& r, const std::vector<Model>& models) {
    Emitter emitter;
    emitter.location = r.here();
    r.get("name", emitter.name);
    r.require("from");
    ReadScene(r).word("from", emitter.from, fromWords);
    readFrom(r, emitter, models);
    readWhen(r, emitter);
    readVelocity(r, emitter);
    if (r.has("path")) checkMoves(emitter, r);
    emitter.path = readDescribed<ColliderPath>(r, "path");
    r.finish();
    return emitter;
}

void readSpanOfLife(JsonReader& r, Lifecycle& life) {
    getSpan(r, "span", life.life, aboveZero());
    life.life = glm::min(life.life, glm::dvec2(longestLife));
    if (auto dies = r.object("dies")) {
        Box box;
        if (getBox(*dies, "outside", box)) life.within = box;
        getOptional(*dies, "afterContact", life.afterContact, Range::atLeast(0));
        if (!life.within && !life.afterContact)
            throw Error(dies->here(), "expected \"outside\" a box or \"afterContact\"");
        dies->finish();
    }
}

bool bearsFromDeaths(const Lifecycle& life) {
    return std::any_of(life.emitters.begin(), life.emitters.end(),
                       [](const Emitter& emitter) { return emitter.from == Emitter::From::death; });
}

void checkAllocator(const Emitter& emitter, const Lifecycle& life, const Location& where) {
    if (emitter.from == Emitter::From::death && life.allocator != Allocator::gpu)
        throw Error(where,
                    concat("only the allocator \"gpu\" can bear from deaths: how many there are is known "
                           "there, and \"",
                           name(life.allocator), "\" is asked for"));
}

double mostAlive(int count, const Lifecycle& life) {
    double most = count;
    for (const Emitter& emitter : life.emitters) {
        most += emitter.rate * std::min(life.life.y, emitter.end - emitter.begin);
        for (const Burst& burst : emitter.bursts)
            most += burst.every > 0 ? burst.count * (std::floor(life.life.y / burst.every) + 1) : burst.count;
    }
    return std::ceil(most * 1.05);
}

void readCapacity(JsonReader& group, std::optional<JsonReader>& r, const Group& of, Lifecycle& life) {
    if (r && r->get("capacity", life.capacity, capacities)) return checkCapacity(of.count, life, *r);
    if (const std::optional<int> usual = usualCapacity(of.count, life)) {
        life.capacity = *usual;
        return;
    }
    const bool fromDeaths = bearsFromDeaths(life), tooMany = life.life.y < longestLife;
    throw Error(group.here(),
                concat("expected a \"capacity\" in \"life\": ",
                       fromDeaths ? "what dies elsewhere sets how many are born"
                       : tooMany  ? concat("rate times span is ", mostAlive(of.count, life),
                                           ", more than the ", maxGroupCount, " that a group may have")
                                  : "without a \"span\" nothing says how many may be alive"));
}

}  // namespace

const char* name(Allocator allocator) {
    static constexpr const char* names[] = {"gpu", "ring", "stack", "heap"};
    return names[size_t(allocator)];
}

std::optional<int> usualCapacity(int count, const Lifecycle& life) {
    if (life.emitters.empty()) return count;
    const double most = mostAlive(count, life);
    if (bearsFromDeaths(life) || life.life.y >= longestLife || !(most <= maxGroupCount)) return {};
    return std::max(1, int(most));
}

const char* name(Emitter::From from) {
    static constexpr const char* names[] = {"point", "line", "disc", "sphere", "box", "surface", "death"};
    return names[size_t(from)];
}

void readLife(JsonReader& r, Group& group, const std::vector<Model>& models) {
    if (!r.has("life") && !r.has("emitters")) return;
    Lifecycle life;
    life.location = r.at(r.has("life") ? "life" : "emitters");
    for (JsonReader& entry : r.objects("emitters"))
        life.emitters.push_back(readEmitter(entry, models));
    auto own = r.object("life");
    if (own) {
        readSpanOfLife(*own, life);
        if (!group.particle) newbornOf(ReadScene(*own), life);
        ReadScene(*own).word("allocator", life.allocator, allocatorWords);
        if (own->has("allocator") && life.emitters.empty())
            throw Error(own->at("allocator"), "nothing is born here: an allocator needs \"emitters\"");
    }
    readCapacity(r, own, group, life);
    if (own) own->finish();
    for (const Emitter& emitter : life.emitters)
        checkAllocator(emitter, life, emitter.location);
    group.life = std::move(life);
}

static void checkFrom(const Emitter& emitter, const std::vector<Model>& models, const Where& where) {
    using From = Emitter::From;
    const CheckScene check(where);
    check.number("position", emitter.position);
    check.number("start", emitter.lineFrom);
    check.number("end", emitter.lineTo);
    if (emitter.from == From::disc || emitter.from == From::sphere) {
        check.number("radius", emitter.radius, aboveZero());
        check.number("hollow", emitter.hollow, Range::between(0, 1));
    }
    if (emitter.from == From::box) check.box("box", emitter.box, true);
    if (emitter.from == From::surface) {
        checkModel(emitter.model, models, where.at("model"));
        checkArea(emitter, models, where);
    }
}

static void checkEmitter(const Emitter& emitter, const Lifecycle& life, const std::vector<Model>& models,
                         const Where& where) {
    const CheckScene check(where);
    check.word("from", emitter.from, fromWords);
    checkFrom(emitter, models, where);
    timesOf(check, emitter);
    checkEnd(emitter, where);
    if (emitter.from == Emitter::From::death) check.number("count", emitter.perDeath, perDeaths);
    for (size_t i = 0; i < emitter.bursts.size(); ++i) {
        const Where burst = where.in("bursts", i);
        members(CheckScene(burst), emitter.bursts[i]);
    }
    check.word("along", emitter.along, alongWords);
    checkAlong(emitter, where);
    members(check, emitter);
    check.number("inherit", emitter.inherit);
    checkAllocator(emitter, life, where.here());
    if (!emitter.path) return;
    checkMoves(emitter, where);
    describe(&*emitter.path).check(*emitter.path, where.in("path"), largestNumber);
}

void checkLife(const Group& group, const std::vector<Model>& models, const Where& where) {
    const Lifecycle& life = *group.life;
    const Where own = where.in("life");
    const CheckScene check(own);
    check.number("capacity", life.capacity, capacities);
    checkCapacity(group.count, life, own);
    if (life.life != glm::dvec2(longestLife))
        check.span("span", glm::min(life.life, glm::dvec2(largestNumber)), aboveZero());
    check.box("dies.outside", life.within);
    check.number("dies.afterContact", life.afterContact, Range::atLeast(0));
    if (!group.particle) newbornOf(check, life);
    check.word("allocator", life.allocator, allocatorWords);
    for (size_t i = 0; i < life.emitters.size(); ++i)
        checkEmitter(life.emitters[i], life, models, where.in("emitters", i));
}

void checkDeaths(const std::vector<Group>& groups) {
    std::vector<std::string> names;
    for (const Group& group : groups)
        names.push_back(group.name);
    const auto find = [&](const Emitter& emitter) {
        const auto found = std::find(names.begin(), names.end(), emitter.group);
        if (found == names.end())
            throw Error(emitter.location,
                        "no group is named \"" + emitter.group + "\"" + suggestion(emitter.group, names));
        return size_t(found - names.begin());
    };
    // Every way along the deaths must end: longer than there are groups, and it is a circle.
    const auto follow = [&](const auto& self, size_t g, size_t depth) -> void {
        if (!groups[g].life) return;
        for (const Emitter& emitter : groups[g].life->emitters) {
            if (emitter.from != Emitter::From::death) continue;
            const size_t source = find(emitter);
            if (!groups[source].life)
                throw Error(emitter.location,
                            "none of \"" + emitter.group + "\" ever dies: it has no \"life\"");
            if (depth >= groups.size() || source == g)
                throw Error(emitter.location, "groups that are born from one another's deaths in a circle");
            self(self, source, depth + 1);
        }
    };
    for (size_t g = 0; g < groups.size(); ++g)
        follow(follow, g, 0);
}

}  // namespace shoal
