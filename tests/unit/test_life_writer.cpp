// Birth and death read back as they were written, and saving changes what was edited and no more.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <unistd.h>

#include "core/file.h"
#include "core/random.h"
#include "scene/json/saver.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/replaced.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;
using From = Emitter::From;

namespace {

void saveEdits(const Scene& before, const Scene& after) {
    writeFile(before.file, withEdits(readFile(before.file), before, after));
}

constexpr const char* sparks = R"({
  "format": "shoal-scene-1",
  "comment": "kept",
  "seed":  18446744073709551615,
  "gravity": [0, -9.810, 0],
  "models": [{"name": "hill", "file": "hill.obj"}],
  "groups": [
    {"name": "sparks", "molecule": "blade.json",
      "emitters": [
        {"comment": "the tip", "speed": [4, 6.0], "from": "point", "position": [0, 1e0, 0],
         "direction": [0, 0, 7], "rate": 100, "random": false}
      ],
      "drag":   0.10,
      "life": {"span": [1, 2]}},
    {"name": "smoke", "molecule": "blade.json", "life": {"capacity": 500, "span": 3},
     "emitters": [{"from": "death", "of": "sparks", "count": 2}]}
  ]
}
)";

std::string scratchScene(const Scratch& scratch, const std::string& text = sparks) {
    return writeSmallScene(scratch, text);
}

class Anything {
  public:
    explicit Anything(uint64_t seed) : random_(seed, 3) {}

    bool chance(double share = 0.5) { return random_.uniform() < share; }
    double number(double least, double most) { return least + (most - least) * random_.uniform(); }
    int whole(int least, int most) { return least + int(random_.uniform() * (most - least + 1)); }
    glm::dvec3 place() { return {number(-5, 5), chance() ? 0 : number(-5, 5), number(-5, 5)}; }
    glm::dvec2 span(double least, double most) {
        const double a = number(least, most), b = number(least, most);
        return chance() ? glm::dvec2(a) : glm::dvec2(std::min(a, b), std::max(a, b));
    }
    Box box() {
        const glm::dvec3 low = place();
        return {low, low + glm::dvec3(number(0.1, 2), number(0.1, 2), number(0.1, 2))};
    }
    ColliderPath path() {
        ColliderPath out;
        out.smooth = chance();
        for (int i = 0; i < whole(2, 4); ++i)
            out.keyframes.push_back({number(i, i + 0.5), {place(), {1, 0, 0, 0}}});
        if (chance()) out.keyframes[1].pose.rotation = glm::angleAxis(number(0, 2), random_.direction());
        out.repeats = chance();
        if (out.repeats) out.keyframes.push_back({9, out.keyframes.front().pose});
        return out;
    }
    Emitter emitter(bool gpu) {
        Emitter out;
        if (chance()) out.name = concat("nozzle \"", whole(1, 99), "\"");
        out.from = From(whole(0, gpu ? 6 : 5));
        const bool moves = out.from != From::surface && out.from != From::death;
        place(out);
        if (out.from == From::death)
            out.perDeath = whole(1, 9);
        else
            when(out);
        const bool sides = out.from != From::line && out.from != From::box;
        if (sides && chance()) out.along = Emitter::Along::outward;
        if (chance()) out.direction = random_.direction();
        if (chance()) out.spread = number(0, 3.14);
        if (chance()) out.speed = span(0, 9);
        if (moves && chance()) out.path = path();
        if ((out.path || out.from == From::death) && chance()) out.inherit = number(-1, 1);
        return out;
    }
    Lifecycle life() {
        Lifecycle out;
        out.allocator = Allocator(whole(0, 3));
        const int count = whole(1, 4);
        for (int i = 0; i < count; ++i)
            out.emitters.push_back(emitter(out.allocator == Allocator::gpu));
        if (chance(0.8)) out.life = span(0.1, 9);
        if (chance()) out.within = box();
        if (chance()) out.afterContact = number(0, 2);
        if (chance()) out.scale = span(0.1, 3);
        out.turn = Placement::Turn(whole(0, 2));
        if (chance()) out.grow = number(0, 1);
        if (chance()) out.shrink = number(0, 1);
        if (chance()) out.spin = glm::abs(place());
        const std::optional<int> usual = usualCapacity(0, out);
        out.capacity = usual && chance() ? *usual : whole(1, 5000);
        return out;
    }

