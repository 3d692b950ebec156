// "life" and "emitters" of a group: what is born and dies.
#include <algorithm>
#include <cmath>

#include "scene/scene_file.h"
#include "scene/scene_reader.h"
#include "scene/selection.h"

namespace shoal {

namespace {

constexpr double pi = 3.14159265358979323846;

Burst readBurst(JsonReader& r) {
    Burst burst;
    r.get("time", burst.time, Range::atLeast(0));
    r.need("count", burst.count, Range::between(1, maxGroupCount));
    r.get("every", burst.every, aboveZero());
    r.finish();
    return burst;
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
        if (!(selectedArea(models[size_t(emitter.model)].mesh, emitter.select) > 0))
            throw Error(r.here(),
                        concat("nothing of model \"", models[size_t(emitter.model)].name,
                               "\" matches the selection, expected triangles with an area to emit from"));
        break;
    case From::death:
        r.need("of", emitter.group);
        break;
    }
}

void readWhen(JsonReader& r, Emitter& emitter) {
    if (emitter.from == Emitter::From::death) {
        r.get("count", emitter.perDeath, Range::between(1, 1024));
        return;
    }
    r.get("rate", emitter.rate, Range::atLeast(0));
    r.get("random", emitter.random);
    r.get("begin", emitter.begin, Range::atLeast(0));
    if (r.get("until", emitter.end, Range::atLeast(0)) && !(emitter.end > emitter.begin))
        throw Error(r.at("until"),
                    concat("expected a time after \"begin\" (", emitter.begin, " s), found ", emitter.end));
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
    int along = int(emitter.along);
    if (r.choose("along", {"direction", "outward"}, along)) emitter.along = Emitter::Along(along);
    if (emitter.along == Emitter::Along::outward && (emitter.from == From::line || emitter.from == From::box))
        throw Error(r.at("along"), "nothing is outward of a line or a box: expected a \"direction\"");
    getDirection(r, "direction", emitter.direction);
    r.get("spread", emitter.spread, Range::between(0, pi + 1e-9));
    emitter.spread = std::min(emitter.spread, pi);
    getSpan(r, "speed", emitter.speed, Range::atLeast(0));
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
    int from = 0;
    r.require("from");
    r.choose("from", {"point", "line", "disc", "sphere", "box", "surface", "death"}, from);
    emitter.from = Emitter::From(from);
    readFrom(r, emitter, models);
    readWhen(r, emitter);
    readVelocity(r, emitter);
    if (r.has("path") && (emitter.from == Emitter::From::surface || emitter.from == Emitter::From::death))
        throw Error(r.at("path"), "an emitter from a surface or from deaths does not move by itself");
    emitter.path = readPath(r);
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

// Of newborn molecules: points have no shape to scale or turn.
void readNewborn(JsonReader& r, const Group& group, Lifecycle& life) {
    if (group.particle) return;
    getSpan(r, "scale", life.scale, aboveZero());
    int turn = int(life.turn);
    r.choose("turn", {"none", "yaw", "any"}, turn);
    life.turn = Placement::Turn(turn);
    r.get("spin", life.spin, Range::atLeast(0));
    r.get("grow", life.grow, Range::atLeast(0));
    r.get("shrink", life.shrink, Range::atLeast(0));
}

bool bearsFromDeaths(const Lifecycle& life) {
    return std::any_of(life.emitters.begin(), life.emitters.end(),
                       [](const Emitter& emitter) { return emitter.from == Emitter::From::death; });
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
    if (r && r->get("capacity", life.capacity, Range::between(1, maxGroupCount))) {
        if (life.capacity < of.count)
            throw Error(r->at("capacity"), concat("expected a capacity of at least the count at the start, ",
                                                  of.count, ", found ", life.capacity));
        return;
    }
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
        readNewborn(*own, group, life);
        int allocator = 0;
        if (own->choose("allocator", {"gpu", "ring", "stack", "heap"}, allocator) && life.emitters.empty())
            throw Error(own->at("allocator"), "nothing is born here: an allocator needs \"emitters\"");
        life.allocator = Allocator(allocator);
    }
    readCapacity(r, own, group, life);
    if (own) own->finish();
    for (const Emitter& emitter : life.emitters)
        if (emitter.from == Emitter::From::death && life.allocator != Allocator::gpu)
            throw Error(emitter.location,
                        concat("only the allocator \"gpu\" can bear from deaths: how many there are is known "
                               "there, and \"",
                               name(life.allocator), "\" is asked for"));
    group.life = std::move(life);
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
