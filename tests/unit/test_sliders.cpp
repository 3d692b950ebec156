// How far sliders go: never to where a scene could not be read again.
#include <cmath>

#include "core/description.h"
#include "core/random.h"
#include "scene/scene.h"
#include "support/catch.h"

using namespace shoal;

namespace {

template <typename S>
Slider sliderFor(const char* key, const S& object) {
    return sliderOf(*describe(&object).find(key), &object);
}

// Every number of the struct is within its slider, and the slider within what the key may say.
template <typename S>
void checkSliders(const S& object) {
    for (const Key& key : describe(&object).keys()) {
        if (key.kind != Key::Kind::number && key.kind != Key::Kind::span) continue;
        const void* value = key.member.look(reinterpret_cast<const char*>(&object) + key.member.offset);
        const Slider slider = sliderOf(key, &object);
        INFO(key.name << ", " << slider.least << " to " << slider.most);
        CHECK(slider.least < slider.most);
        CHECK((std::isfinite(slider.least) && std::isfinite(slider.most)));
        CHECK(slider.most <= key.says.range.most);
        if (!key.unlessZero) CHECK(slider.least >= key.says.range.least);
        if (!value || key.kind != Key::Kind::number) continue;
        const double number = *static_cast<const double*>(value);
        if (std::isfinite(number)) CHECK((slider.least <= number && number <= slider.most));
    }
}

}  // namespace

TEST_CASE("what a file says is within its sliders", "[sliders]") {
    Emitter emitter;
    emitter.from = Emitter::From::disc;
    emitter.radius = 0.1;
    checkSliders(emitter);
    emitter.rate = 1e6;
    emitter.speed = {90, 100};
    emitter.position = {-5000, 3, 4000};
    emitter.radius = 1e-5;
    emitter.inherit = -7;
    checkSliders(emitter);
    CHECK(sliderFor("rate", emitter).most > 1e6);
    CHECK(sliderFor("rate", emitter).least == 0);
    CHECK(sliderFor("radius", emitter).least > 0);
    CHECK(sliderFor("position", emitter).least <= -5000);
    CHECK(sliderFor("speed", emitter).most > 100);
    CHECK(sliderFor("until", emitter).most < 1e6);
    CHECK(sliderFor("span", Lifecycle()).most < 1e6);

    ParticleType type;
    checkSliders(type);
    type.size = {1e-7, 50};
    type.spin = {-100, 3};
    type.turn = {0, 1e6};
    type.mass = 1e12;
    checkSliders(type);
    CHECK(sliderFor("size", type).least <= 1e-7);
    CHECK(sliderFor("spin", type).least <= -100);
    CHECK(sliderFor("turn", type).most == mostParticleTurn);
    checkSliders(School());
    checkSliders(Burst());
}

TEST_CASE("colour keyframes stay in order however they are dragged", "[sliders]") {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        std::vector<ColorKey> keys(1);
        for (int i = 0; i < 400; ++i) {
            const double dice = random.uniform();
            const size_t key = size_t(random.uniform() * double(keys.size()));
            if (dice < 0.1)
                addColorKey(keys);
            else if (dice < 0.15 && keys.size() > 1)
                keys.erase(keys.begin() + std::ptrdiff_t(key));
            else if (keys.size() > 1)
                keys[key].age = ageBetween(keys, key, random.uniform(-0.2, 1.2));
            REQUIRE(keys.size() <= mostColorKeys);
            for (size_t k = 0; k < keys.size(); ++k) {
                REQUIRE(keys[k].age >= 0);
                REQUIRE(keys[k].age <= 1);
                if (k > 0) REQUIRE(keys[k].age >= keys[k - 1].age + 0.0099);
            }
        }
    }
}

TEST_CASE("a new colour keyframe changes nothing that is seen", "[sliders]") {
    std::vector<ColorKey> keys(2);
    keys[0].color = {1, 0, 0};
    keys[1] = {0.8, {0, 1, 0}, 0};
    addColorKey(keys);
    REQUIRE(keys.size() == 3);
    CHECK(keys[1].age == Approx(0.4));
    CHECK(keys[1].color.x == Approx(0.5));
    CHECK(keys[1].opacity == Approx(0.5));
    std::vector<ColorKey> one(1);
    addColorKey(one);
    REQUIRE(one.size() == 2);
    CHECK(one[1].age == 1);
    CHECK(one[1].color == one[0].color);
}
