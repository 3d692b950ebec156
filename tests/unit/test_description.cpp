// Structs that are described once: read, checked and written by their description; and what is generated from
// descriptions: parts of the schema of scenes, and tables of docs/scene-format.md. SHOAL_UPDATE_SCHEMA=1
// writes these instead of comparing them.
#include <cstdlib>

#include "core/describe.h"
#include "core/file.h"
#include "molecule/molecule_json.h"
#include "scene/collider_kinds.h"
#include "scene/field_files/field_file.h"
#include "scene/field_kinds.h"
#include "scene/scene.h"
#include "support/catch.h"
#include "support/description_schema.h"
#include "support/message_of.h"

namespace shoal {

namespace {

enum class Colour { red, green };
struct Leg {
    double length = 1;
    Location location;
};
struct Box3 {
    glm::dvec3 size{1};
};
struct Ball {
    double radius = 2;
};
struct Thing {
    std::string name;
    int count = 3;
    bool old = false;
    Colour colour = Colour::red;
    glm::dvec2 span{1, 1};
    glm::dvec3 axis{0, 1, 0};
    std::optional<double> weight;
    double end = 0;
    std::vector<Leg> legs;
    std::variant<Box3, Ball> body;
};

const Description& describe(const Leg*) {
    static const Description it = Describe<Leg>("leg", "It stands on it.")
                                      .location(&Leg::location)
                                      .key("length", &Leg::length, {"m", "How long it is.", aboveZero()})
                                      .needed();
    return it;
}

const Description& describe(const Box3*) {
    static const Description it =
        Describe<Box3>("box", "A box.").key("size", &Box3::size, {"m", "Its size.", aboveZero()});
    return it;
}

const Description& describe(const Ball*) {
    static const Description it =
        Describe<Ball>("ball", "A ball.").key("radius", &Ball::radius, {"m", "Its radius.", aboveZero()});
    return it;
}

const Description& describe(const Thing*) {
    static const auto rule = [](const Thing& thing, const Where& where) {
        for (size_t i = 0; i < thing.legs.size(); ++i)
            if (thing.legs[i].length > thing.span.y)
                throw Error(where.in("legs", i).locate("length"), "a leg is longer than the span");
    };
    static const Description it =
        Describe<Thing>("thing", "A thing.")
            .key("name", &Thing::name, {"", "Its name."})
            .key("count", &Thing::count, {"", "How many there are.", Range::between(1, 5)})
            .key("old", &Thing::old, {"", "Whether it is old."})
            .word("colour", &Thing::colour, {"red", "green"}, {"", "Its colour."})
            .span("span", &Thing::span, {"m", "How far it reaches.", Range::atLeast(0)})
            .direction("axis", &Thing::axis, {"", "Where it points."})
            .key("weight", &Thing::weight, {"kg", "What it weighs.", aboveZero()})
            .key("end", &Thing::end, {"s", "When it ends; without it, never.", aboveZero()})
            .unlessZero()
            .alternatives("body", &Thing::body, {"", "What it is made of."})
            .key("legs", &Thing::legs, {"", "Its legs."})
            .rule(rule);
    return it;
}

Thing readThing(const std::string& text) {
    const JsonValue value = parseJson(text, "thing.json");
    JsonReader reader(value, "thing.json");
    Thing out;
    describe(&out).read(reader, out);
    reader.finish();
    return out;
}

template <typename S>
const Description* descriptionOf() {
    return &describe(static_cast<const S*>(nullptr));
}

}  // namespace

TEST_CASE("what is described is read, and written as it was read", "[description]") {
    const std::string text = R"({"name": "stool", "count": 4, "old": true, "colour": "green", "span": [1, 2],
        "axis": [0, 0, 1], "weight": 5, "end": 3, "body": "ball", "radius": 0.5,
        "legs": [{"length": 1}, {"length": 2}]})";
    const Thing thing = readThing(text);
    CHECK(thing.name == "stool");
    CHECK(thing.colour == Colour::green);
    CHECK(thing.span == glm::dvec2(1, 2));
    CHECK(thing.weight == 5);
    REQUIRE(thing.legs.size() == 2);
    CHECK(thing.legs[1].length == 2);
    CHECK(thing.legs[1].location.line == 3);
    CHECK(std::get<Ball>(thing.body).radius == 0.5);
    CHECK(writeJsonLine(describe(&thing).write(thing)) == writeJsonLine(parseJson(text, "again")));
    CHECK(writeJsonLine(describe(&thing).write(Thing())) == R"({"body": "box"})");
}

