// "life" and "emitters": read, and refused with the place of what is wrong.
#include "compile/plan.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

// A scene of one group of points, "drops", and what else is given.
class Drops {
  public:
    Scene scene(const std::string& keys, const std::string& otherGroups = "") const {
        return parseScene(R"({"format": "shoal-scene-1", "models": [{"name": "hill", "file": "hill.obj"}],
"groups": [{"name": "drops", "particle": {}, )" +
                              keys + "}" + otherGroups + "]}",
                          scratch_.path("s.json"));
    }
    Lifecycle life(const std::string& keys) const { return *scene(keys).groups.at(0).life; }
    Emitter emitter(const std::string& keys) const {
        return life(R"("life": {"capacity": 10}, "emitters": [{)" + keys + "}]").emitters.at(0);
    }
    std::string error(const std::string& keys, const std::string& otherGroups = "") const {
        return messageOf([&] { scene(keys, otherGroups); });
    }
    std::string emitterError(const std::string& keys) const {
        return error(R"("life": {"capacity": 10}, "emitters": [{)" + keys + "}]");
    }

    Drops() { scratch_.write("hill.obj", "o ground\nv 0 0 0\nv 1 0 0\nv 0 0 -1\nf 1 2 3\n"); }

  private:
    Scratch scratch_;
};

}  // namespace

TEST_CASE("life and emitters keep what their file says", "[life]") {
    const Drops drops;
    const Lifecycle life = drops.life(
        R"("life": {"span": [1, 2], "capacity": 500, "allocator": "heap",
            "dies": {"outside": {"low": [-1, -1, -1], "high": [1, 1, 1]}, "afterContact": 0.5}},
           "emitters": [
             {"name": "one", "from": "disc", "position": [1, 2, 3], "radius": 2, "hollow": 0.25, "rate": 30,
              "random": true, "begin": 1, "until": 4, "direction": [0, 0, 5], "spread": 0.5, "speed": [1, 3],
              "inherit": 0.75, "path": {"keyframes": [{"time": 0}, {"time": 1, "position": [1, 0, 0]}]}},
             {"from": "surface", "model": "hill", "bursts": [{"time": 0.5, "count": 7}, {"count": 2, "every": 0.1}]},
             {"from": "line", "start": [0, 0, 0], "end": [1, 1, 1], "rate": 1}])");
    CHECK(life.life == glm::dvec2(1, 2));
    CHECK(life.capacity == 500);
    CHECK(life.allocator == Allocator::heap);
    CHECK(life.within->low == glm::dvec3(-1));
    CHECK(*life.afterContact == 0.5);
    REQUIRE(life.emitters.size() == 3);
    const Emitter& one = life.emitters[0];
    CHECK(one.name == "one");
    CHECK(one.from == Emitter::From::disc);
    CHECK(one.radius == 2);
    CHECK(one.hollow == 0.25);
    CHECK(one.rate == 30);
    CHECK(one.random);
    CHECK(one.begin == 1);
    CHECK(one.end == 4);
    CHECK(one.direction == glm::dvec3(0, 0, 1));
    CHECK(one.along == Emitter::Along::direction);
    CHECK(one.spread == 0.5);
    CHECK(one.speed == glm::dvec2(1, 3));
    CHECK(one.inherit == 0.75);
    CHECK(one.path->keyframes.size() == 2);
    CHECK(life.emitters[1].along == Emitter::Along::outward);
    CHECK(life.emitters[1].bursts.at(1).every == 0.1);
    CHECK(life.emitters[2].lineTo == glm::dvec3(1));
}

TEST_CASE("a capacity is what rates and spans keep alive, and a twentieth more", "[life]") {
    const Drops drops;
    const auto capacity = [&](const std::string& keys) { return drops.life(keys).capacity; };
    CHECK(capacity(R"("life": {"span": [1, 2]}, "emitters": [{"from": "point", "rate": 100}])") == 210);
    CHECK(capacity(R"("life": {"span": 3}, "emitters": [{"from": "point", "rate": 100, "until": 1}])") ==
          105);
    CHECK(capacity(R"("life": {"span": 1}, "emitters": [{"from": "point", "bursts": [{"count": 40}]}])") ==
          42);
    CHECK(
        capacity(
            R"("life": {"span": 1}, "emitters": [{"from": "point", "bursts": [{"count": 40, "every": 0.4}]}])") ==
        126);
    CHECK(drops
              .life(R"("place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}, "count": 9,
                        "life": {"span": 1})")
              .capacity == 9);
}

