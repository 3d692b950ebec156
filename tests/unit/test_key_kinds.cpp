// Kinds of keys, each on its own: the least that a file may say is read, checked and written; what tables,
// schemas and the window are told. One of them is made here, and nothing else has to know it.
#include <algorithm>
#include <set>

#include "core/describe.h"
#include "core/kinds/parts.h"
#include "core/smallest.h"
#include "scene/field_files/field_file.h"
#include "scene/scene.h"
#include "support/catch.h"
#include "support/description_schema.h"
#include "support/message_of.h"

namespace shoal {

namespace {

using Kind = Key::Kind;

enum class Lamp { off, dim };
struct Disc {
    double radius = 2;
};
struct Tile {
    double side = 3;
};
// A member of each kind. What it holds is never the least that a file may say.
struct Every {
    double number = 5;
    int whole = 5;
    glm::ivec3 whole3{5};
    uint32_t seed = 5;
    uint64_t longSeed = 5;
    bool flag = false;
    Lamp word = Lamp::dim;
    std::string text;
    std::vector<std::string> texts = {"one"};
    glm::dvec2 vector2{5}, span{5}, ends{5};
    glm::dvec3 vector3{5}, direction{1, 0, 0}, color{5};
    Box box{glm::dvec3(0), glm::dvec3(5)};
    glm::dquat rotation{0, 1, 0, 0};
    std::optional<Disc> object;
    std::vector<Disc> list;
    std::variant<Disc, Tile> variant = Tile();
    double byHand = 5;
};

const Description& describe(const Disc*) {
    static const Description description =
        Describe<Disc>("disc", "A disc.").key("radius", &Disc::radius, {"m", "Its radius.", aboveZero()});
    return description;
}

const Description& describe(const Tile*) {
    static const Description description =
        Describe<Tile>("tile", "A tile.").key("side", &Tile::side, {"m", "Its side.", aboveZero()});
    return description;
}

const Description& describe(const Every*) {
    static const Description description =
        Describe<Every>("every", "A key of each kind.")
            .key("number", &Every::number, {"m", "", Range::between(0, 9)})
            .key("whole", &Every::whole, {"", "", Range::atLeast(2)})
            .key("whole3", &Every::whole3, {"", ""})
            .key("seed", &Every::seed, {"", ""})
            .key("longSeed", &Every::longSeed, {"", ""})
            .key("flag", &Every::flag, {"", ""})
            .word("word", &Every::word, {"off", "dim"}, {"", ""})
            .key("text", &Every::text, {"", ""})
            .key("texts", &Every::texts, {"", ""})
            .key("vector2", &Every::vector2, {"", ""})
            .key("vector3", &Every::vector3, {"m", ""})
            .direction("direction", &Every::direction, {"", ""})
            .color("color", &Every::color, {"", ""})
            .span("span", &Every::span, {"s", "", aboveZero()})
            .ends("ends", &Every::ends, {"", ""})
            .box("box", &Every::box, {"m", ""})
            .rotation("rotation", &Every::rotation, {"", ""})
            .key("object", &Every::object, {"", ""})
            .key("list", &Every::list, {"", ""})
            .needed()
            .alternatives("variant", &Every::variant, {"", ""})
            .byHand(
                "byHand", {.value = Form::Value::number, .range = Range::atLeast(3)}, {"", ""},
                [](JsonReader& reader, Every& every, void*) { reader.get("byHand", every.byHand); },
                [](const Every& every, const void*) { return toJson(every.byHand); });
    return description;
}

// What is known of a kind: the least value, the same as it is written (empty: it is left out), what tables
// and schemas say of it.
struct KindRow {
    const KeyKind& kind;
    const char *key, *least, *written, *type, *schema;
    RowForm form;
};

const KindRow kindRows[] = {
    {Kind::number, "number", "1", "1", "number from 0 to 9, m",
     R"({"type": "number", "minimum": 0, "maximum": 9})", RowForm::numbers},
    {Kind::whole, "whole", "2", "2", "whole number of at least 2", R"({"type": "integer", "minimum": 2})",
     RowForm::wholes},
    {Kind::whole3, "whole3", "[8, 8, 8]", "[8, 8, 8]", "three whole numbers",
     R"({"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "integer"}})", RowForm::wholes},
    {Kind::seed, "seed", "1", "1", "whole number from 0 to 4294967295",
     R"({"type": "integer", "minimum": 0, "maximum": 4294967295})", RowForm::wholes},
    {Kind::longSeed, "longSeed", "1", "1", "whole number of 64 bits", R"({"type": "integer", "minimum": 0})",
     RowForm::wholes},
    {Kind::flag, "flag", "true", "true", "true or false", R"({"type": "boolean"})", RowForm::tick},
    {Kind::word, "word", R"("off")", R"("off")", R"(`"off"`, `"dim"`)", R"({"enum": ["off", "dim"]})",
     RowForm::word},
    {Kind::text, "text", R"("some text")", R"("some text")", "string", R"({"type": "string"})",
     RowForm::text},
    {Kind::texts, "texts", "[]", "", "list of strings",
     R"({"type": "array", "minItems": 1, "items": {"type": "string"}})", RowForm::texts},
    {Kind::vector2, "vector2", "[1, 1]", "[1, 1]", "two numbers", R"({"$ref": "#/$defs/vector2"})",
     RowForm::numbers},
    {Kind::vector3, "vector3", "[0, 0, 0]", "[0, 0, 0]", "[x, y, z], m", R"({"$ref": "#/$defs/vector"})",
     RowForm::numbers},
    {Kind::direction, "direction", "[0, 1, 0]", "[0, 1, 0]", "direction", R"({"$ref": "#/$defs/direction"})",
     RowForm::direction},
    {Kind::color, "color", "[1, 1, 1]", "[1, 1, 1]", "colour", R"({"$ref": "#/$defs/color"})",
     RowForm::color},
    {Kind::span, "span", "[1, 1]", "1", "number or [least, most] above 0, s",
     R"({"anyOf": [{"type": "number", "minimum": 1e-09}, )"
     R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "number", "minimum": 1e-09}}]})",
     RowForm::span},
    {Kind::ends, "ends", "[1, 1]", "[1, 1]", "number or [first, last]",
     R"({"anyOf": [{"type": "number"}, )"
     R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "number"}}]})",
     RowForm::span},
    {Kind::box, "box", R"({"low": [-1, -1, -1], "high": [1, 1, 1]})",
     R"({"low": [-1, -1, -1], "high": [1, 1, 1]})", "box, m", R"({"$ref": "#/$defs/box"})", RowForm::box},
    {Kind::rotation, "rotation", R"({"axis": [0, 1, 0], "angle": 0})", "[0, 0, 0, 1]", "rotation",
     R"({"$ref": "#/$defs/rotation"})", RowForm::rotation},
    {Kind::object, "object", "{}", "{}", "object", R"({"of": "disc"})", RowForm::node},
    {Kind::list, "list", "[{}]", "[{}]", "list of objects", R"({"type": "array", "items": {"of": "disc"}})",
     RowForm::list},
    {Kind::variant, "variant", R"("disc")", R"("disc")", R"(`"disc"`, `"tile"`)",
     R"({"enum": ["disc", "tile"]})", RowForm::variant},
    {Kind::byHand, "byHand", "3", "3", "see the text", R"({"type": "number", "minimum": 3})",
     RowForm::numbers},
};

JsonValue ofName(const Description& description) {
    return object(key("of", description.name()));
}

template <typename S>
S readFrom(const JsonValue& value) {
    JsonReader reader(value, "a.json");
    S out;
    describe(&out).read(reader, out);
    reader.finish();
    return out;
}

// What is written of what was read and is as it must be.
template <typename S>
JsonValue writtenAgain(const JsonValue& value) {
    const S read = readFrom<S>(value);
    describe(&read).check(read, Where(), largestNumber);
    return describe(&read).write(read);
}

void addKinds(const Description& description, std::set<const Description*>& seen,
              std::set<const KeyKind*>& kinds) {
    if (!seen.insert(&description).second) return;
    for (const Key& key : description.keys()) {
        kinds.insert(key.kind);
        for (const Description* held : key.objects)
            addKinds(*held, seen, kinds);
    }
}

// ---- A kind of key that only this test knows

// Minutes after midnight, which a file says as "7:05".
struct Alarm {
    int rings = 420;
};

bool getMinutes(const Key& key, JsonReader& reader, int& out) {
    std::string text;
    if (!reader.get(key.name, text)) return false;
    int hours = 0, minutes = 0;
    if (std::sscanf(text.c_str(), "%d:%2d", &hours, &minutes) != 2)
        throw Error(reader.locate(key.name), "expected hours:minutes, found \"", text, "\"");
    out = 60 * hours + minutes;
    return true;
}

JsonValue minutesJson(const int& minutes) {
    return toJson(concat(minutes / 60, minutes % 60 < 10 ? ":0" : ":", minutes % 60));
}

const KeyKind minutesKind = {
    .name = "hours:minutes",
    .form = RowForm::text,
    .read = readValue<int, getMinutes>,
    .check = [](const Key& key, const void* value, const Where& where,
                double) { needWithin(where.locate(key.name), held<int>(value), Range::between(0, 1439)); },
    .write = writeValue<int, minutesJson>,
    .least = [](const Key&, const TextOf&) { return minutesJson(0); },
    .schema =
        [](const Key&, const SchemaOf&) {
            return object(key("type", "string"), key("pattern", "^[0-9]+:[0-9]{2}$"));
        }};

const Description& describe(const Alarm*) {
    static const Description description =
        Describe<Alarm>("alarm", "An alarm.")
            .key("rings", &Alarm::rings, {"", "When it rings."}, minutesKind);
    return description;
}

}  // namespace