TEST_CASE("what is described wrong is located by its key", "[description]") {
    const auto message = [](const std::string& text) { return messageOf([&] { readThing(text); }); };
    CHECK_THAT(message(R"({"body": "ball", "count": 6})"),
               Catch::Contains("expected a whole number from 1 to 5, found 6 (at $.count)"));
    CHECK_THAT(message(R"({"body": "bal"})"), Catch::Contains("did you mean \"ball\"?"));
    CHECK_THAT(message(R"({"count": 2})"), Catch::Contains("missing key \"body\""));
    CHECK_THAT(message(R"({"body": "box", "radius": 1})"), Catch::Contains("unknown key \"radius\""));
    CHECK_THAT(message(R"({"body": "box", "end": 0})"), Catch::Contains("(at $.end)"));
    CHECK_THAT(message(R"({"body": "box", "axis": [0, 0, 0]})"), Catch::Contains("(at $.axis)"));
    CHECK_THAT(message(R"({"body": "box", "legs": [{"lenght": 1}]})"),
               Catch::Contains("did you mean \"length\"?"));
    CHECK_THAT(message("{\"body\": \"box\",\n \"legs\": [{\"length\": 1}, {\"length\": 2}]}"),
               Catch::Contains("thing.json:2:37: a leg is longer than the span (at $.legs[1].length)"));
}

TEST_CASE("what is made in code is held to the same", "[description]") {
    const auto message = [](const Thing& thing) {
        return messageOf([&] { describe(&thing).check(thing, Where(), 1e15); });
    };
    Thing thing;
    CHECK(message(thing).empty());
    thing.count = 0;
    CHECK_THAT(message(thing), Catch::Contains("from 1 to 5, found 0 (at $.count)"));
    thing = Thing();
    thing.weight = -1;
    CHECK_THAT(message(thing), Catch::Contains("(at $.weight)"));
    thing = Thing();
    thing.body = Ball{0};
    CHECK_THAT(message(thing), Catch::Contains("(at $.radius)"));
    thing = Thing();
    thing.legs = {{0.5, {}}, {2, {}}};
    CHECK_THAT(message(thing), Catch::Contains("(at $.legs[1].length)"));
    thing.legs[1].length = 0;
    CHECK_THAT(message(thing), Catch::Contains("(at $.legs[1].length)"));
    thing = Thing();
    thing.end = 1e16;
    CHECK_THAT(message(thing), Catch::Contains("within 1e+15 of 0"));
}

TEST_CASE("the schemas say what the descriptions say", "[description]") {
    const auto compare = [](const std::string& folder, const std::string& name,
                            const Description& description, const std::string& title) {
        const std::string file = SHOAL_SOURCE_DIR "/" + folder + "/" + name;
        const std::string schema = test::schemaFile(description, name, title);
        if (std::getenv("SHOAL_UPDATE_SCHEMA")) return writeFile(file, schema);
        INFO(name);
        CHECK((schema == readFile(file)));
    };
    compare("models", "scene.schema.json", *descriptionOf<Scene>(), "Shoal scene");
    compare("models", "field.schema.json", *descriptionOf<RawLayout>(),
            "Shoal layout of a .raw vector field");
    compare("molecules", "molecule.schema.json", *descriptionOf<Molecule>(), "Shoal molecule");
}

using Tables = std::vector<std::pair<std::string, const Description*>>;

// Puts a part between its mark and the next end.
static void put(std::string& text, const std::string& mark, const std::string& part) {
    INFO(mark);
    const std::string head = "<!-- " + mark + " -->\n";
    const size_t begin = text.find(head), end = text.find("<!-- end -->", begin);
    REQUIRE((begin != std::string::npos && end != std::string::npos));
    text.replace(begin + head.size(), end - begin - head.size(), part);
}