TEST_CASE("places that would never come back are warned of", "[life]") {
    const Drops drops;
    const auto warnings = [&](const std::string& life) {
        return compile(drops.scene(R"("life": {"capacity": 9, )" + life +
                                   R"(}, "emitters": [{"from": "point", "rate": 5}])"))
            .warnings.size();
    };
    CHECK(warnings(R"("allocator": "heap", "dies": {"afterContact": 1})") == 1);
    CHECK(warnings(R"("allocator": "heap", "span": 2, "dies": {"afterContact": 1})") == 0);
    CHECK(warnings(R"("allocator": "gpu", "dies": {"afterContact": 1})") == 0);
    CHECK(warnings(R"("allocator": "stack")") == 0);
}

TEST_CASE("what makes no sense of a life is refused where it stands", "[life]") {
    const Drops drops;
    const std::string point = R"("emitters": [{"from": "point", "rate": 5}])";
    CHECK_THAT(drops.error(R"("life": {"span": 0}, )" + point), Contains("$.groups[0].life.span"));
    CHECK_THAT(drops.error(R"("life": {"span": -1}, )" + point), Contains("$.groups[0].life.span"));
    CHECK_THAT(drops.error(R"("life": {"span": [3, 2]}, )" + point), Contains("[least, most]"));
    CHECK_THAT(drops.error(R"("life": {"span": NaN}, )" + point), Contains("s.json:"));
    CHECK_THAT(drops.error(R"("life": {"span": 1e999}, )" + point), Contains("s.json:"));
    CHECK_THAT(drops.error(R"("life": {"capacity": 0}, )" + point), Contains("life.capacity"));
    CHECK_THAT(drops.error(R"("life": {"capacity": 2000000000}, )" + point), Contains("life.capacity"));
    CHECK_THAT(drops.error(R"("life": {"allocator": "gpus"}, )" + point), Contains("\"gpu\""));
    CHECK_THAT(drops.error(R"("life": {"capacty": 5}, )" + point), Contains("capacity"));
    CHECK_THAT(drops.error(point), Contains("expected a \"capacity\""));
    CHECK_THAT(drops.error(R"("life": {"span": 1e9}, "emitters": [{"from": "point", "rate": 5e5}])"),
               Contains("expected a \"capacity\""));
    CHECK_THAT(drops.error(R"("life": {"span": 1, "dies": {}}, )" + point), Contains("afterContact"));
    CHECK_THAT(drops.error(R"("life": {"span": 1, "dies": {"afterContact": -1}}, )" + point),
               Contains("afterContact"));
    CHECK_THAT(drops.error(R"("life": {"span": 1, "scale": 2}, )" + point), Contains("scale"));
    CHECK_THAT(drops.error(R"("life": {"span": 1})"), Contains("place"));
    CHECK_THAT(drops.error(R"("count": 3, "life": {"span": 1}, )" + point), Contains("\"place\""));
    CHECK_THAT(
        drops.error(R"("place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}, "count": 9,
                              "life": {"span": 1, "capacity": 5}, )" +
                    point),
        Contains("at least the count at the start"));
    CHECK_THAT(
        drops.error(R"("place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}, "count": 9,
                              "life": {"span": 1, "allocator": "heap"})"),
        Contains("nothing is born here"));
}

