// Describes once what a file may say of a struct. A description lists the keys of an object: for each its
// name, the member that it fills, its unit and limits, and a sentence. The default is the struct's own.
// Reading, checking what was made in code, writing, the parts of the JSON Schema and the tables in
// docs/scene-format.md all go by the description.
//
//   const Description& describe(const SphereCollider*) {
//       static const Description it = Describe<SphereCollider>("sphere", "A sphere that is solid inside.")
//           .key("center", &SphereCollider::center, {"m", "Its centre."})
//           .key("radius", &SphereCollider::radius, {"m", "Its radius.", aboveZero()});
//       return it;
//   }
//
// A description is plain data, so that it costs no template code at each use. Nested structs, lists and
// variants are found through the overload `describe(const T*)`: a kind of a variant that has none does not
// compile.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <variant>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/contract.h"
#include "core/json_values.h"
#include "core/where.h"

namespace shoal {

class Description;

// A member of whatever type, by what is needed of it.
struct Member {
    ptrdiff_t offset = 0;                                // bytes, within the struct
    void* (*make)(void*) = [](void* at) { return at; };  // the value, made where there is none
    const void* (*look)(const void*) = [](const void* at) { return at; };  // null where there is none
    int (*index)(const void*) = nullptr;                                   // words and variants
    void* (*choose)(void*, int) = nullptr;       // likewise; the alternative of a variant
    const void* (*held)(const void*) = nullptr;  // the alternative that a variant holds
    size_t (*count)(const void*) = nullptr;      // lists
    void (*clear)(void*) = nullptr;
    void* (*append)(void*) = nullptr;
    const void* (*element)(const void*, size_t) = nullptr;
    void (*erase)(void*, size_t) = nullptr;
    void (*reset)(void*) = nullptr;  // an optional one
    bool optional = false;
};

// How far a slider goes. It goes further where a file does.
struct Slider {
    double least = 0, most = 0;  // equal: from the limits of the key
    bool steep = false;          // logarithmic: small numbers have more room
};

// Describes a key: its unit, meaning, limits and slider.
struct Says {
    std::string unit;      // "m/s"; empty: a number without one; of a text: what it names
    std::string sentence;  // in plain English
    Range range = {};
    Slider slider = {};
};

// A key that means something only beside what another key says, which stands before it.
struct Condition {
    std::string key;
    std::vector<std::string> words;  // what it may say, "true" of a flag; none: it must be there
    std::string because;             // goes on from the name of the key that means nothing
};

struct Key {
    enum class Kind {
        number,
        whole,
        whole3,  // three of them
        seed,
        longSeed,  // of 64 bits
        flag,
        word,   // one of `words`
        text,   // any string
        texts,  // a list of strings
        vector2,
        vector3,
        direction,  // of any length above 0; made a unit vector
        color,      // linear RGB, at least 0
        span,       // [least, most], or one number for both
        ends,       // [first, last], or one number for the last
        box,        // {"low", "high"}
        rotation,   // [x, y, z, w], or {"axis", "angle"}
        object,
        list,     // of objects
        variant,  // a word that chooses an alternative, whose keys stand beside it
        byHand,   // read by a function beside the description
    };
    std::string name;
    Kind kind = Kind::number;
    Says says;
    bool needed = false;
    bool unlessZero = false;  // 0 stands for no key
    bool flatBox = false;     // a box may have no inside
    bool notEmpty = false;    // a text has at least one character
    std::vector<Condition> only;
    std::string usual;  // what a table says of its default, where that is not a value
    std::vector<std::string> words;
    Member member;
    std::vector<const Description*> objects;  // of an object or a list: one; of a variant: its alternatives
    std::string schema;                       // byHand: the JSON Schema of its value
    std::function<void(JsonReader&, void* object, void* context)> read;  // byHand, and instead of a member
    // byHand, and where what is written is not the member itself; null: the key is left out
    std::function<JsonValue(const void* object, const void* context)> write;
};

class Description {
  public:
    const std::string& name() const { return name_; }
    const std::string& sentence() const { return sentence_; }
    const std::vector<Key>& keys() const { return keys_; }
    const void* usual() const { return usual_; }  // a struct as it is without any key
    JsonValue usualValue(const Key& key) const;   // of a key that is left out; null: there is none
    const std::string& schema() const {
        return schema_;
    }  // of rules between keys, as JSON Schema; may be empty
    bool isOf(const std::type_info& type) const { return *type_ == type; }
    const Key* find(const std::string& name) const;  // null: there is none
    // The first condition of a key that an object does not meet; null: the key means something.
    const Condition* unmet(const Key& key, const void* object) const;

