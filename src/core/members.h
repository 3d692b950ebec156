// The members of a struct, listed once for whoever reads them from a file and whoever checks what was made in
// code: a function template `members(visitor, struct)` names each with its key and its limits, and the two
// visitors below do the rest, with the same words.
//
//   template <typename V>
//   void members(V& v, Either<SphereCollider> auto& sphere) {
//       v.number("radius", sphere.radius, Range::positive());
//   }
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/glm.hpp>

#include "core/where.h"

namespace shoal {

// A struct to be filled, or one to be looked at.
template <typename T, typename Struct>
concept Either = std::same_as<std::remove_const_t<T>, Struct>;

class ReadMembers {
  public:
    explicit ReadMembers(JsonReader& reader) : reader_(&reader) {}

    template <typename T>
    void number(const std::string& key, T& out, Range range = {}) {
        reader_->get(key, out, range);
    }
    void number(const std::string& key, std::optional<double>& out, Range range = {}) {
        double value = 0;
        if (reader_->get(key, value, range)) out = value;
    }
    void number(const std::string& key, std::optional<glm::dvec3>& out, Range range = {}) {
        glm::dvec3 value(0);
        if (reader_->get(key, value, range)) out = value;
    }
    // 0 stands for none, which a file says by leaving out the key.
    template <typename T>
    void unlessZero(const std::string& key, T& out, Range range) {
        reader_->get(key, out, range);
    }
    template <typename Word>
    void word(const std::string& key, Word& out, const std::vector<std::string>& words) {
        int index = int(out);
        reader_->choose(key, words, index);
        out = Word(index);
    }
    void flag(const std::string& key, bool& out) { reader_->get(key, out); }
    JsonReader& reader() { return *reader_; }

  private:
    JsonReader* reader_;
};

class CheckMembers {
  public:
    // `largest`: what every number is held to besides.
    CheckMembers(const Where& where, double largest) : where_(&where), largest_(largest) {}

    void number(const std::string& key, double value, Range range = {}) const;
    void number(const std::string& key, int value, Range range = {}) const;
    void number(const std::string& key, const std::optional<double>& value, Range range = {}) const;
    void number(const std::string& key, const glm::dvec2& value, Range range = {}) const;
    void number(const std::string& key, const glm::dvec3& value, Range range = {}) const;
    void number(const std::string& key, const std::optional<glm::dvec3>& value, Range range = {}) const;
    template <typename T>
    void unlessZero(const std::string& key, const T& value, Range range) const {
        if (value != T(0)) number(key, value, range);
    }
    template <typename Word>
    void word(const std::string& key, Word value, const std::vector<std::string>& words) const {
        number(key, int(value), Range::between(0, double(words.size()) - 1));
    }
    void flag(const std::string&, bool) const {}
    const Where& where() const { return *where_; }

  private:
    bool fine(double value, Range range) const;
    void refuse(const std::string& key, double value, Range range) const;

    const Where* where_;
    double largest_;
};

}  // namespace shoal