TEST_CASE("each kind of key reads, checks and writes the least of its values, and tells its type",
          "[description]") {
    const Description& every = describe(static_cast<const Every*>(nullptr));
    const auto textOf = [](const Key&) { return std::string("some text"); };
    for (const KindRow& row : kindRows) {
        INFO(row.key);
        const Key& key = *every.find(row.key);
        REQUIRE(key.kind == row.kind);
        const JsonValue least = key.kind->least(key, textOf);
        CHECK(writeJsonLine(least) == row.least);
        CHECK(typeText(key) == row.type);
        CHECK(writeJsonLine(key.kind->schema(key, ofName)) == row.schema);
        CHECK(key.kind->row(key, least) == row.form);

        JsonValue file = smallestObject(every, textOf);
        if (!file.find(row.key)) file.add(row.key, least);
        const JsonValue written = writtenAgain<Every>(file);
        const JsonValue* value = written.find(row.key);
        CHECK((value ? writeJsonLine(*value) : "") == row.written);
        CHECK(writeJsonLine(writtenAgain<Every>(written)) == writeJsonLine(written));
    }
}

TEST_CASE("each kind of key that a format has is tested on its own", "[description]") {
    std::set<const Description*> seen;
    std::set<const KeyKind*> kinds;
    addKinds(describe(static_cast<const Scene*>(nullptr)), seen, kinds);
    addKinds(describe(static_cast<const Molecule*>(nullptr)), seen, kinds);
    addKinds(describe(static_cast<const RawLayout*>(nullptr)), seen, kinds);
    CHECK(kinds.size() > 15);
    for (const KeyKind* kind : kinds) {
        INFO(kind->name);
        CHECK(std::any_of(std::begin(kindRows), std::end(kindRows),
                          [&](const KindRow& row) { return kind == row.kind; }));
    }
}

