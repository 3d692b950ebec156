// Builds a description (core/description.h) key by key:
//   const Description& describe(const SphereCollider*) {
//       static const Description it = Describe<SphereCollider>("sphere", "A sphere that is solid inside.")
//           .key("center", &SphereCollider::center, {"m", "Its centre."})
//           .key("radius", &SphereCollider::radius, {"m", "Its radius.", aboveZero()});
//       return it;
//   }
//
// Nested structs, lists and variants are found through the overload `describe(const T*)`: a kind of a variant
// that has none does not compile.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "core/boxed.h"
#include "core/description.h"

namespace shoal {

// Builds a description key by key.
template <typename S>
class Describe {
  public:
    // `name`: the word of a variant's alternative, or what the object is called in docs.
    Describe(std::string name, std::string sentence) {
        description_.name_ = std::move(name);
        description_.sentence_ = std::move(sentence);
        description_.usual_ = &usual();
        description_.type_ = &typeid(S);
    }

    // Numbers, whole numbers, seeds, flags, texts, vectors, objects and lists of objects, by their types; any
    // of them may be optional. Other kinds (core/key_kind.h) are named.
    template <typename M>
    Describe& key(const char* name, M S::*member, Says says, const KeyKind& kind = kindOf<M>()) {
        Key& key = addKey(name, kind, std::move(says));
        key.member.offset = offsetOf(member);
        reach<M>(key);
        return *this;
    }
    template <typename M>
    Describe& direction(const char* name, M S::*member, Says says) {
        return key(name, member, std::move(says), Key::Kind::direction);
    }
    template <typename M>
    Describe& color(const char* name, M S::*member, Says says) {
        says.range.least = 0;
        return key(name, member, std::move(says), Key::Kind::color);
    }
    Describe& span(const char* name, glm::dvec2 S::*member, Says says) {
        return key(name, member, std::move(says), Key::Kind::span);
    }
    Describe& ends(const char* name, glm::dvec2 S::*member, Says says) {
        return key(name, member, std::move(says), Key::Kind::ends);
    }
    template <typename M>
    Describe& box(const char* name, M S::*member, Says says, bool flat = false) {
        key(name, member, std::move(says), Key::Kind::box);
        last().flatBox = flat;
        return *this;
    }
    Describe& rotation(const char* name, glm::dquat S::*member, Says says) {
        return key(name, member, std::move(says), Key::Kind::rotation);
    }
    // One of some words; the member is an enumeration, whose values are their indices.
    template <typename Enum>
    Describe& word(const char* name, Enum S::*member, const std::vector<std::string>& words, Says says) {
        key(name, member, std::move(says), Key::Kind::word);
        last().words = words;
        last().member.index = [](const void* object) { return int(*static_cast<const Enum*>(object)); };
        last().member.choose = [](void* object, int index) {
            *static_cast<Enum*>(object) = Enum(index);
            return object;
        };
        return *this;
    }
    // Describes an optional enumeration, whose first word stands for nothing.
    template <typename Enum>
    Describe& word(const char* name, std::optional<Enum> S::*member, const std::vector<std::string>& words,
                   Says says) {
        key(name, member, std::move(says), Key::Kind::word);
        last().words = words;
        last().member = {.offset = last().member.offset};
        last().member.index = [](const void* object) {
            const auto& value = *static_cast<const std::optional<Enum>*>(object);
            return value ? int(*value) + 1 : 0;
        };
        last().member.choose = [](void* object, int index) {
            *static_cast<std::optional<Enum>*>(object) =
                index > 0 ? std::optional(Enum(index - 1)) : std::nullopt;
            return object;
        };
        return *this;
    }
    // An object whose keys are of this struct as well.
    Describe& part(const char* name, const Description& keys, std::string sentence) {
        EXPECTS(keys.isOf(typeid(S)));
        addKey(name, Key::Kind::object, {"", std::move(sentence)}).objects = {&keys};
        return *this;
    }
    // A list of objects that is not a member itself. `make` gives it, made where there is none; `look` gives
    // null where there is none.
    template <auto make, auto look>
    Describe& list(const char* name, std::string sentence) {
        using Element = typename std::remove_reference_t<decltype(make(std::declval<S&>()))>::value_type;
        Key& key = addKey(name, Key::Kind::list, {"", std::move(sentence)});
        reach<std::vector<Element>>(key);
        key.member.make = [](void* object) -> void* { return &make(*static_cast<S*>(object)); };
        key.member.look = [](const void* object) -> const void* {
            return look(*static_cast<const S*>(object));
        };
        return *this;
    }
    // The keys of a struct within this one, beside this one's own.
    template <typename M>
    Describe& keysOf(M S::*member) {
        for (Key key : describe(static_cast<const M*>(nullptr)).keys()) {
            EXPECTS(key.kind != Key::Kind::byHand);
            key.member.offset += offsetOf(member);
            description_.keys_.push_back(std::move(key));
        }
        return *this;
    }
    // A word that chooses what the variant holds: the names of the alternatives' descriptions.
    template <typename M>
    Describe& alternatives(const char* name, M S::*member, Says says) {
        key(name, member, std::move(says), Key::Kind::variant);
        addAlternatives<M>(variantIn(static_cast<const M*>(nullptr)));
        return needed();
    }
    // A key that `read` takes.
    template <typename Context = void>
    Describe& byHand(const char* name, Form form, Says says,
                     std::type_identity_t<std::function<void(JsonReader&, S&, Context*)>> read,
                     std::function<JsonValue(const S&, const void*)> write = {}) {
        Key& key = addKey(name, Key::Kind::byHand, std::move(says));
        key.form = std::move(form);
        key.read = [read](JsonReader& reader, void* object, void* context) {
            read(reader, *static_cast<S*>(object), static_cast<Context*>(context));
        };
        if (write) writes(std::move(write));
        return *this;
    }

