#include "support/catch.h"

#include <cmath>

#include "core/json.h"
#include "core/json_build.h"
#include "support/message_of.h"

using namespace shoal;

static std::string parseError(const std::string& text) {
    return messageOf([&] { parseJson(text, "f"); });
}

TEST_CASE("JSON values know where they stand", "[json]") {
    const JsonValue root = parseJson("{\n  \"a\" : [1, \"two\",\n   {\"b\":true}],\n\t\"c\":null}", "f");
    CHECK(root.line == 1);
    CHECK(root.column == 1);
    const JsonValue& a = *root.find("a");
    CHECK(a.line == 2);
    CHECK(a.column == 9);
    CHECK(a.keyLine == 2);
    CHECK(a.keyColumn == 3);
    CHECK(a.items[0].column == 10);
    CHECK(a.items[1].column == 13);
    CHECK(a.items[2].line == 3);
    CHECK(a.items[2].column == 4);
    CHECK(a.items[2].find("b")->column == 9);
    CHECK(root.find("c")->line == 4);
    CHECK(root.find("c")->column == 6);
    CHECK(root.find("d") == nullptr);
}

TEST_CASE("positions survive escapes, brackets in strings, and a byte-order mark", "[json]") {
    const JsonValue root = parseJson("\xEF\xBB\xBF{\"k\\\"]:,\": \"\\u00e4 [,:{ \", \"n\": -1.5e3}", "f");
    CHECK(root.column == 1);
    CHECK(root.members[0].first == "k\"]:,");
    CHECK(root.members[0].second.text == "\xC3\xA4 [,:{ ");
    CHECK(root.members[0].second.column == 12);
    CHECK(root.members[1].second.number == -1500);
    CHECK(root.members[1].second.column == 33);
}

TEST_CASE("numbers are read to the last bit", "[json]") {
    for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 123456789012345680.0}) {
        const std::string text = writeJson(JsonValue::makeNumber(value));
        const double again = parseJson(text, "f").number;
        CHECK(again == value);
        CHECK(std::signbit(again) == std::signbit(value));
    }
    CHECK(writeJson(JsonValue::makeNumber(0.1)) == "0.1\n");
    CHECK(writeJson(JsonValue::makeNumber(NAN)) == "null\n");
}

TEST_CASE("what is not JSON is refused with its place", "[json]") {
    CHECK(parseError("") == "f:1:1: expected a JSON object, found an empty file");
    CHECK(parseError(" \n") == "f:2:1: expected a JSON object, found an empty file");
    CHECK(parseError("{\"a\": 1,}") == "f:1:9: expected a key in double quotes, found '}'");
    CHECK(parseError("{\"a\" 1}") == "f:1:6: expected ':' after the key, found '1'");
    CHECK(parseError("{\"a\": 1\n\"b\": 2}") == "f:2:1: expected ',' or '}', found '\"'");
    CHECK(parseError("[1 2]") == "f:1:4: expected ',' or ']', found '2'");
    CHECK(parseError("[1,") == "f:1:4: expected a value, found the end of the file");
    CHECK(parseError("{} x") == "f:1:4: expected the end of the file, found 'x'");
    CHECK(parseError("[NaN]") == "f:1:2: expected a value, found NaN (JSON has finite numbers only)");
    CHECK(parseError("[nan]") == "f:1:2: expected a value, found nan (JSON has finite numbers only)");
    CHECK(parseError("[-Infinity]").find("Infinity (JSON has finite numbers only)") != std::string::npos);
    CHECK(parseError("[tru]") == "f:1:2: expected a value, found 't'");
    CHECK(parseError("// x\n{}") == "f:1:1: expected a value, found a comment (use a key \"comment\")");
    CHECK(parseError("{\"a\":\n 1e999}")
              .starts_with("f:2:2: expected a number that fits a double, found 1e999"));
    CHECK(parseError("[01]") != "");
    CHECK(parseError("[1.]") == "f:1:4: expected digits after the decimal point, found ']'");
    CHECK(parseError("{\"a\": 1, \"a\": 2}") == "f:1:10: key \"a\" appears twice (at $.a)");
    CHECK(parseError("{\"a\": [{\"b\": 1, \"b\": 2}]}") == "f:1:17: key \"b\" appears twice (at $.a[0].b)");
    CHECK(parseError("\"\xff\"").find("expected UTF-8 text") != std::string::npos);
    CHECK(parseError("\"open").find("expected a closing quotation mark") != std::string::npos);
    CHECK(parseError(std::string("{}\0{", 4)) == "f:1:3: expected JSON, found a zero byte");
}