  private:
    void place(Emitter& out) {
        if (out.from == From::point || out.from == From::disc || out.from == From::sphere)
            out.position = place();
        if (out.from == From::line) out.lineFrom = place(), out.lineTo = place();
        if (out.from == From::disc || out.from == From::sphere) {
            out.radius = number(0.1, 2);
            if (chance()) out.hollow = number(0, 1);
        }
        if (out.from == From::box) out.box = box();
        if (out.from == From::surface) {
            out.model = 0;
            if (chance()) out.select.object = "post";
            if (chance()) out.select.minHeight = number(-1, 0);
        }
        if (out.from == From::death) out.group = "sparks";
    }
    void when(Emitter& out) {
        if (chance(0.8)) out.rate = number(0, 500);
        out.random = chance();
        if (chance()) out.begin = number(0, 2);
        if (chance()) out.end = out.begin + number(0.1, 5);
        if (!chance()) return;
        for (int i = 0; i < whole(1, 3); ++i)
            out.bursts.push_back({chance() ? 0 : number(0, 4), whole(1, 40), chance() ? 0 : number(1, 3)});
    }

    Random random_;
};

bool near(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(a - b) < 1e-14;  // a direction that is normalised once more
}

bool same(const Box& a, const Box& b) {
    return a.low == b.low && a.high == b.high;
}

bool same(const std::optional<ColliderPath>& a, const std::optional<ColliderPath>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    const auto equal = [](const ColliderPath::Keyframe& x, const ColliderPath::Keyframe& y) {
        return x.time == y.time && x.pose.position == y.pose.position &&
               std::abs(glm::dot(x.pose.rotation, y.pose.rotation)) > 1 - 1e-14;
    };
    return a->repeats == b->repeats && a->smooth == b->smooth &&
           std::equal(a->keyframes.begin(), a->keyframes.end(), b->keyframes.begin(), b->keyframes.end(),
                      equal);
}

bool same(const Emitter& a, const Emitter& b) {
    const bool bursts = std::equal(a.bursts.begin(), a.bursts.end(), b.bursts.begin(), b.bursts.end(),
                                   [](const Burst& x, const Burst& y) {
                                       return x.time == y.time && x.count == y.count && x.every == y.every;
                                   });
    return a.name == b.name && a.from == b.from && a.position == b.position && a.lineFrom == b.lineFrom &&
           a.lineTo == b.lineTo && a.radius == b.radius && a.hollow == b.hollow &&
           (a.from != From::box || same(a.box, b.box)) && a.model == b.model && a.select == b.select &&
           a.group == b.group && a.rate == b.rate && a.random == b.random && a.begin == b.begin &&
           a.end == b.end && bursts && a.perDeath == b.perDeath && a.along == b.along &&
           near(a.direction, b.direction) && a.spread == b.spread && a.speed == b.speed &&
           a.inherit == b.inherit && same(a.path, b.path);
}

bool same(const Lifecycle& a, const Lifecycle& b) {
    const bool within =
        a.within.has_value() == b.within.has_value() && (!a.within || same(*a.within, *b.within));
    return a.capacity == b.capacity && a.allocator == b.allocator && a.life == b.life && within &&
           a.afterContact == b.afterContact && a.scale == b.scale && a.turn == b.turn && a.grow == b.grow &&
           a.shrink == b.shrink && a.spin == b.spin &&
           std::equal(a.emitters.begin(), a.emitters.end(), b.emitters.begin(), b.emitters.end(),
                      [](const Emitter& x, const Emitter& y) { return same(x, y); });
}

}  // namespace

TEST_CASE("any birth and death reads back as it was written", "[lifeWriter]") {
    const Scratch scratch;
    const std::string file = scratchScene(scratch);
    const Scene scene = readScene(file);
    int kinds[7] = {};
    for (int i = 0; i < 300; ++i) {
        Anything anything(static_cast<uint64_t>(i));
        Scene edited = scene;
        Lifecycle& life = edited.groups[1].life.emplace(anything.life());
        for (const Emitter& emitter : life.emitters)
            ++kinds[size_t(emitter.from)];
        const std::string text = withEdits(sparks, scene, edited);
        INFO(text);
        const Scene again = parseScene(text, file);
        REQUIRE(same(*again.groups[1].life, life));
        CHECK(same(*again.groups[0].life, *scene.groups[0].life));
    }
    CHECK(*std::min_element(std::begin(kinds), std::end(kinds)) > 20);
}