TEST_CASE("whole numbers are written in full, however large", "[description]") {
    for (const char* seed : {"100000", "18446744073709551615"}) {
        const std::string text = concat(R"({"longSeed": )", seed, R"(, "list": [{}], "variant": "disc"})");
        CHECK(writeJsonLine(*writtenAgain<Every>(parseJson(text, "a.json")).find("longSeed")) == seed);
    }
}

TEST_CASE("a kind of key is one object, which nothing else has to know", "[description]") {
    const Description& alarm = describe(static_cast<const Alarm*>(nullptr));
    const Key& key = alarm.keys()[0];
    const auto message = [](const char* text) {
        return messageOf([&] { writtenAgain<Alarm>(parseJson(text, "a.json")); });
    };
    CHECK(readFrom<Alarm>(parseJson(R"({"rings": "9:15"})", "a.json")).rings == 555);
    CHECK(message(R"({"rings": "late"})") ==
          "a.json:1:11: expected hours:minutes, found \"late\" (at $.rings)");
    CHECK(message(R"({"rings": "24:00"})") ==
          "expected a whole number from 0 to 1439, found 1440 (at $.rings)");
    CHECK(writeJsonLine(alarm.write(Alarm{485})) == R"({"rings": "8:05"})");
    CHECK(writeJsonLine(alarm.write(Alarm())) == "{}");
    CHECK(writeJsonLine(key.kind->least(key, {})) == R"("0:00")");
    CHECK_THAT(test::tableOf(alarm),
               Catch::Contains(R"(| `rings` | hours:minutes | `"7:00"` | When it rings. |)"));
    const JsonValue schema = test::schemaOf(alarm);
    CHECK(writeJsonLine(*schema.find("properties")->find("rings")) ==
          R"({"type": "string", "pattern": "^[0-9]+:[0-9]{2}$", "description": "When it rings.", )"
          R"("default": "7:00"})");
    CHECK(key.kind->row(key, {}) == RowForm::text);
}

}  // namespace shoal
