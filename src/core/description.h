// Describes once what a file may say of a struct. A description lists the keys of an object: for each its
// name, the member that it fills, its unit and limits, and a sentence. The default is the struct's own.
// Reading, checking what was made in code, writing, the parts of the JSON Schema and the tables in
// docs/scene-format.md all go by the description. core/describe.h builds it.
// A description is plain data, so that it costs no template code at each use.
#pragma once

#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <typeinfo>
#include <vector>

#include "core/contract.h"
#include "core/key_kind.h"

namespace shoal {

// A member of whatever type, by what is needed of it.
struct Member {
    ptrdiff_t offset = 0;                                        // bytes, within the struct
    void* (*make)(void*) = [](void* object) { return object; };  // the value, made where there is none
    const void* (*look)(const void*) = [](const void* object) { return object; };  // null where there is none
    int (*index)(const void*) = nullptr;                                           // words and variants
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

// No number of a scene is further from 0. The GPU computes in single precision: squares of larger numbers
// would overflow there.
constexpr double largestNumber = 1e15;

// A key that means something only beside what another key says, which stands before it.
struct Condition {
    std::string key;
    std::vector<std::string> words;            // what it may say, "true" of a flag; none: it must be there
    bool isMet(const JsonValue& value) const;  // null: the other key is left out
};

// The value of a key that a function beside the description reads: one value, or lists of them.
struct Form {
    enum class Value { text, number, whole, keys, numberOrKeys };
    struct List {
        size_t least = 0, most = std::numeric_limits<size_t>::max();
    };
    Value value = Value::text;
    std::vector<List> lists = {};  // how many each holds, the outermost first
    Range range = {};              // of each number
    std::optional<double> usual = {};
    std::string constant = {};  // the only text that it may be
    bool notEmpty = false;      // a text has at least one character
};

struct Key {
    using Kind = KeyKind;
    std::string name;
    const KeyKind* kind = &Kind::number;
    Says says;
    bool needed = false;
    bool unlessZero = false;  // 0 stands for no key
    bool flatBox = false;     // a box may have no inside
    bool notEmpty = false;    // a text has at least one character
    std::vector<Condition> only;
    std::string usual;  // what a table says of its default, where that is not a value
    std::function<JsonValue(const void* object)> acts;  // in its place where it is left out; null: nothing
    std::vector<std::string> words;
    Member member;
    std::vector<const Description*> objects;  // of an object or a list: one; of a variant: its alternatives
    Form form;                                // byHand; its keys are those of `objects`
    std::function<void(JsonReader&, void* object, void* context)> read;  // byHand, and instead of a member
    // byHand, and where what is written is not the member itself; null: the key is left out
    std::function<JsonValue(const void* object, const void* context)> write;

    void* place(void* object) const { return static_cast<char*>(object) + member.offset; }
    const void* value(const void* object) const {  // null: there is none
        return member.look(static_cast<const char*>(object) + member.offset);
    }
};

class Description {
  public:
    const std::string& name() const { return name_; }
    const std::string& sentence() const { return sentence_; }
    const std::vector<Key>& keys() const { return keys_; }
    JsonValue usualValue(const Key& key) const;            // of a key that is left out; null: there is none
    const std::string& schema() const { return schema_; }  // of rules between keys; may be empty
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
    // Fills a struct from a whole file, whose "format" must be the description's.
    template <typename S>
    void readFile(const JsonValue& root, const std::string& file, S& out, void* context = nullptr) const {
        EXPECTS(isOf(typeid(S)));
        readFileAny(root, file, &out, context);
    }
    // Error, in the reader's words: the struct holds what a file could not say, or a number further from 0
    // than `largest`.
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

    // Likewise of a struct whose type only the description knows, for kinds of keys.
    void readAny(JsonReader& reader, void* out, void* context) const;
    void checkAny(const void* object, const Where& where, double largest) const;
    void writeAny(const void* object, JsonValue& out, const void* context) const;

  private:
    template <typename S>
    friend class Describe;
    bool isUsual(const Key& key, const void* object) const;
    void readSomeAny(std::initializer_list<const char*> names, JsonReader& reader, void* out,
                     void* context) const;
    JsonValue writeSomeAny(std::initializer_list<const char*> names, const void* object,
                           const void* context) const;
    void readFileAny(const JsonValue& root, const std::string& file, void* out, void* context) const;

    std::string name_, sentence_, schema_, format_;
    std::vector<Key> keys_;
    const void* usual_ = nullptr;
    const std::type_info* type_ = nullptr;
    ptrdiff_t location_ = -1;  // of the member that remembers where the object stands; -1: none does
    std::function<void(void*, const Where&, void* context)> derive_;
    std::function<void(const void*, const Where&)> rule_;
};

// Returns the range of the slider for a number that an object has now. It always includes the object's own
// numbers, but no value that the key does not allow.
Slider sliderOf(const Key& key, const void* object);
Slider sliderOf(const Key& key, const std::vector<double>& numbers);  // of its value

}  // namespace shoal
