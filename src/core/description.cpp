#include "core/description.h"

#include <algorithm>
#include <cmath>

namespace shoal {

namespace {

// As a file says it: "on": "vertices" or "surface".
std::string text(const Condition& condition) {
    std::vector<std::string> words;
    for (const std::string& word : condition.words)
        words.push_back(word == "true" ? word : concat("\"", word, "\""));
    return concat("\"", condition.key, "\"", words.empty() ? "" : ": ", joined(words, " or "));
}

void readKey(const Key& key, JsonReader& reader, void* object, void* context) {
    if (!key.read) return key.kind->read(key, reader, object, context);
    reader.raw(key.name);  // known even when absent
    key.read(reader, object, context);
}

// Null: the key is left out, because the value is the usual one, or there is none.
JsonValue writeKey(const Key& key, const void* object, const void* usual, const void* context) {
    if (key.write) return key.write(object, context);
    const void* value = key.value(object);
    return value ? key.kind->write(key, value, usual ? key.value(usual) : nullptr, context) : JsonValue();
}

}  // namespace

bool Condition::isMet(const JsonValue& value) const {
    if (words.empty()) return value.kind != JsonValue::Kind::null;
    const bool flag = value.kind == JsonValue::Kind::boolean;
    const std::string word = flag ? (value.boolean ? "true" : "false") : value.text;
    return std::find(words.begin(), words.end(), word) != words.end();
}

JsonValue Description::usualValue(const Key& key) const {
    if (key.kind == Key::Kind::byHand || !key.objects.empty() || !key.usual.empty()) return {};
    JsonValue out = writeKey(key, usual_, nullptr, nullptr);
    const bool empty = out.kind == JsonValue::Kind::string && out.text.empty();
    return empty ? JsonValue() : out;
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
        const bool empty =
            value && other.kind == Key::Kind::text && static_cast<const std::string*>(value)->empty();
        const bool met =
            value && !empty &&
            (condition.words.empty() || condition.isMet(other.kind->write(other, value, nullptr, nullptr)));
        if (!met) return &condition;
    }
    return nullptr;
}

Slider sliderOf(const Key& key, const void* object) {
    const void* value = key.value(object);
    return sliderOf(key, value && key.kind->numbers ? key.kind->numbers(value) : std::vector<double>());
}

Slider sliderOf(const Key& key, const std::vector<double>& numbers) {
    const Range& range = key.says.range;
    Slider out = key.says.slider;
    double largest = 0;
    for (const double number : numbers)
        if (std::abs(number) < largestNumber) largest = std::max(largest, std::abs(number));
    if (out.least == out.most) {
        const double reach = key.kind->sliderReach;
        out.most = reach > 0 ? reach : largest > 0 ? 5 * largest : 1;
        out.steep = range.least == leastPositive;
        out.least = out.steep ? out.most / 1000 : std::isfinite(range.least) ? range.least : -out.most;
        if (std::isfinite(range.most)) out.most = range.most;
    }
    for (const double number : numbers) {
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
    if (key.needed || key.member.optional || !key.kind->freeUsual) return false;
    return key.kind->write(key, key.value(object), key.value(usual_), nullptr).kind == JsonValue::Kind::null;
}

void Description::checkAny(const void* object, const Where& where, double largest) const {
    for (const Key& key : keys_)
        if (const void* value = key.value(object);
            key.kind->check && value && !unmet(key, object) && !isUsual(key, object))
            key.kind->check(key, value, where, largest);
    if (rule_) rule_(object, where);
}

void Description::writeAny(const void* object, JsonValue& out, const void* context) const {
    for (const Key& key : keys_) {
        if (unmet(key, object)) continue;
        JsonValue value = writeKey(key, object, key.needed ? nullptr : usual_, context);
        if (value.kind != JsonValue::Kind::null) out.add(key.name, std::move(value));
        if (!key.member.held) continue;
        const void* variant = key.value(object);
        key.objects[size_t(key.member.index(variant))]->writeAny(key.member.held(variant), out, context);
    }
}

}  // namespace shoal