    // Fills a struct from an object; what is not there stays. Error, located: the first key that is missing,
    // mistyped, out of its limits, or breaks a rule between keys. `context` goes to the keys that are read by
    // hand. The reader's finish(), which refuses unknown keys, is the caller's; objects within are finished.
    template <typename S>
    void read(JsonReader& reader, S& out, void* context = nullptr) const {
        EXPECTS(isOf(typeid(S)));
        readAny(reader, &out, context);
    }
    // Error: what a file could not say of the struct, by the same words; no number is further from 0 than
    // `largest`.
    template <typename S>
    void check(const S& object, const Where& where, double largest) const {
        EXPECTS(isOf(typeid(S)));
        checkAny(&object, where, largest);
    }
    // The keys of what differs from the usual and means something.
    template <typename S>
    JsonValue write(const S& object, const void* context = nullptr) const {
        EXPECTS(isOf(typeid(S)));
        JsonValue out = JsonValue::makeObject();
        writeAny(&object, out, context);
        return out;
    }
    // The keys of some names alone, without what follows from them and without the rule.
    template <typename S>
    void readSome(std::initializer_list<const char*> names, JsonReader& reader, S& out,
                  void* context = nullptr) const {
        EXPECTS(isOf(typeid(S)));
        readSomeAny(names, reader, &out, context);
    }
    template <typename S>
    JsonValue writeSome(std::initializer_list<const char*> names, const S& object,
                        const void* context = nullptr) const {
        EXPECTS(isOf(typeid(S)));
        return writeSomeAny(names, &object, context);
    }

  private:
    template <typename S>
    friend class Describe;
    bool isUsual(const Key& key, const void* object) const;
    void readSomeAny(std::initializer_list<const char*> names, JsonReader& reader, void* out,
                     void* context) const;
    JsonValue writeSomeAny(std::initializer_list<const char*> names, const void* object,
                           const void* context) const;
    void readAny(JsonReader& reader, void* out, void* context) const;
    void checkAny(const void* object, const Where& where, double largest) const;
    void writeAny(const void* object, JsonValue& out, const void* context) const;

    static void readKey(const Key& key, JsonReader& reader, void* out, void* context);
    static void checkKey(const Key& key, const void* object, const Where& where, double largest);
    static JsonValue writeKey(const Key& key, const void* object, const void* usual, const void* context);

    std::string name_, sentence_, schema_;
    std::vector<Key> keys_;
    const void* usual_ = nullptr;
    const std::type_info* type_ = nullptr;
    ptrdiff_t location_ = -1;  // of the member that remembers where the object stands; -1: none does
    std::function<void(void*, const Where&)> derive_;
    std::function<void(const void*, const Where&)> rule_;
};

// How far the slider of a number goes, which an object has now: its own numbers are always within, and
// nothing that the key may not say.
Slider sliderOf(const Key& key, const void* object);

// The struct of a key whose object may be absent.
template <typename S>
std::optional<S> readDescribed(JsonReader& reader, const std::string& key) {
    std::optional<JsonReader> inner = reader.object(key);
    if (!inner) return {};
    S out;
    describe(&out).read(*inner, out);
    inner->finish();
    return out;
}

// Builds a description key by key.
template <typename S>
class Describe {
  public:
    // `name`: the word of a variant's alternative, or what the object is called in docs.
    Describe(std::string name, std::string sentence) {
        it_.name_ = std::move(name);
        it_.sentence_ = std::move(sentence);
        it_.usual_ = &usual();
        it_.type_ = &typeid(S);
    }

