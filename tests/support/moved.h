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
        switch (key.kind) {
        case Key::Kind::number:
            *static_cast<double*>(value) = a;
            return;
        case Key::Kind::whole:
            *static_cast<int*>(value) = int(a);
            return;
        case Key::Kind::flag:
            *static_cast<bool*>(value) = random_.uniform() < 0.5;
            return;
        case Key::Kind::span:
            *static_cast<glm::dvec2*>(value) = {std::min(a, b), std::max(a, b)};
            return;
        case Key::Kind::ends:
            *static_cast<glm::dvec2*>(value) = {a, b};
            return;
        case Key::Kind::vector3:
            *static_cast<glm::dvec3*>(value) = place();
            return;
        case Key::Kind::direction:
            *static_cast<glm::dvec3*>(value) = random_.direction();
            return;
        case Key::Kind::box: {
            const glm::dvec3 one = place(), other = place();
            *static_cast<Box*>(value) = {glm::min(one, other), glm::max(one, other)};
            return;
        }
        case Key::Kind::object:
            return moveAll(*key.objects[0], value, {});
        default:
            return;
        }
    }

    Random random_;
};

}  // namespace shoal::test
