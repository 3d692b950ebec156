#include "scene/json/life_writer.h"

#include <cmath>

#include "core/json_values.h"
#include "scene/json/key_writer.h"

namespace shoal {

namespace {

using From = Emitter::From;
using Along = Emitter::Along;

JsonValue write(const Selection& select) {
    KeyWriter keys;
    const auto optional = [&keys](const char* key, const std::optional<double>& number) {
        if (number) keys.value(key, JsonValue::makeNumber(*number));
    };
    optional("thinnest", select.thinnest);
    optional("maxThickness", select.maxThickness);
    if (!select.object.empty()) keys.word("object", select.object);
    if (select.color) {
        keys.value("color", JsonValue::makeVector(*select.color));
        keys.number("colorTolerance", select.colorTolerance, Selection().colorTolerance);
    }
    optional("minHeight", select.minHeight);
    optional("maxHeight", select.maxHeight);
    return std::move(keys.object);
}

JsonValue write(const Burst& burst) {
    KeyWriter keys;
    keys.number("time", burst.time, 0);
    keys.value("count", JsonValue::makeNumber(burst.count));
    keys.number("every", burst.every, 0);
    return std::move(keys.object);
}

JsonValue write(const ColliderPath& path) {
    JsonValue frames = JsonValue::makeArray();
    for (const ColliderPath::Keyframe& frame : path.keyframes) {
        KeyWriter keys;
        const glm::dquat& q = frame.pose.rotation;
        keys.value("time", JsonValue::makeNumber(frame.time));
        keys.vector("position", frame.pose.position, glm::dvec3(0));
        if (q != glm::dquat(1, 0, 0, 0))
            keys.value("rotation", JsonValue::makeVector(glm::dvec4(q.x, q.y, q.z, q.w)));
        frames.items.push_back(std::move(keys.object));
    }
    KeyWriter keys;
    if (path.repeats) keys.word("end", "repeat");
    if (path.smooth) keys.word("interpolation", "smooth");
    keys.value("keyframes", std::move(frames));
    return std::move(keys.object);
}

void writeFrom(KeyWriter& keys, const Emitter& emitter, const std::vector<Model>& models) {
    keys.word("from", name(emitter.from));
    switch (emitter.from) {
    case From::point:
        keys.vector("position", emitter.position, glm::dvec3(0));
        break;
    case From::line:
        keys.value("start", JsonValue::makeVector(emitter.lineFrom));
        keys.value("end", JsonValue::makeVector(emitter.lineTo));
        break;
    case From::disc:
    case From::sphere:
        keys.vector("position", emitter.position, glm::dvec3(0));
        keys.value("radius", JsonValue::makeNumber(emitter.radius));
        keys.number("hollow", emitter.hollow, 0);
        break;
    case From::box:
        keys.value("box", writeBox(emitter.box));
        break;
    case From::surface: {
        keys.word("model", models[size_t(emitter.model)].name);
        JsonValue select = write(emitter.select);
        if (!select.members.empty()) keys.value("select", std::move(select));
        break;
    }
    case From::death:
        keys.word("of", emitter.group);
        break;
    }
}

void writeWhen(KeyWriter& keys, const Emitter& emitter) {
    if (emitter.from == From::death) return keys.number("count", emitter.perDeath, 1);
    // the reader wants at least one of the two
    if (emitter.rate != 0 || emitter.bursts.empty()) keys.value("rate", JsonValue::makeNumber(emitter.rate));
    if (emitter.random) keys.value("random", JsonValue::makeBoolean(true));
    keys.number("begin", emitter.begin, 0);
    if (std::isfinite(emitter.end)) keys.value("until", JsonValue::makeNumber(emitter.end));
    if (emitter.bursts.empty()) return;
    JsonValue bursts = JsonValue::makeArray();
    for (const Burst& burst : emitter.bursts)
        bursts.items.push_back(write(burst));
    keys.value("bursts", std::move(bursts));
}

void writeVelocity(KeyWriter& keys, const Emitter& emitter) {
    // what the reader takes where a "direction" is not given, or is
    const bool outwardByNature =
        emitter.from == From::sphere || emitter.from == From::surface || emitter.from == From::death;
    const bool outward = emitter.along == Along::outward, up = emitter.direction == glm::dvec3(0, 1, 0);
    if (!up || (outwardByNature && !outward))
        keys.value("direction", JsonValue::makeVector(emitter.direction));
    if (outward && (!outwardByNature || !up)) keys.word("along", "outward");
    keys.number("spread", emitter.spread, 0);
    keys.span("speed", emitter.speed, glm::dvec2(0));
    if (emitter.path || emitter.from == From::death) keys.number("inherit", emitter.inherit, 0);
}

JsonValue write(const Emitter& emitter, const std::vector<Model>& models) {
    KeyWriter keys;
    if (!emitter.name.empty()) keys.word("name", emitter.name);
    writeFrom(keys, emitter, models);
    writeWhen(keys, emitter);
    writeVelocity(keys, emitter);
    if (emitter.path) keys.value("path", write(*emitter.path));
    return std::move(keys.object);
}

void writeDies(KeyWriter& keys, const Lifecycle& life) {
    if (!life.within && !life.afterContact) return;
    KeyWriter dies;
    if (life.within) dies.value("outside", writeBox(*life.within));
    if (life.afterContact) dies.value("afterContact", JsonValue::makeNumber(*life.afterContact));
    keys.value("dies", std::move(dies.object));
}

void writeNewborn(KeyWriter& keys, const Lifecycle& life) {
    const Lifecycle usual;
    static constexpr const char* turns[] = {"none", "yaw", "any"};
    keys.span("scale", life.scale, usual.scale);
    if (life.turn != usual.turn) keys.word("turn", turns[size_t(life.turn)]);
    keys.vector("spin", life.spin, usual.spin);
    keys.number("grow", life.grow, usual.grow);
    keys.number("shrink", life.shrink, usual.shrink);
}

}  // namespace

std::optional<JsonValue> writeLife(const Group& group) {
    const Lifecycle& life = *group.life;
    KeyWriter keys;
    keys.span("span", life.life, Lifecycle().life);
    writeDies(keys, life);
    if (!group.particle) writeNewborn(keys, life);
    if (!life.emitters.empty() && life.allocator != Allocator::gpu)
        keys.word("allocator", name(life.allocator));
    if (usualCapacity(group.count, life) != life.capacity)
        keys.value("capacity", JsonValue::makeNumber(life.capacity));
    // without either key there would be no life
    const bool emits = !life.emitters.empty() || group.count == 0;
    if (keys.object.members.empty() && emits) return {};
    return std::move(keys.object);
}

std::optional<JsonValue> writeEmitters(const Group& group, const std::vector<Model>& models) {
    const std::vector<Emitter>& emitters = group.life->emitters;
    if (emitters.empty() && group.count > 0) return {};  // else the reader asks for a "place"
    JsonValue out = JsonValue::makeArray();
    for (const Emitter& emitter : emitters)
        out.items.push_back(write(emitter, models));
    return out;
}

}  // namespace shoal