    // Numbers, whole numbers, seeds, flags, texts, vectors, objects and lists of objects, by their types; any
    // of them may be optional.
    template <typename M>
    Describe& key(const char* name, M S::*member, Says says) {
        return add(name, kindOf<M>(), member, std::move(says));
    }
    template <typename M>
    Describe& direction(const char* name, M S::*member, Says says) {
        return add(name, Key::Kind::direction, member, std::move(says));
    }
    template <typename M>
    Describe& color(const char* name, M S::*member, Says says) {
        says.range.least = 0;
        return add(name, Key::Kind::color, member, std::move(says));
    }
    Describe& span(const char* name, glm::dvec2 S::*member, Says says) {
        return add(name, Key::Kind::span, member, std::move(says));
    }
    Describe& ends(const char* name, glm::dvec2 S::*member, Says says) {
        return add(name, Key::Kind::ends, member, std::move(says));
    }
    template <typename M>
    Describe& box(const char* name, M S::*member, Says says, bool flat = false) {
        add(name, Key::Kind::box, member, std::move(says));
        last().flatBox = flat;
        return *this;
    }
    Describe& rotation(const char* name, glm::dquat S::*member, Says says) {
        return add(name, Key::Kind::rotation, member, std::move(says));
    }
    // One of some words; the member is an enumeration, whose values are their indices.
    template <typename Enum>
    Describe& word(const char* name, Enum S::*member, std::vector<std::string> words, Says says) {
        add(name, Key::Kind::word, member, std::move(says));
        last().words = std::move(words);
        last().member.index = [](const void* at) { return int(*static_cast<const Enum*>(at)); };
        last().member.choose = [](void* at, int index) {
            *static_cast<Enum*>(at) = Enum(index);
            return at;
        };
        return *this;
    }
    // Describes an optional enumeration, whose first word stands for nothing.
    template <typename Enum>
    Describe& word(const char* name, std::optional<Enum> S::*member, std::vector<std::string> words,
                   Says says) {
        add(name, Key::Kind::word, member, std::move(says));
        last().words = std::move(words);
        last().member = {.offset = last().member.offset};
        last().member.index = [](const void* at) {
            const auto& value = *static_cast<const std::optional<Enum>*>(at);
            return value ? int(*value) + 1 : 0;
        };
        last().member.choose = [](void* at, int index) {
            *static_cast<std::optional<Enum>*>(at) =
                index > 0 ? std::optional(Enum(index - 1)) : std::nullopt;
            return at;
        };
        return *this;
    }
    // An object whose keys are of this struct as well.
    Describe& part(const char* name, const Description& keys, std::string sentence) {
        EXPECTS(keys.isOf(typeid(S)));
        Key& key = it_.keys_.emplace_back();
        key.name = name;
        key.kind = Key::Kind::object;
        key.says.sentence = std::move(sentence);
        key.objects = {&keys};
        return *this;
    }
    // A list of objects that is not a member itself. `make` gives it, made where there is none; `look` gives
    // null where there is none.
    template <auto make, auto look>
    Describe& list(const char* name, std::string sentence) {
        using Element = typename std::remove_reference_t<decltype(make(std::declval<S&>()))>::value_type;
        using List = std::vector<Element>;
        Key& key = it_.keys_.emplace_back();
        key.name = name;
        key.kind = Key::Kind::list;
        key.says.sentence = std::move(sentence);
        reach<List>(key);
        key.member.make = [](void* at) -> void* { return &make(*static_cast<S*>(at)); };
        key.member.look = [](const void* at) -> const void* { return look(*static_cast<const S*>(at)); };
        return *this;
    }
    // The keys of a struct within this one, beside this one's own.
    template <typename M>
    Describe& keysOf(M S::*member) {
        const S& sample = usual();
        const ptrdiff_t offset =
            reinterpret_cast<const char*>(&(sample.*member)) - reinterpret_cast<const char*>(&sample);
        for (Key key : describe(static_cast<const M*>(nullptr)).keys()) {
            EXPECTS(key.kind != Key::Kind::byHand);
            key.member.offset += offset;
            it_.keys_.push_back(std::move(key));
        }
        return *this;
    }
    // A word that chooses what the variant holds: the names of the alternatives' descriptions.
    template <typename... T>
    Describe& alternatives(const char* name, std::variant<T...> S::*member, Says says) {
        using Variant = std::variant<T...>;
        add(name, Key::Kind::variant, member, std::move(says));
        last().objects = {&describe(static_cast<const T*>(nullptr))...};
        for (const Description* one : last().objects)
            last().words.push_back(one->name());
        last().member.index = [](const void* at) { return int(static_cast<const Variant*>(at)->index()); };
        last().member.choose = [](void* at, int index) {
            return emplace(*static_cast<Variant*>(at), size_t(index), std::index_sequence_for<T...>());
        };
        last().member.held = [](const void* at) {
            return std::visit([](const auto& one) { return static_cast<const void*>(&one); },
                              *static_cast<const Variant*>(at));
        };
        return needed();
    }
    // A key that `read` takes; `schema` is the JSON Schema of its value.
    template <typename Context = void>
    Describe& byHand(const char* name, std::string schema, Says says,
                     std::type_identity_t<std::function<void(JsonReader&, S&, Context*)>> read,
                     std::function<JsonValue(const S&, const void*)> write = {}) {
        Key& key = it_.keys_.emplace_back();
        key.name = name;
        key.kind = Key::Kind::byHand;
        key.says = std::move(says);
        key.schema = std::move(schema);
        key.read = [read](JsonReader& reader, void* object, void* context) {
            read(reader, *static_cast<S*>(object), static_cast<Context*>(context));
        };
        if (write) writes(std::move(write));
        return *this;
    }