TEST_CASE("nesting is limited to 64 levels", "[json]") {
    CHECK(parseError(std::string(64, '[') + std::string(64, ']')).empty());
    CHECK(parseError(std::string(65, '[') + std::string(65, ']'))
              .starts_with("f:1:65: is nested deeper than 64"));
    CHECK(parseError(std::string(1000000, '[')).starts_with("f:1:65: "));
}

TEST_CASE("an object gives its keys one by one", "[json]") {
    const JsonValue root = parseJson(
        R"({"d": 1.5, "i": 3, "u": 18446744073709551615, "b": true, "s": "x", "v": [1, 2, 3], "w": [4, 5],
            "list": [1, 2], "words": ["a", "b"], "kind": "two", "o": {"k": 1}, "os": [{"k": 2}, {"k": 3}],
            "t": [[0, 1, 2]], "comment": "free"})",
        "f");
    JsonReader reader(root, "f");
    double d = 0;
    int i = 0, kind = -1;
    uint64_t u = 0;
    bool b = false;
    std::string s;
    glm::dvec3 v;
    glm::dvec2 w;
    std::vector<double> list;
    std::vector<std::string> words;
    std::vector<glm::ivec3> triples;
    CHECK(reader.get("d", d));
    reader.need("i", i);
    CHECK(reader.get("u", u));
    CHECK(reader.get("b", b));
    CHECK(reader.get("s", s));
    CHECK(reader.get("v", v));
    CHECK(reader.get("w", w));
    CHECK(reader.get("list", list));
    CHECK(reader.get("words", words));
    CHECK(reader.choose("kind", {"one", "two"}, kind));
    CHECK(reader.get("t", triples));
    CHECK((d == 1.5 && i == 3 && u == 18446744073709551615u && b && s == "x" && kind == 1));
    CHECK((v == glm::dvec3(1, 2, 3) && w == glm::dvec2(4, 5) && triples[0] == glm::ivec3(0, 1, 2)));
    CHECK((list.size() == 2 && words.size() == 2));
    CHECK_FALSE(reader.get("absent", d));
    CHECK(d == 1.5);
    CHECK(reader.object("o")->path() == "$.o");
    CHECK_FALSE(reader.object("absent"));
    CHECK(reader.objects("os")[1].path() == "$.os[1]");
    reader.finish();
}