TEST_CASE("saving changes the number that was edited and no other byte", "[lifeWriter]") {
    const Scratch scratch;
    const std::string file = scratchScene(scratch);
    const Scene before = readScene(file);
    Scene after = before;
    CHECK(!differ(before, after));
    saveEdits(before, after);
    CHECK(readFile(file) == sparks);

    after.groups[0].life->emitters[0].spread = 0.25;
    after.groups[1].life->life = {2, 4};
    CHECK(differ(before, after));
    saveEdits(before, after);
    std::string expected =
        replaced(sparks, R"("direction": [0, 0, 7])", R"("direction": [0, 0, 7], "spread": 0.25)");
    CHECK(readFile(file) == replaced(expected, R"("span": 3)", R"("span": [2, 4])"));

    saveEdits(after, before);  // and back
    CHECK(readFile(file) == sparks);
}

TEST_CASE("a group whose last emitter is taken away still reads", "[lifeWriter]") {
    const Scratch scratch;
    const std::string file = scratchScene(scratch);
    const Scene before = readScene(file);
    Scene after = before;
    after.groups[1].life->emitters.clear();
    saveEdits(before, after);
    const Scene again = readScene(file);
    CHECK(same(*again.groups[1].life, *after.groups[1].life));
    after.groups[0].life->emitters.clear();
    after.groups[0].life->life = glm::dvec2(longestLife);
    saveEdits(again, after);
    CHECK(same(*readScene(file).groups[0].life, *after.groups[0].life));
}

TEST_CASE("looks are saved where they were edited", "[lifeWriter]") {
    const Scratch scratch;
    const std::string text = R"({
  "format": "shoal-scene-1",
  "groups": [
    {"particle": {"comment": "dust", "size": [0.010, 0.02], "blend": "alpha",
                  "colors": [{"color": [1.0, 1, 1]}, {"age": 1, "opacity": 0.0, "comment": "gone"}]},
     "name": "dust", "count": 3, "life": {"span": 2},
     "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}
  ]
})";
    const std::string file = scratchScene(scratch, text);
    const Scene before = readScene(file);
    Scene after = before;
    ParticleType& type = *after.groups[0].particle;
    type.size.y = 0.03;
    type.colors.insert(type.colors.begin() + 1, {0.5, {2, 0, 0}, 0.75});
    type.softness = 0.25;
    saveEdits(before, after);
    std::string expected = replaced(text, "[0.010, 0.02]", "[0.01, 0.03]");
    expected = replaced(expected, R"({"color": [1.0, 1, 1]}, )",
                        R"({"color": [1.0, 1, 1]}, {"age": 0.5, "color": [2, 0, 0], "opacity": 0.75}, )");
    expected = replaced(expected, R"("comment": "gone"}])", R"("comment": "gone"}], "softness": 0.25)");
    CHECK(readFile(file) == expected);
    CHECK(!differ(readScene(file), after));
    saveEdits(after, before);
    CHECK(!differ(readScene(file), before));

    after.groups[0].particle->growth = glm::dvec2(0);
    CHECK_THAT(messageOf([&] { saveEdits(before, after); }), Catch::Contains("$.groups[0].particle.growth"));
    CHECK(!differ(readScene(file), before));
}

TEST_CASE("editing a shipped scene changes a few lines of it", "[lifeWriter]") {
    for (const char* name : {"fountain/fountain", "fire/fire", "bees/bees", "winter/snowfall"}) {
        const std::string file = concat(SHOAL_SOURCE_DIR "/models/", name, ".scene.json");
        INFO(file);
        const std::string text = readFile(file);
        const Scene before = parseScene(text, file);
        CHECK(withEdits(text, before, before) == text);
        Scene after = before;
        size_t edited = 0;
        for (Group& group : after.groups) {
            if (group.particle) group.particle->mass *= 2, ++edited;
            if (!group.life || group.life->emitters.empty()) continue;
            group.life->emitters[0].spread = 0.125;
            ++edited;
        }
        REQUIRE(edited > 0);
        const std::string saved = withEdits(text, before, after);
        CHECK(saved.size() < text.size() + 40 * edited);
        const Scene again = parseScene(saved, file);
        CHECK(!differ(again, after));
    }
}