    // A key that the function of another key takes as well.
    Describe& told(const char* name, std::string schema, Says says) {
        byHand(name, std::move(schema), std::move(says), [](JsonReader&, S&, void*) {});
        return *this;
    }

    // These concern the key before: a file must have it; 0 stands for a file that has it not; a text has at
    // least one character.
    Describe& needed() {
        last().needed = true;
        return *this;
    }
    Describe& unlessZero() {
        last().unlessZero = true;
        return *this;
    }
    Describe& notEmpty() {
        last().notEmpty = true;
        return *this;
    }
    // The key before means something only where `key`, which stands before it, says one of the words.
    Describe& only(const char* key, std::vector<std::string> words, std::string because) {
        EXPECTS(it_.find(key));
        last().only.push_back({key, std::move(words), std::move(because)});
        return *this;
    }
    // Sets the default, in words, of the key before.
    Describe& usually(std::string words) {
        last().usual = std::move(words);
        return *this;
    }
    // Sets how the key before is read instead.
    template <typename Context>
    Describe& reads(void (*read)(JsonReader&, S&, Context&)) {
        last().read = [read](JsonReader& reader, void* object, void* context) {
            read(reader, *static_cast<S*>(object), *static_cast<Context*>(context));
        };
        return *this;
    }
    // Sets what is written for the key before instead of its member; null: the key is left out.
    Describe& writes(std::function<JsonValue(const S&, const void* context)> write) {
        last().write = [write](const void* object, const void* context) {
            return write(*static_cast<const S*>(object), context);
        };
        return *this;
    }
    // Where the object stands.
    Describe& location(Location S::*member) {
        const S& sample = usual();
        it_.location_ =
            reinterpret_cast<const char*>(&(sample.*member)) - reinterpret_cast<const char*>(&sample);
        return *this;
    }
    // Sets what follows from the keys that a file gives, such as a default that depends on another key; it
    // runs before the rule.
    Describe& derive(void (*follow)(S&, const Where&)) {
        it_.derive_ = [follow](void* object, const Where& where) { follow(*static_cast<S*>(object), where); };
        return *this;
    }
    // A rule between keys: throws an Error where it is broken. `schema`: as much of it as JSON Schema can
    // say.
    Describe& rule(void (*holds)(const S&, const Where&), const char* schema = "") {
        it_.schema_ = schema;
        it_.rule_ = [holds](const void* object, const Where& where) {
            holds(*static_cast<const S*>(object), where);
        };
        return *this;
    }

