#include "scene/emitter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/describe.h"
#include "scene/json/reader.h"
#include "scene/scene.h"

namespace shoal {

namespace {

using From = Emitter::From;

const std::vector<std::string> allocatorWords = {"gpu", "ring", "stack", "heap"};
const std::vector<std::string> fromWords = {"point", "line", "disc", "sphere", "box", "surface", "death"};
const std::vector<std::string> bySchedule(fromWords.begin(), fromWords.end() - 1);  // all but death

bool outwardByNature(const Emitter& emitter) {
    return emitter.from == From::sphere || emitter.from == From::surface || emitter.from == From::death;
}

// Whether an emitter has a velocity of its own.
bool isCarried(const Emitter& emitter) {
    return emitter.path || emitter.from == From::death;
}

// Sets and checks what depends on which keys a file gives.
void follow(Emitter& emitter, const Where& where) {
    if (!where.given("along") && outwardByNature(emitter) && !where.given("direction"))
        emitter.along = Emitter::Along::outward;
    emitter.spread = std::min(emitter.spread, std::numbers::pi);
    if (emitter.from != From::death && !where.given("rate") && emitter.bursts.empty())
        throw Error(where.here(), "expected a \"rate\" or \"bursts\": this emitter emits nothing");
    if (where.given("inherit") && !isCarried(emitter))
        throw Error(where.locate("inherit"),
                    "nothing to inherit from: only an emitter with a \"path\", or from "
                    "\"death\", has a velocity of its own");
}

void checkEmitter(const Emitter& emitter, const Where& where) {
    if (emitter.from != From::death && !(emitter.end > emitter.begin))
        throw Error(where.locate("until"),
                    concat("expected a time after \"begin\" (", emitter.begin, " s), found ", emitter.end));
    if (emitter.along == Emitter::Along::outward && (emitter.from == From::line || emitter.from == From::box))
        throw Error(where.locate("along"), "nothing is outward of a line or a box: expected a \"direction\"");
}

void readModel(JsonReader& r, Emitter& emitter, const SceneReading* reading) {
    emitter.model = needModel(r, "model", reading->models);
}

}  // namespace

const char* name(Allocator allocator) {
    return allocatorWords[size_t(allocator)].c_str();
}

const char* name(Emitter::From from) {
    return fromWords[size_t(from)].c_str();
}

EmitterPlace placeOf(const Emitter& emitter, const std::vector<Model>& models) {
    switch (emitter.from) {
    case From::point:
    case From::disc:
    case From::sphere:
    case From::death:
        break;
    case From::line: {
        const glm::dvec3 &from = emitter.lineFrom, &to = emitter.lineTo;
        return {from, {glm::min(from, to), glm::max(from, to)}};
    }
    case From::box: {
        const Box& box = emitter.box;
        return {0.5 * (box.low + box.high), box};
    }
    case From::surface: {
        const Mesh& mesh = models[size_t(emitter.model)].mesh;
        return {0.5 * (mesh.low + mesh.high), {mesh.low, mesh.high}};
    }
    }
    return {emitter.position, {emitter.position, emitter.position}};
}

const Description& describe(const Burst*) {
    static const Description description =
        Describe<Burst>("burst", "Many that are born at one moment.")
            .key("time", &Burst::time, {"s", "When they are born.", Range::atLeast(0), {0, 60}})
            .key("count", &Burst::count,
                 {"", "How many are born.", Range::between(1, maxGroupCount), {1, 10000, true}})
            .needed()
            .key("every", &Burst::every,
                 {"s",
                  "After this time there is another such burst, again and again; once without it.",
                  aboveZero(),
                  {0, 60}})
            .unlessZero();
    return description;
}

const Description& describe(const Emitter*) {
    using E = Emitter;
    static const Description description =
        Describe<E>("emitter", "What molecules or particles of the group are born from.")
            .location(&E::location)
            .key("name", &E::name, {"", "Its name in messages and in the panel."})
            .word("from", &E::from, fromWords,
                  {"",
                   "Where they are born: evenly in the length, area or volume, or where one of another "
                   "group dies."})
            .needed()
            .key("position", &E::position, {"m", "The point, or the middle; a disc lies across `direction`."})
            .only("from", {"point", "disc", "sphere"})
            .key("start", &E::lineFrom, {"m", "One end of the line."})
            .needed()
            .only("from", {"line"})
            .key("end", &E::lineTo, {"m", "The other end of the line."})
            .needed()
            .only("from", {"line"})
            .key("radius", &E::radius, {"m", "The radius.", aboveZero(), {0.001, 5, true}})
            .needed()
            .only("from", {"disc", "sphere"})
            .key("hollow", &E::hollow,
                 {"", "The share of the radius that is left out; 1 leaves only the rim.",
                  Range::between(0, 1)})
            .only("from", {"disc", "sphere"})
            .box("box", &E::box, {"m", "The box; where its sides agree, a patch or a line."}, true)
            .needed()
            .only("from", {"box"})
            .byHand<const SceneReading>(
                "model", {}, {"the name of a model", "The model, of which every triangle emits by its area."},
                readModel)
            .needed()
            .only("from", {"surface"})
            .key("select", &E::select, {"", "Which part of the model; all of it without."})
            .only("from", {"surface"})
            .key("of", &E::group, {"the name of a group", "The group from whose deaths they are born."})
            .needed()
            .only("from", {"death"})
            .key("count", &E::perDeath,
                 {"", "How many are born of each death.", Range::between(1, 1024), {1, 64}})
            .only("from", {"death"})
            .key("rate", &E::rate,
                 {"1/s",
                  "How many are born a second, evenly spaced in time, within frames as well.",
                  Range::atLeast(0),
                  {0, 1000, true}})
            .only("from", bySchedule)
            .key("random", &E::random,
                 {"", "Whether they are born at random moments of that rate (Poisson)."})
            .only("from", bySchedule)
            .key("begin", &E::begin, {"s", "The time at which the rate begins.", Range::atLeast(0), {0, 60}})
            .only("from", bySchedule)
            .key("until", &E::end, {"s", "The time at which the rate ends.", Range::atLeast(0), {0, 60}})
            .only("from", bySchedule)
            .usually("for ever")
            .key("bursts", &E::bursts, {"", "Moments at which many are born."})
            .only("from", bySchedule)
            .word("along", &E::along, {"direction", "outward"},
                  {"",
                   "What the cone of their velocities is about: `outward` is from the middle of a disc or "
                   "sphere, along a surface's normal, and any way from a point or a death."})
            .usually("`\"outward\"` of spheres, surfaces and deaths without a `direction`")
            .direction("direction", &E::direction,
                       {"", "The direction of the cone, and what a disc lies across."})
            .key("spread", &E::spread,
                 {"rad", "Half the cone's opening, in which each solid angle is alike.",
                  Range::between(0, std::numbers::pi + 1e-9)})
            .span("speed", &E::speed,
                  {"m/s", "The speed at birth, random between the two.", Range::atLeast(0), {0, 20}})
            .key("inherit", &E::inherit,
                 {"", "The share of the velocity of the emitter's `path`, or of what died.", {}, {-1, 2}})
            .key("path", &E::path, {"", "How the emitter moves, as a collider does."})
            .only("from", {"point", "line", "disc", "sphere", "box"})
            .derive(follow)
            .rule(checkEmitter, R"({"anyOf": [{"required": ["rate"]}, {"required": ["bursts"]},
                                              {"properties": {"from": {"const": "death"}}}]})");
    return description;
}

