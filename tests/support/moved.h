// Structs that are described, with every slider somewhere within its limits and now and then at an end.
#pragma once

#include <algorithm>
#include <set>
#include <string>

#include "core/description.h"
#include "core/random.h"

namespace shoal::test {

class Sliders {
  public:
    explicit Sliders(uint64_t seed) : random_(seed, 11) {}

    // Keeps to the rules between keys; leaves the keys `but`, words and lists as they are.
    template <typename S>
    S moved(const S& from, const std::set<std::string>& but = {}) {
        for (int tries = 0; tries < 10000; ++tries) {
            S out = from;
            moveAll(describe(&out), &out, but);
            try {
                describe(&out).check(out, Where(), 1e15);
                return out;
            } catch (const Error&) {
            }
        }
        throw Error("no slider may be moved");
    }
    double in(const Slider& slider) {
        const double dice = random_.uniform();
        if (dice < 0.15) return slider.least;
        if (dice < 0.3) return slider.most;
        return random_.uniform(slider.least, slider.most);
    }
    int whole(int count) { return int(random_.uniform() * count); }

  private:
    void moveAll(const Description& keys, void* object, const std::set<std::string>& but) {
        for (const Key& key : keys.keys()) {
            if (but.contains(key.name) || keys.unmet(key, object)) continue;
            const void* value = key.member.look(static_cast<char*>(object) + key.member.offset);
            if (value) move(key, const_cast<void*>(value), sliderOf(key, object));
        }
    }
    void move(const Key& key, void* value, const Slider& slider) {
        const auto place = [&] { return glm::dvec3(in(slider), in(slider), in(slider)); };
        const double a = in(slider), b = in(slider);
        using Kind = Key::Kind;
        if (key.kind == Kind::number) *static_cast<double*>(value) = a;
        if (key.kind == Kind::whole) *static_cast<int*>(value) = int(a);
        if (key.kind == Kind::flag) *static_cast<bool*>(value) = random_.uniform() < 0.5;
        if (key.kind == Kind::span) *static_cast<glm::dvec2*>(value) = {std::min(a, b), std::max(a, b)};
        if (key.kind == Kind::ends) *static_cast<glm::dvec2*>(value) = {a, b};
        if (key.kind == Kind::vector3) *static_cast<glm::dvec3*>(value) = place();
        if (key.kind == Kind::direction) *static_cast<glm::dvec3*>(value) = random_.direction();
        if (key.kind == Kind::object) moveAll(*key.objects[0], value, {});
        if (key.kind != Kind::box) return;
        const glm::dvec3 corner = place(), other = place();
        *static_cast<Box*>(value) = {glm::min(corner, other), glm::max(corner, other)};
    }

    Random random_;
};

}  // namespace shoal::test
