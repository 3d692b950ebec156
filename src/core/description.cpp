#include "core/description.h"

#include <algorithm>
#include <cmath>

namespace shoal {

namespace {

using Kind = Key::Kind;

template <typename T>
const T& held(const void* value) {
    return *static_cast<const T*>(value);
}

void checkNumber(const std::string& path, double value, Range range, const Where& where, double largest) {
    if (std::isfinite(value) && std::abs(value) > largest)
        throw Error(where.locate(path), "expected a number within ", largest, " of 0, found ", value);
    if (!contains(range, value)) needWithin(where.locate(path), value, range);
}

template <int N>
void checkNumbers(const Key& key, const glm::vec<N, double>& value, Range range, const Where& where,
                  double largest) {
    for (int i = 0; i < N; ++i)
        if (!(std::abs(value[i]) <= largest && contains(range, value[i])))
            checkNumber(concat(key.name, "[", i, "]"), value[i], range, where, largest);
}

// As a file says it: "on": "vertices" or "surface".
std::string text(const Condition& condition) {
    std::vector<std::string> words;
    for (const std::string& word : condition.words)
        words.push_back(word == "true" ? word : concat("\"", word, "\""));
    return concat("\"", condition.key, "\"", words.empty() ? "" : ": ", joined(words, " or "));
}

}  // namespace

JsonValue Description::usualValue(const Key& key) const {
    const bool plain = key.kind != Kind::byHand && key.kind != Kind::variant && key.kind != Kind::object;
    const bool empty = key.kind == Kind::text && held<std::string>(key.value(usual_)).empty();
    return plain && !empty && key.usual.empty() ? writeKey(key, usual_, nullptr, nullptr) : JsonValue();
}

const Key* Description::find(const std::string& name) const {
    const auto found =
        std::find_if(keys_.begin(), keys_.end(), [&](const Key& key) { return key.name == name; });
    return found == keys_.end() ? nullptr : &*found;
}

const Condition* Description::unmet(const Key& key, const void* object) const {
    for (const Condition& condition : key.only) {
        const Key& other = *find(condition.key);
        const void* value = other.value(unmet(other, object) ? usual_ : object);
        std::string says;
        if (value && other.kind == Kind::word) says = other.words[size_t(other.member.index(value))];
        if (value && other.kind == Kind::flag) says = held<bool>(value) ? "true" : "false";
        const std::vector<std::string>& words = condition.words;
        const bool met = words.empty()
                             ? value && (other.kind != Kind::text || !held<std::string>(value).empty())
                             : std::find(words.begin(), words.end(), says) != words.end();
        if (!met) return &condition;
    }
    return nullptr;
}

// The numbers of a value.
static std::vector<double> numbersOf(const Key& key, const void* value) {
    if (!value) return {};
    if (key.kind == Kind::whole) return {double(held<int>(value))};
    const bool two = key.kind == Kind::vector2 || key.kind == Kind::span || key.kind == Kind::ends;
    const size_t count = key.kind == Kind::number    ? 1
                         : two                       ? 2
                         : key.kind == Kind::vector3 ? 3
                         : key.kind == Kind::box     ? 6
                                                     : 0;
    const auto* first = static_cast<const double*>(value);
    return {first, first + count};
}

Slider sliderOf(const Key& key, const void* object) {
    const Range& range = key.says.range;
    Slider out = key.says.slider;
    double largest = 0;
    for (const double number : numbersOf(key, key.value(object)))
        if (std::abs(number) < largestNumber) largest = std::max(largest, std::abs(number));
    if (out.least == out.most) {
        const bool place = key.kind == Kind::vector3 || key.kind == Kind::box;
        out.most = place ? 1000 : largest > 0 ? 5 * largest : 1;
        out.steep = range.least == leastPositive;
        out.least = out.steep ? out.most / 1000 : std::isfinite(range.least) ? range.least : -out.most;
        if (std::isfinite(range.most)) out.most = range.most;
    }
    for (const double number : numbersOf(key, key.value(object))) {
        if (!(std::abs(number) < largestNumber)) continue;
        out.least = std::min(out.least, number < 0 ? 4 * number : number);
        out.most = std::max(out.most, 4 * number);
    }
    out.least = std::max(out.least, key.unlessZero ? 0 : range.least);
    out.most = std::min(out.most, range.most);
    return out;
}

void Description::readFileAny(const JsonValue& root, const std::string& file, void* out,
                              void* context) const {
    JsonReader reader(root, file);
    needFormat(reader, format_);
    readAny(reader, out, context);
    reader.finish();
}

void Description::readAny(JsonReader& reader, void* out, void* context) const {
    if (location_ >= 0) *reinterpret_cast<Location*>(static_cast<char*>(out) + location_) = reader.here();
    for (const Key& key : keys_) {
        if (const Condition* condition = unmet(key, out)) {
            if (reader.has(key.name))
                throw Error(reader.locate(key.name), "\"", key.name, "\" needs ", text(*condition));
            continue;
        }
        if (key.needed) reader.require(key.name);
        readKey(key, reader, out, context);
    }
    if (derive_) derive_(out, reader, context);
    if (rule_) rule_(out, reader);
}

// A pair, or its second number alone.
static void getEnds(JsonReader& reader, const std::string& name, glm::dvec2& out, const Range& range) {
    const JsonValue* given = reader.raw(name);
    if (given && given->kind == JsonValue::Kind::number)
        reader.get(name, out.y, range);
    else
        reader.get(name, out, range);
}

void Description::readKey(const Key& key, JsonReader& r, void* object, void* context) {
    const std::string& name = key.name;
    const Range range = key.says.range;
    if (key.read) {
        r.raw(name);  // known even when absent
        return key.read(r, object, context);
    }
    // A value is read on its own before an optional member is made, which a file that says nothing leaves
    // empty.
    const auto fill = [&]<typename T>(T value, auto get) {
        if (get(value)) *static_cast<T*>(key.member.make(key.place(object))) = std::move(value);
    };
    const auto plain = [&](auto value) { fill(value, [&](auto& out) { return r.get(name, out, range); }); };
    switch (key.kind) {
    case Kind::number:
        return plain(0.0);
    case Kind::whole:
        return plain(0);
    case Kind::seed:
        return plain(uint32_t(0));
    case Kind::longSeed:
        return plain(uint64_t(0));
    case Kind::flag:
        return plain(false);
    case Kind::texts:
        return plain(std::vector<std::string>());
    case Kind::vector2:
        return plain(glm::dvec2(0));
    case Kind::vector3:
    case Kind::color:
        return plain(glm::dvec3(0));
    case Kind::whole3:
        return fill(glm::ivec3(0), [&](glm::ivec3& value) {
            std::vector<int> numbers;
            if (!r.get(name, numbers, range)) return false;
            if (numbers.size() != 3)
                throw Error(r.locate(name), "expected three whole numbers, found ", numbers.size());
            value = {numbers[0], numbers[1], numbers[2]};
            return true;
        });
    case Kind::text:
        return fill(std::string(), [&](std::string& value) {
            if (!r.get(name, value)) return false;
            if (key.notEmpty && value.empty())
                throw Error(r.locate(name), "expected ", key.says.unit, ", found an empty string");
            return true;
        });
    case Kind::direction:
        return fill(glm::dvec3(0), [&](glm::dvec3& value) { return getDirection(r, name, value); });
    case Kind::span:
        return fill(glm::dvec2(0), [&](glm::dvec2& value) { return getSpan(r, name, value, range); });
    case Kind::box:
        return fill(Box(), [&](Box& value) { return getBox(r, name, value, key.flatBox); });
    case Kind::rotation:
        return fill(glm::dquat(), [&](glm::dquat& value) { return getRotation(r, name, value); });
    case Kind::ends:
        return getEnds(r, name, *static_cast<glm::dvec2*>(key.place(object)), range);
    case Kind::word: {
        int index = key.member.index(key.value(object));
        if (r.choose(name, key.words, index)) key.member.choose(key.place(object), index);
        return;
    }
    case Kind::variant: {
        int index = 0;
        r.choose(name, key.words, index);
        void* alternative = key.member.choose(key.place(object), index);
        return key.objects[size_t(index)]->readAny(r, alternative, context);
    }
    case Kind::object: {
        std::optional<JsonReader> inner = r.object(name);
        if (!inner) return;
        key.objects[0]->readAny(*inner, key.member.make(key.place(object)), context);
        return inner->finish();
    }
    case Kind::list:
        if (!r.has(name)) return void(r.raw(name));
        key.member.clear(key.member.make(key.place(object)));
        for (JsonReader& inner : r.objects(name)) {
            void* element = key.member.append(key.member.make(key.place(object)));
            key.objects[0]->readAny(inner, element, context);
            inner.finish();
        }
        return;
    case Kind::byHand:
        break;
    }
}

void Description::readSomeAny(std::initializer_list<const char*> names, JsonReader& reader, void* out,
                              void* context) const {
    for (const char* name : names) {
        EXPECTS(find(name));
        readKey(*find(name), reader, out, context);
    }
}

JsonValue Description::writeSomeAny(std::initializer_list<const char*> names, const void* object,
                                    const void* context) const {
    JsonValue out = JsonValue::makeObject();
    for (const char* name : names) {
        EXPECTS(find(name));
        JsonValue value = writeKey(*find(name), object, usual_, context);
        if (value.kind != JsonValue::Kind::null) out.add(name, std::move(value));
    }
    return out;
}

// Whether a number has its default value, which a file need not be able to state, such as infinity.
bool Description::isUsual(const Key& key, const void* object) const {
    if (key.needed || key.member.optional) return false;
    if (key.kind == Kind::number) return held<double>(key.value(object)) == held<double>(key.value(usual_));
    if (key.kind == Kind::span)
        return held<glm::dvec2>(key.value(object)) == held<glm::dvec2>(key.value(usual_));
    return false;
}

void Description::checkAny(const void* object, const Where& where, double largest) const {
    for (const Key& key : keys_)
        if (!unmet(key, object) && !isUsual(key, object)) checkKey(key, object, where, largest);
    if (rule_) rule_(object, where);
}

void Description::checkKey(const Key& key, const void* object, const Where& where, double largest) {
    const void* value = key.kind == Kind::byHand ? nullptr : key.value(object);
    if (!value) return;
    const Range range = key.says.range;
    switch (key.kind) {
    case Kind::number:
        if (!key.unlessZero || held<double>(value) != 0)
            checkNumber(key.name, held<double>(value), range, where, largest);
        return;
    case Kind::whole:
        if ((!key.unlessZero || held<int>(value) != 0) && !contains(range, held<int>(value)))
            needWithin(where.locate(key.name), held<int>(value), range);
        return;
    case Kind::whole3:
        for (int i = 0; i < 3; ++i)
            if (!contains(range, held<glm::ivec3>(value)[i]))
                needWithin(where.locate(concat(key.name, "[", i, "]")), held<glm::ivec3>(value)[i], range);
        return;
    case Kind::vector2:
    case Kind::ends:
        return checkNumbers(key, held<glm::dvec2>(value), range, where, largest);
    case Kind::vector3:
    case Kind::color:
        return checkNumbers(key, held<glm::dvec3>(value), range, where, largest);
    case Kind::direction:
        checkNumbers(key, held<glm::dvec3>(value), range, where, largest);
        return checkDirection(held<glm::dvec3>(value), where.locate(key.name));
    case Kind::span:
        checkNumbers(key, held<glm::dvec2>(value), range, where, largest);
        return checkSpan(held<glm::dvec2>(value), where.locate(key.name));
    case Kind::box:
        for (int i = 0; i < 3; ++i) {
            checkNumber(concat(key.name, ".low[", i, "]"), held<Box>(value).low[i], {}, where, largest);
            checkNumber(concat(key.name, ".high[", i, "]"), held<Box>(value).high[i], {}, where, largest);
        }
        return checkBox(held<Box>(value), key.flatBox, where.locate(key.name + ".high"));
    case Kind::rotation: {
        const glm::dquat& q = held<glm::dquat>(value);
        for (const double part : {q.x, q.y, q.z, q.w})
            checkNumber(key.name, part, {}, where, largest);
        return checkRotation(q, where.locate(key.name));
    }
    case Kind::word:
    case Kind::variant: {
        const int index = key.member.index(value);
        needWithin(where.locate(key.name), index, Range::between(0, double(key.words.size()) - 1));
        if (key.kind == Kind::variant)
            key.objects[size_t(index)]->checkAny(key.member.held(value), where, largest);
        return;
    }
    case Kind::object:
        return key.objects[0]->checkAny(value, where.in(key.name.c_str()), largest);
    case Kind::list:
        for (size_t i = 0; i < key.member.count(value); ++i)
            key.objects[0]->checkAny(key.member.element(value, i), where.in(key.name.c_str(), i), largest);
        return;
    default:
        return;
    }
}

void Description::writeAny(const void* object, JsonValue& out, const void* context) const {
    for (const Key& key : keys_) {
        if (unmet(key, object)) continue;
        if (key.kind == Kind::variant) {
            const void* variant = key.value(object);
            const Description& held = *key.objects[size_t(key.member.index(variant))];
            out.add(key.name, JsonValue::makeString(held.name()));
            held.writeAny(key.member.held(variant), out, context);
            continue;
        }
        JsonValue value = writeKey(key, object, key.needed ? nullptr : usual_, context);
        if (value.kind != JsonValue::Kind::null) out.add(key.name, std::move(value));
    }
}

// Null: the key is left out, because the value is the usual one, or there is none.
JsonValue Description::writeKey(const Key& key, const void* object, const void* usual, const void* context) {
    if (key.write) return key.write(object, context);
    if (key.kind == Kind::byHand) return {};
    const void* value = key.value(object);
    if (!value) return {};
    const void* unless = usual ? key.value(usual) : nullptr;
    const auto unlessSame = [&]<typename T>(const T& current, auto make) {
        return unless && current == held<T>(unless) ? JsonValue() : make(current);
    };
    switch (key.kind) {
    case Kind::number:
        return unlessSame(held<double>(value), JsonValue::makeNumber);
    case Kind::whole:
        return unlessSame(held<int>(value), JsonValue::makeNumber);
    case Kind::seed:
        return unlessSame(held<uint32_t>(value), JsonValue::makeNumber);
    case Kind::whole3:
        return unlessSame(held<glm::ivec3>(value), JsonValue::makeVector<3, int>);
    case Kind::longSeed:
        return unlessSame(held<uint64_t>(value),
                          [](uint64_t seed) { return JsonValue::makeNumber(double(seed)); });
    case Kind::flag:
        return unlessSame(held<bool>(value), JsonValue::makeBoolean);
    case Kind::text:
        return unlessSame(held<std::string>(value), JsonValue::makeString);
    case Kind::texts: {
        JsonValue out = JsonValue::makeArray();
        for (const std::string& text : held<std::vector<std::string>>(value))
            out.items.push_back(JsonValue::makeString(text));
        return out.items.empty() ? JsonValue() : out;
    }
    case Kind::vector2:
        return unlessSame(held<glm::dvec2>(value), JsonValue::makeVector<2, double>);
    case Kind::vector3:
    case Kind::direction:
    case Kind::color:
        return unlessSame(held<glm::dvec3>(value), JsonValue::makeVector<3, double>);
    case Kind::ends:
        return unlessSame(held<glm::dvec2>(value), [&](const glm::dvec2& ends) {
            const bool usualStart = unless && ends.x == held<glm::dvec2>(unless).x;
            return usualStart ? JsonValue::makeNumber(ends.y) : JsonValue::makeVector(ends);
        });
    case Kind::span:
        return unlessSame(held<glm::dvec2>(value), [](const glm::dvec2& span) {
            return span.x == span.y ? JsonValue::makeNumber(span.x) : JsonValue::makeVector(span);
        });
    case Kind::box:
        if (unless && held<Box>(unless).low == held<Box>(value).low &&
            held<Box>(unless).high == held<Box>(value).high)
            return {};
        return writeBox(held<Box>(value));
    case Kind::rotation:
        return unlessSame(held<glm::dquat>(value), [](const glm::dquat& q) {
            return JsonValue::makeVector(glm::dvec4(q.x, q.y, q.z, q.w));
        });
    case Kind::word: {
        const int index = key.member.index(value);
        if (unless && index == key.member.index(unless)) return {};
        return JsonValue::makeString(key.words[size_t(index)]);
    }
    case Kind::object: {
        JsonValue out = JsonValue::makeObject();
        key.objects[0]->writeAny(value, out, context);
        return key.member.optional || !out.members.empty() ? out : JsonValue();
    }
    case Kind::list: {
        if (key.member.count(value) == 0) return {};
        const auto write = [&](const void* list) {
            JsonValue out = JsonValue::makeArray();
            for (size_t i = 0; i < key.member.count(list); ++i) {
                out.items.push_back(JsonValue::makeObject());
                key.objects[0]->writeAny(key.member.element(list, i), out.items.back(), context);
            }
            return out;
        };
        JsonValue out = write(value);
        return unless && writeJsonLine(out) == writeJsonLine(write(unless)) ? JsonValue() : out;
    }
    case Kind::variant:
    case Kind::byHand:
        break;
    }
    return {};
}

}  // namespace shoal