TEST_CASE("errors of a key say what was expected and what was found", "[json]") {
    const JsonValue root =
        parseJson(R"({"mass": -3, "name": "x", "v": [1, "2", 3], "n": 1.5, "masss": 1, "big": 1e300})", "f");
    JsonReader reader(root, "f");
    double d = 0;
    int i = 0;
    uint64_t u = 0;
    bool b = false;
    std::string s;
    glm::dvec3 v;
    glm::dvec2 w;
    CHECK(messageOf([&] { reader.get("mass", d, Range{.least = 0, .aboveLeast = true}); }) ==
          "f:1:10: expected a number above 0, found -3 (at $.mass)");
    CHECK(messageOf([&] { reader.get("mass", d, Range::atLeast(0)); }) ==
          "f:1:10: expected a number of at least 0, found -3 (at $.mass)");
    CHECK(messageOf([&] { reader.get("mass", d, Range::between(0, 1)); }) ==
          "f:1:10: expected a number from 0 to 1, found -3 (at $.mass)");
    CHECK(messageOf([&] { reader.get("name", d); }) ==
          "f:1:22: expected a number, found a string (at $.name)");
    CHECK(messageOf([&] { reader.get("mass", s); }) ==
          "f:1:10: expected a string, found a number (at $.mass)");
    CHECK(messageOf([&] { reader.get("mass", b); }) ==
          "f:1:10: expected true or false, found a number (at $.mass)");
    CHECK(messageOf([&] { reader.get("v", v); }) == "f:1:36: expected a number, found a string (at $.v[1])");
    CHECK(messageOf([&] { reader.get("v", w); }) ==
          "f:1:32: expected an array of 2 numbers, found 3 (at $.v)");
    CHECK(messageOf([&] { reader.get("n", i); }) == "f:1:50: expected a whole number, found 1.5 (at $.n)");
    CHECK(messageOf([&] { reader.get("big", i); }).find("expected a whole number, found 1e300") !=
          std::string::npos);
    CHECK(messageOf([&] { reader.get("mass", u); }).find("expected a whole number from 0 to") !=
          std::string::npos);
    CHECK(messageOf([&] { reader.need("stiffness", d); }) == "f:1:1: missing key \"stiffness\" (at $)");
    CHECK(messageOf([&] {
              reader.choose("name", {"xy", "zz"}, i);
          }) == "f:1:22: unknown word \"x\" (did you mean \"xy\"?) (at $.name)");
    CHECK(messageOf([&] { reader.finish(); }) ==
          "f:1:55: unknown key \"masss\" (did you mean \"mass\"?) (at $.masss)");
    CHECK(messageOf([&] { JsonReader(root.members[0].second, "f"); }) ==
          "f:1:10: expected an object, found a number (at $)");
}

TEST_CASE("an unknown key is refused though every known one was taken", "[json]") {
    const JsonValue root = parseJson("{\"a\": 1,\n \"zebra\": 2}", "f");
    JsonReader reader(root, "f");
    double d = 0;
    reader.get("a", d);
    CHECK(messageOf([&] { reader.finish(); }) ==
          "f:2:2: unknown key \"zebra\" (expected one of a) (at $.zebra)");
    // at the top, and as a string, an editor's hint is allowed
    const JsonValue hinted = parseJson(R"({"$schema": "s.json", "in": {"$schema": "s.json"}})", "f");
    JsonReader top(hinted, "f");
    std::optional<JsonReader> in = top.object("in");
    CHECK_NOTHROW(top.finish());
    CHECK_THAT(messageOf([&] { in->finish(); }), Catch::Contains("unknown key \"$schema\""));
    const JsonValue comment = parseJson("{\"comment\": 3}", "f");
    CHECK(messageOf([&] { JsonReader(comment, "f").finish(); }) ==
          "f:1:13: expected a string, found a number (at $.comment)");
}

TEST_CASE("whole numbers are written without an exponent", "[json]") {
    CHECK(writeJsonLine(toJson(std::vector<size_t>{0, 7, 100000, 5000000000})) ==
          "[0, 7, 100000, 5000000000]");
    CHECK(writeJsonLine(toJson(-200000)) == "-200000");
    CHECK(writeJsonLine(toJson(1e12)) == "1e+12");
}

TEST_CASE("what is written reads well and reads back", "[json]") {
    const std::string text =
        "{\n  \"z\": 1,\n  \"a\": [1, 2.5],\n  \"list\": [\n    {\"k\": \"x\\n\\u0001\\\"\", \"v\": [0, "
        "1]},\n"
        "    {}\n  ],\n  \"o\": {\n    \"b\": true\n  },\n  \"n\": null\n}\n";
    CHECK(writeJson(parseJson(text, "f")) == text);
}