    // The struct whose keys the key before holds, which is read by hand.
    Describe& holdsKeys(const Description& keys) {
        last().objects = {&keys};
        return *this;
    }

    // The keys of a whole file, such as one of "shoal-scene-1".
    Describe& format(const std::string& name) {
        description_.format_ = name;
        const auto nothing = [](JsonReader&, S&, void*) {};
        byHand("$schema", {}, {"string", "The schema, for editors."}, nothing);
        byHand("format", {.constant = name},
               {concat("`\"", name, "\"`"), "The format of the file and its version."}, nothing);
        return needed();
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
    Describe& only(const char* key, std::vector<std::string> words) {
        EXPECTS(description_.find(key));
        last().only.push_back({key, std::move(words)});
        return *this;
    }
    // Sets the default, in words, of the key before.
    Describe& usually(const std::string& words) {
        last().usual = words;
        return *this;
    }
    // Sets what acts where the key before is left out, and is no default that a description can tell.
    Describe& acts(JsonValue (*instead)(const S&)) {
        last().acts = [instead](const void* object) { return instead(*static_cast<const S*>(object)); };
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
        description_.location_ = offsetOf(member);
        return *this;
    }
    // Sets what follows from the keys that a file gives, such as a default that depends on another key; it
    // runs before the rule.
    Describe& derive(void (*follow)(S&, const Where&)) {
        description_.derive_ = [follow](void* object, const Where& where, void*) {
            follow(*static_cast<S*>(object), where);
        };
        return *this;
    }
    template <typename Context>
    Describe& derive(void (*follow)(S&, const Where&, Context&)) {
        description_.derive_ = [follow](void* object, const Where& where, void* context) {
            follow(*static_cast<S*>(object), where, *static_cast<Context*>(context));
        };
        return *this;
    }
    // A rule between keys: throws an Error where it is broken. `schema`: as much of it as JSON Schema can
    // say.
    Describe& rule(void (*holds)(const S&, const Where&), const char* schema = "") {
        description_.schema_ = schema;
        description_.rule_ = [holds](const void* object, const Where& where) {
            holds(*static_cast<const S*>(object), where);
        };
        return *this;
    }

    operator Description() { return std::move(description_); }

  private:
    static const S& usual() {
        static const S value{};
        return value;
    }
    Key& last() { return description_.keys_.back(); }

    template <typename M>
    static ptrdiff_t offsetOf(M S::*member) {
        const S& sample = usual();
        return reinterpret_cast<const char*>(&(sample.*member)) - reinterpret_cast<const char*>(&sample);
    }
    Key& addKey(const char* name, const KeyKind& kind, Says says) {
        Key& key = description_.keys_.emplace_back();
        key.name = name;
        key.kind = &kind;
        key.says = std::move(says);
        return key;
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
    static const KeyKind& kindOf() {
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
            key.member.reset = [](void* object) { static_cast<M*>(object)->reset(); };
            key.member.make = [](void* object) -> void* { return &static_cast<M*>(object)->emplace(); };
            key.member.look = [](const void* object) -> const void* {
                const M& value = *static_cast<const M*>(object);
                return value ? &*value : nullptr;
            };
        }
        if constexpr (Within<M>::list) {
            key.member.count = [](const void* object) { return static_cast<const M*>(object)->size(); };
            key.member.erase = [](void* object, size_t i) {
                auto& list = *static_cast<M*>(object);
                list.erase(list.begin() + ptrdiff_t(i));
            };
            key.member.clear = [](void* object) { static_cast<M*>(object)->clear(); };
            key.member.append = [](void* object) -> void* {
                return &static_cast<M*>(object)->emplace_back();
            };
            key.member.element = [](const void* object, size_t i) -> const void* {
                return &(*static_cast<const M*>(object))[i];
            };
        }
        if (key.kind == Key::Kind::object || key.kind == Key::Kind::list) {
            if constexpr (std::is_class_v<T> && requires(const T* t) { describe(t); })
                key.objects = {&describe(static_cast<const T*>(nullptr))};
            EXPECTS(!key.objects.empty());
        }
    }

    // Null pointers that tell the type of a variant, and of one in a box.
    template <typename... T>
    static const std::variant<T...>* variantIn(const std::variant<T...>*) {
        return nullptr;
    }
    template <typename V>
    static auto variantIn(const Boxed<V>*) {
        return variantIn(static_cast<const V*>(nullptr));
    }
    template <typename M>
    static auto& inside(M& member) {
        if constexpr (requires { *member; })
            return *member;
        else
            return member;
    }
    template <typename M, typename... T>
    void addAlternatives(const std::variant<T...>*) {
        using Variant = std::variant<T...>;
        Key& key = last();
        key.objects = {&describe(static_cast<const T*>(nullptr))...};
        for (const Description* alternative : key.objects)
            key.words.push_back(alternative->name());
        key.member.index = [](const void* object) {
            return int(inside(*static_cast<const M*>(object)).index());
        };
        key.member.choose = [](void* object, int index) {
            Variant& variant = inside(*static_cast<M*>(object));
            return emplace(variant, size_t(index), std::index_sequence_for<T...>());
        };
        key.member.held = [](const void* object) {
            const Variant& variant = inside(*static_cast<const M*>(object));
            return std::visit([](const auto& alternative) { return static_cast<const void*>(&alternative); },
                              variant);
        };
    }
    template <typename Variant, size_t... I>
    static void* emplace(Variant& variant, size_t index, std::index_sequence<I...>) {
        void* out = nullptr;
        (void)((I == index && (out = &variant.template emplace<I>(), true)) || ...);
        return out;
    }

    Description description_;
};

}  // namespace shoal