    operator Description() { return std::move(it_); }

  private:
    static const S& usual() {
        static const S it{};
        return it;
    }
    Key& last() { return it_.keys_.back(); }

    template <typename M>
    Describe& add(const char* name, Key::Kind kind, M S::*member, Says says) {
        Key& key = it_.keys_.emplace_back();
        key.name = name;
        key.kind = kind;
        key.says = std::move(says);
        const S& sample = usual();
        key.member.offset =
            reinterpret_cast<const char*>(&(sample.*member)) - reinterpret_cast<const char*>(&sample);
        reach<M>(key);
        return *this;
    }

    template <typename M>
    struct Within {
        using type = M;
        static constexpr bool optional = false, list = false;
    };
    template <typename M>
    struct Within<std::optional<M>> {
        using type = M;
        static constexpr bool optional = true, list = false;
    };
    template <typename M>
    struct Within<std::vector<M>> {
        using type = M;
        static constexpr bool optional = false, list = true;
    };

    template <typename M>
    static constexpr Key::Kind kindOf() {
        using T = typename Within<M>::type;
        if (std::is_same_v<M, std::vector<std::string>>) return Key::Kind::texts;
        if (Within<M>::list) return Key::Kind::list;
        if (std::is_same_v<T, double>) return Key::Kind::number;
        if (std::is_same_v<T, int>) return Key::Kind::whole;
        if (std::is_same_v<T, glm::ivec3>) return Key::Kind::whole3;
        if (std::is_same_v<T, uint32_t>) return Key::Kind::seed;
        if (std::is_same_v<T, uint64_t>) return Key::Kind::longSeed;
        if (std::is_same_v<T, bool>) return Key::Kind::flag;
        if (std::is_same_v<T, std::string>) return Key::Kind::text;
        if (std::is_same_v<T, glm::dvec2>) return Key::Kind::vector2;
        if (std::is_same_v<T, glm::dvec3>) return Key::Kind::vector3;
        return Key::Kind::object;
    }

    template <typename M>
    static void reach(Key& key) {
        using T = typename Within<M>::type;
        if constexpr (Within<M>::optional) {
            key.member.optional = true;
            key.member.reset = [](void* at) { static_cast<M*>(at)->reset(); };
            key.member.make = [](void* at) -> void* { return &static_cast<M*>(at)->emplace(); };
            key.member.look = [](const void* at) -> const void* {
                const M& value = *static_cast<const M*>(at);
                return value ? &*value : nullptr;
            };
        }
        if constexpr (Within<M>::list) {
            key.member.count = [](const void* at) { return static_cast<const M*>(at)->size(); };
            key.member.erase = [](void* at, size_t i) {
                auto& list = *static_cast<M*>(at);
                list.erase(list.begin() + ptrdiff_t(i));
            };
            key.member.clear = [](void* at) { static_cast<M*>(at)->clear(); };
            key.member.append = [](void* at) -> void* { return &static_cast<M*>(at)->emplace_back(); };
            key.member.element = [](const void* at, size_t i) -> const void* {
                return &(*static_cast<const M*>(at))[i];
            };
        }
        if (key.kind == Key::Kind::object || key.kind == Key::Kind::list) {
            if constexpr (std::is_class_v<T> && requires(const T* t) { describe(t); })
                key.objects = {&describe(static_cast<const T*>(nullptr))};
            EXPECTS(!key.objects.empty());
        }
    }

    template <typename Variant, size_t... I>
    static void* emplace(Variant& variant, size_t index, std::index_sequence<I...>) {
        void* out = nullptr;
        (void)((I == index && (out = &variant.template emplace<I>(), true)) || ...);
        return out;
    }

    Description it_;
};

}  // namespace shoal