TEST_CASE("a capacity that followed the rate is written when it no longer does", "[lifeWriter]") {
    const Scratch scratch;
    const std::string file = scratchScene(scratch);
    const Scene before = readScene(file);
    REQUIRE(before.groups[0].life->capacity == 210);
    Scene after = before;
    after.groups[0].life->emitters[0].rate = 50;
    saveEdits(before, after);
    CHECK(readScene(file).groups[0].life->capacity == 210);
    CHECK_THAT(readFile(file), Catch::Contains(R"("life": {"span": [1, 2], "capacity": 210})"));
}

TEST_CASE("what others changed in the file meanwhile stays", "[lifeWriter]") {
    const Scratch scratch;
    const std::string file = scratchScene(scratch);
    const Scene before = readScene(file);
    Scene after = before;
    after.groups[0].life->emitters[0].rate = 50;
    after.groups[0].life->capacity = 105;
    const std::string theirs =
        replaced(sparks, R"("comment": "the tip")", R"("comment": "theirs", "spread": 1)");
    scratch.write("all.scene.json", theirs);
    saveEdits(before, after);
    CHECK(readFile(file) == replaced(theirs, "\"rate\": 100", "\"rate\": 50"));

    const std::string other = replaced(sparks, "\"name\": \"smoke\"", "\"name\": \"steam\"");
    scratch.write("all.scene.json", other);
    CHECK_THAT(messageOf([&] { saveEdits(before, after); }), Catch::Contains("is not the group \"smoke\""));
    CHECK(readFile(file) == other);
    scratch.write("all.scene.json", "{\"groups\": []}");
    CHECK_THAT(messageOf([&] { saveEdits(before, after); }), Catch::Contains("has other groups"));
    scratch.write("all.scene.json", "{\"groups\": [");
    CHECK_THAT(messageOf([&] { saveEdits(before, after); }), Catch::Contains("expected"));
    CHECK(readFile(file) == "{\"groups\": [");
}

TEST_CASE("what would not read back is not saved", "[lifeWriter]") {
    const Scratch scratch;
    const std::string file = scratchScene(scratch);
    const Scene before = readScene(file);
    Scene after = before;
    after.groups[0].life->life = {2, 1};
    CHECK_THAT(messageOf([&] { saveEdits(before, after); }), Catch::Contains("$.groups[0].life.span"));
    after = before;
    after.groups[0].life->emitters[0].rate = std::nan("");
    CHECK_THAT(messageOf([&] { saveEdits(before, after); }), Catch::Contains("rate"));
    CHECK(readFile(file) == sparks);
}

TEST_CASE("where nothing can be written the old file is kept and one error says so", "[lifeWriter]") {
    const Scratch scratch;
    const std::string file = scratchScene(scratch);
    const Scene before = readScene(file);
    Scene after = before;
    after.groups[0].life->emitters[0].rate = 50;
    namespace fs = std::filesystem;
    const std::string link = scratch.path("link.scene.json");
    fs::create_symlink(file, link);
    Scene linked = before;
    linked.file = link;
    saveEdits(linked, after);  // through the link
    CHECK(fs::is_symlink(link));
    CHECK(readScene(file).groups[0].life->emitters[0].rate == 50);
    saveEdits(after, before);

    if (::geteuid() != 0) {  // who may do anything is refused nothing
        fs::permissions(scratch.folder(), fs::perms::owner_read | fs::perms::owner_exec);
        const std::string message = messageOf([&] { saveEdits(before, after); });
        fs::permissions(scratch.folder(), fs::perms::owner_all);
        CHECK_THAT(message, Catch::Contains(file) && Catch::Contains("cannot be written"));
    }
    // in the way of the file beside it
    fs::create_directory(scratch / concat(".shoal-", ::getpid(), "-", fs::path(file).filename().string()));
    CHECK_THAT(messageOf([&] { saveEdits(before, after); }),
               Catch::Contains(file) && Catch::Contains("cannot be written"));
    CHECK(readFile(file) == sparks);
    CHECK_THAT(messageOf([&] {
                   Scene gone = before;
                   gone.file = scratch.path("gone.scene.json");
                   saveEdits(gone, after);
               }),
               Catch::Contains("no such file"));
}