// The keys of "dies".
static const Description& describeEnds() {
    using L = Lifecycle;
    static const auto needsOne = [](L& life, const Where& where) {
        if (!life.within && !life.afterContact)
            throw Error(where.here(), "expected \"outside\" a box or \"afterContact\"");
    };
    static const Description description =
        Describe<L>("dies", "What ends a life before its span does.")
            .box("outside", &L::within, {"m", "What is outside this box dies."})
            .key("afterContact", &L::afterContact,
                 {"s", "What touches a collider has so long to live.", Range::atLeast(0), {0, 10}})
            .derive(needsOne)
            .rule([](const L&, const Where&) {},
                  R"({"anyOf": [{"required": ["outside"]}, {"required": ["afterContact"]}]})");
    return description;
}

const Description& describe(const Lifecycle*) {
    using L = Lifecycle;
    static const auto cut = [](L& life, const Where&) {
        life.life = glm::min(life.life, glm::dvec2(longestLife));
    };
    static const Description description =
        Describe<L>("life",
                    "Birth and death: the group has places, which what is born takes and what dies "
                    "leaves.")
            .location(&L::location)
            .span("span", &L::life,
                  {"s", "How long they live, random between the two.", aboveZero(), {0.02, 30, true}})
            .usually("for ever")
            .part("dies", describeEnds(), "What ends a life before its span does.")
            .span("scale", &L::scale,
                  {"", "The size of newborn molecules, random between the two.", aboveZero(), {0.05, 4}})
            .word("turn", &L::turn, {"none", "yaw", "any"}, {"", "How newborn molecules are turned."})
            .key("spin", &L::spin,
                 {"rad/s",
                  "How fast newborn molecules turn about each axis, up to this either way.",
                  Range::atLeast(0),
                  {0, 20}})
            .key("grow", &L::grow,
                 {"s", "How long molecules are drawn growing at birth.", Range::atLeast(0), {0, 5}})
            .key("shrink", &L::shrink,
                 {"s", "How long molecules are drawn shrinking before their end.", Range::atLeast(0), {0, 5}})
            .word("allocator", &L::allocator, allocatorWords,
                  {"", "How a newborn finds its place ([how](particles.md#places))."})
            .key("capacity", &L::capacity,
                 {"",
                  "How many places there are, of which each takes its memory.",
                  Range::between(1, maxGroupCount),
                  {1, 100000, true}})
            .usually(
                "what rates, bursts and spans keep alive, and a twentieth more; required where nothing tells")
            .derive(cut);
    return description;
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

bool emitsFromDeaths(const Lifecycle& life) {
    return std::any_of(life.emitters.begin(), life.emitters.end(),
                       [](const Emitter& emitter) { return emitter.from == From::death; });
}

std::optional<int> usualCapacity(int count, const Lifecycle& life) {
    if (life.emitters.empty()) return count;
    const double most = mostAlive(count, life);
    if (emitsFromDeaths(life) || life.life.y >= longestLife || !(most <= maxGroupCount)) return {};
    return std::max(1, int(most));
}

}  // namespace shoal