static void compareTables(const std::string& name, const Tables& tables, const Tables& kinds = {}) {
    const std::string file = SHOAL_SOURCE_DIR "/docs/" + name, committed = readFile(file);
    std::string text = committed;
    for (const auto& [object, description] : tables)
        put(text, "keys: " + object, test::tableOf(*description));
    for (const auto& [object, description] : kinds)
        put(text, "kinds: " + object, test::kindsOf(*description));
    if (std::getenv("SHOAL_UPDATE_SCHEMA")) return writeFile(file, text);
    CHECK((text == committed));
}

TEST_CASE("the tables of the formats say what the descriptions say", "[description]") {
    const Tables tables = {{"scene", descriptionOf<Scene>()},
                           {"solver", descriptionOf<SolverSettings>()},
                           {"contact", descriptionOf<ContactSettings>()},
                           {"camera", descriptionOf<Camera>()},
                           {"light", descriptionOf<Light>()},
                           {"sky", descriptionOf<Sky>()},
                           {"model", descriptionOf<Model>()},
                           {"group", descriptionOf<Group>()},
                           {"particle", descriptionOf<ParticleType>()},
                           {"color", descriptionOf<ColorKey>()},
                           {"image", descriptionOf<ParticleImage>()},
                           {"life", descriptionOf<Lifecycle>()},
                           {"dies", descriptionOf<Lifecycle>()->find("dies")->objects[0]},
                           {"emitter", descriptionOf<Emitter>()},
                           {"burst", descriptionOf<Burst>()},
                           {"colorBy", descriptionOf<ColorScale>()},
                           {"groupContact", descriptionOf<GroupContact>()},
                           {"release", descriptionOf<Release>()},
                           {"place", descriptionOf<Placement>()},
                           {"item", descriptionOf<Placement::Item>()},
                           {"select", descriptionOf<Selection>()},
                           {"field", descriptionOf<Field>()},
                           {"grid", descriptionOf<GridField>()},
                           {"sequence", descriptionOf<FileSequence>()},
                           {"waves", descriptionOf<WavesField>()},
                           {"train", descriptionOf<WaveTrain>()},
                           {"hurricane", descriptionOf<HurricaneField>()},
                           {"force", descriptionOf<Force>()},
                           {"collider", descriptionOf<Collider>()},
                           {"heightField", descriptionOf<HeightFieldCollider>()},
                           {"distanceField", descriptionOf<DistanceFieldCollider>()},
                           {"path", descriptionOf<ColliderPath>()},
                           {"keyframe", descriptionOf<ColliderPath::Keyframe>()},
                           {"surfacePair", descriptionOf<SurfaceRule>()},
                           {"school", descriptionOf<School>()},
                           {"water", descriptionOf<Water>()}};
    compareTables("scene-format.md", tables,
                  {{"field", descriptionOf<Field>()},
                   {"force", descriptionOf<Force>()},
                   {"collider", descriptionOf<Collider>()}});
    compareTables("exchange.md", {{"layout", descriptionOf<RawLayout>()}});
    compareTables("molecule-format.md", {{"molecule", descriptionOf<Molecule>()},
                                         {"defaults", &describeDefaults()},
                                         {"vertex", descriptionOf<Vertex>()},
                                         {"spring", descriptionOf<Spring>()},
                                         {"bend", descriptionOf<Bend>()},
                                         {"actuation", descriptionOf<Actuation>()},
                                         {"material", descriptionOf<Material>()},
                                         {"skin", &describeSkin()}});
}

TEST_CASE("tables of keys say type, default and meaning", "[description]") {
    const std::string table = test::tableOf(describe(static_cast<const Thing*>(nullptr)));
    INFO(table);
    CHECK_THAT(table, Catch::Contains("| `count` | whole number from 1 to 5 | 3 | How many there are. |"));
    CHECK_THAT(table, Catch::Contains("| `weight` | number above 0, kg | none | What it weighs. |"));
    CHECK_THAT(table, Catch::Contains("| `body` | `\"box\"`, `\"ball\"` | required |"));
}

}  // namespace shoal