TEST_CASE("what makes no sense of an emitter is refused where it stands", "[life]") {
    const Drops drops;
    const auto error = [&](const std::string& keys) { return drops.emitterError(keys); };
    CHECK_THAT(error(R"("rate": 5)"), Contains("from"));
    CHECK_THAT(error(R"("from": "sphear", "rate": 5)"), Contains("\"sphere\""));
    CHECK_THAT(error(R"("from": "point", "rate": -5)"), Contains("$.groups[0].emitters[0].rate"));
    CHECK_THAT(error(R"("from": "point")"), Contains("\"rate\" or \"bursts\""));
    CHECK_THAT(error(R"("from": "point", "rate": 1, "radius": 2)"), Contains("radius"));
    CHECK_THAT(error(R"("from": "disc", "rate": 1)"), Contains("radius"));
    CHECK_THAT(error(R"("from": "disc", "radius": 1, "hollow": 1.5, "rate": 1)"), Contains("hollow"));
    CHECK_THAT(error(R"("from": "line", "start": [0, 0, 0], "rate": 1)"), Contains("end"));
    CHECK_THAT(error(R"("from": "box", "rate": 1)"), Contains("box"));
    CHECK_THAT(error(R"("from": "surface", "model": "hil", "rate": 1)"), Contains("\"hill\""));
    CHECK_THAT(error(R"("from": "surface", "model": "hill", "select": {"minHeight": 5}, "rate": 1)"),
               Contains("nothing of model"));
    CHECK_THAT(error(R"("from": "death", "of": "nobody")"), Contains("nobody"));
    CHECK_THAT(error(R"("from": "death", "of": "drops")"), Contains("circle"));
    CHECK_THAT(error(R"("from": "death", "of": "drops", "rate": 5)"), Contains("rate"));
    CHECK_THAT(error(R"("from": "point", "rate": 1, "begin": 5, "until": 5)"), Contains("until"));
    CHECK_THAT(error(R"("from": "point", "bursts": [{"time": 1}])"), Contains("bursts[0]"));
    CHECK_THAT(error(R"("from": "point", "bursts": [{"count": 0}])"), Contains("count"));
    CHECK_THAT(error(R"("from": "point", "bursts": [{"count": 1, "every": 0}])"), Contains("every"));
    CHECK_THAT(error(R"("from": "point", "rate": 1, "direction": [0, 0, 0])"), Contains("direction"));
    CHECK_THAT(error(R"("from": "point", "rate": 1, "spread": 4)"), Contains("spread"));
    CHECK_THAT(error(R"("from": "point", "rate": 1, "speed": [2, 1])"), Contains("[least, most]"));
    CHECK_THAT(error(R"("from": "point", "rate": 1, "speed": -1)"), Contains("speed"));
    CHECK_THAT(error(R"("from": "point", "rate": 1, "inherit": 1)"), Contains("nothing to inherit"));
    CHECK_THAT(
        error(R"("from": "line", "start": [0, 0, 0], "end": [1, 0, 0], "rate": 1, "along": "outward")"),
        Contains("outward"));
    CHECK_THAT(error(R"("from": "surface", "model": "hill", "rate": 1,
                        "path": {"keyframes": [{"time": 0}, {"time": 1}]})"),
               Contains("\"path\" needs \"from\": \"point\" or"));
}

TEST_CASE("deaths that emit in a circle, of the immortal, or into a book on the CPU are refused", "[life]") {
    const Drops drops;
    const std::string own = R"("life": {"span": 1, "capacity": 10}, "emitters": [{"from": "death", "of": ")";
    CHECK_THAT(drops.error(own + R"(mist"}])", R"(, {"name": "mist", "particle": {},
        "life": {"span": 1, "capacity": 10}, "emitters": [{"from": "death", "of": "drops"}]})"),
               Contains("circle"));
    CHECK_THAT(drops.error(own + R"(mist"}])", R"(, {"name": "mist", "particle": {}, "count": 2,
        "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}})"),
               Contains("ever dies"));
    CHECK_THAT(drops.error(R"("life": {"span": 1, "capacity": 10, "allocator": "ring"},
        "emitters": [{"from": "death", "of": "mist"}])",
                           R"(, {"name": "mist", "particle": {}, "life": {"span": 1},
        "emitters": [{"from": "point", "rate": 1}]})"),
               Contains("only the allocator \"gpu\""));
}
