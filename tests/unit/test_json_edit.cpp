// Changes carried over into a text that says the same in other words.
#include "core/json_edit.h"
#include "core/random.h"
#include "support/catch.h"

using namespace shoal;

namespace {

std::string edited(const std::string& text, const std::string& before, const std::string& after) {
    std::vector<TextChange> changes;
    addChanges(text, parseJson(text, "text"), parseJson(before, "before"), parseJson(after, "after"),
               changes);
    return withChanges(text, std::move(changes));
}

JsonValue anyValue(Random& random, int depth) {
    const double dice = random.uniform();
    if (depth == 0 || dice < 0.3) return JsonValue::makeNumber(std::floor(random.uniform() * 5));
    JsonValue out = dice < 0.6 ? JsonValue::makeArray() : JsonValue::makeObject();
    const int count = int(random.uniform() * 5);
    for (int i = 0; i < count; ++i) {
        const std::string key(1, char('a' + i));
        if (dice < 0.6)
            out.items.push_back(anyValue(random, depth - 1));
        else if (random.uniform() < 0.7)
            out.add(key, anyValue(random, depth - 1));
    }
    return out;
}

// Returns the value, changed here and there.
JsonValue mutated(const JsonValue& value, Random& random, int depth) {
    if (random.uniform() < 0.1) return anyValue(random, depth);
    JsonValue out = value;
    for (JsonValue& item : out.items)
        item = mutated(item, random, depth - 1);
    for (auto& [key, member] : out.members)
        member = mutated(member, random, depth - 1);
    if (!out.items.empty() && random.uniform() < 0.3)
        out.items.erase(out.items.begin() + int(random.uniform() * double(out.items.size())));
    if (out.kind == JsonValue::Kind::array && random.uniform() < 0.3)
        out.items.insert(out.items.begin() + int(random.uniform() * double(out.items.size() + 1)),
                         anyValue(random, depth - 1));
    if (!out.members.empty() && random.uniform() < 0.3)
        out.members.erase(out.members.begin() + int(random.uniform() * double(out.members.size())));
    return out;
}

// Keys in any order are the same.
JsonValue sorted(JsonValue value) {
    for (JsonValue& item : value.items)
        item = sorted(std::move(item));
    for (auto& [key, member] : value.members)
        member = sorted(std::move(member));
    std::sort(value.members.begin(), value.members.end(),
              [](const JsonMember& a, const JsonMember& b) { return a.first < b.first; });
    return value;
}

}  // namespace

TEST_CASE("a change of a number leaves all other bytes", "[jsonEdit]") {
    const std::string text =
        "\xEF\xBB\xBF{ \"comment\": \"by hand\",\n\t\"b\" : 1e0,   \"a\":[1.50, 2 ],\"s\": "
        "18446744073709551615}\n\n";
    CHECK(edited(text, R"({"a": [1.5, 2], "b": 1})", R"({"a": [1.5, 2], "b": 1})") == text);
    CHECK(edited(text, R"({"a": [1.5, 2], "b": 1})", R"({"a": [1.5, 2], "b": 0.25})") ==
          "\xEF\xBB\xBF{ \"comment\": \"by hand\",\n\t\"b\" : 0.25,   \"a\":[1.50, 2 ],\"s\": "
          "18446744073709551615}\n\n");
    CHECK(edited(text, R"({"a": [1.5, 2]})", R"({"a": [3, 2]})").find("\"a\":[3, 2],\"s\"") !=
          std::string::npos);
}

TEST_CASE("keys come and go as the text is laid out", "[jsonEdit]") {
    CHECK(edited(R"({"a": 1, "b": 2})", R"({"a": 1, "b": 2})", R"({"a": 1, "n": {"x": 1}, "b": 2})") ==
          R"({"a": 1, "n": {"x": 1}, "b": 2})");
    CHECK(
        edited("{\n    \"a\": 1,\n    \"b\": 2\n}", R"({"b": 2})", R"({"b": 2, "n": {"x": {"y": 1}}})") ==
        "{\n    \"a\": 1,\n    \"b\": 2,\n    \"n\": {\n      \"x\": {\n        \"y\": 1\n      }\n    }\n}");
    CHECK(edited(R"({"a": 1, "b": 2, "c": 3})", R"({"a": 1, "b": 2})", R"({"n": 0})") ==
          R"({"c": 3, "n": 0})");
    CHECK(edited(R"({"a": 1})", R"({"a": 1})", R"({})") == "{}");
    CHECK(edited("{}", "{}", R"({"a": [1, 2]})") == R"({"a": [1, 2]})");
    // what is spelt out though it is the default
    CHECK(edited(R"({"a": 0, "b": 2})", R"({"b": 2})", R"({"b": 2, "a": 7})") == R"({"a": 7, "b": 2})");
}

TEST_CASE("an element that is left out takes its comment with it", "[jsonEdit]") {
    const std::string text =
        "[\n  {\"comment\": \"one\", \"a\": 1},\n  {\"comment\": \"two\", \"a\": 2},\n"
        "  {\"comment\": \"three\", \"a\": 3}\n]";
    CHECK(edited(text, R"([{"a": 1}, {"a": 2}, {"a": 3}])", R"([{"a": 1}, {"a": 3}])") ==
          "[\n  {\"comment\": \"one\", \"a\": 1},\n  {\"comment\": \"three\", \"a\": 3}\n]");
    CHECK(edited(text, R"([{"a": 1}, {"a": 2}, {"a": 3}])", R"([{"a": 2}, {"a": 3}])") ==
          "[\n  {\"comment\": \"two\", \"a\": 2},\n  {\"comment\": \"three\", \"a\": 3}\n]");
    CHECK(edited(text, R"([{"a": 1}, {"a": 2}, {"a": 3}])", R"([{"a": 0}, {"a": 1}, {"a": 2}, {"a": 3}])") ==
          "[\n  {\"a\": 0},\n" + text.substr(2));
    CHECK(edited(text, R"([{"a": 1}, {"a": 2}, {"a": 3}])", R"([{"a": 1}, {"a": 2, "b": 4}, {"a": 3}])") ==
          "[\n  {\"comment\": \"one\", \"a\": 1},\n  {\"comment\": \"two\", \"a\": 2, \"b\": 4},\n"
          "  {\"comment\": \"three\", \"a\": 3}\n]");
}

TEST_CASE("any change that is carried over to the text itself says what was asked for", "[jsonEdit]") {
    Random random(7, 1);
    for (int i = 0; i < 3000; ++i) {
        const JsonValue before = anyValue(random, 4), after = mutated(before, random, 4);
        const std::string text = i % 2 == 0 ? writeJson(before) : writeJsonLine(before);
        const std::string result = edited(text, writeJson(before), writeJson(after));
        INFO(text << "\nto\n" << writeJson(after) << "\nbecame\n" << result);
        REQUIRE(sameJson(sorted(parseJson(result, "result")), sorted(after)));
    }
}
