// Names of others, as a terminal and as JSON get them.
#include <sstream>

#include "core/error.h"
#include "core/json.h"
#include "core/printable.h"
#include "support/catch.h"

using namespace shoal;

TEST_CASE("what commands a terminal or hides is shown as an escape", "[printable]") {
    const std::pair<const char*, const char*> cases[] = {
        {"leaf, 叶, Blätter, 🍃", "leaf, 叶, Blätter, 🍃"},
        {"\x1b[2J", "\\u001b[2J"},
        {"a\nb\r\tc", "a\\nb\\r\\tc"},
        {"\x7f", "\\u007f"},
        {"\u009b31m", "\\u009b31m"},          // C1: the same as ESC [
        {"\u202egnp.exe", "\\u202egnp.exe"},  // what follows is written from right to left
        {"\u2066\u200f\u2028\ufeff", "\\u2066\\u200f\\u2028\\ufeff"},
        {"\xff\xc0\xaf", "\\xff\\xc0\\xaf"},  // no UTF-8; a slash in more bytes than it needs
        {"\xed\xa0\x80", "\\xed\\xa0\\x80"},  // half of a pair
        {"\xe2\x82", "\\xe2\\x82"},           // cut off
    };
    for (const auto& [text, shown] : cases) {
        CHECK(printable(text) == shown);
        CHECK(printable(printable(text)) == shown);
    }
}

TEST_CASE("an error quotes names on its own line", "[printable]") {
    const Error error({"a\nb.json", 3, 4, "$.\x1b[1m"}, "unknown \"x\nshoal: all is well\"\n  expected y");
    CHECK(std::string(error.what()) ==
          "a\\nb.json:3:4: unknown \"x\\nshoal: all is well\"\n  expected y (at $.\\u001b[1m)");
    CHECK(text(Warning{{}, "\x9b"}) == "\\x9b");
    CHECK(error.message() == "unknown \"x\nshoal: all is well\"\n  expected y");
    CHECK(printableLines(indented("0:1: bad\n0:2: \x1b[1mworse\n")) == "0:1: bad\n  0:2: \\u001b[1mworse");
}

TEST_CASE("a stream shows what anybody writes to it", "[printable]") {
    std::ostringstream to;
    {
        const PrintableStream filter(to);
        to << "a\tb\n"
           << "\x1b]0;title\x07" << char(0xc3) << char(0xa4) << "\xe2\x80";
        to << '\xae' << "end\xf0\x9f" << std::flush;
    }
    CHECK(to.str() == "a\tb\n\\u001b]0;title\\u0007ä\\u202eend\\xf0\\x9f");
    to << "\x1b";  // on its own again
    CHECK(to.str().back() == '\x1b');
}

TEST_CASE("a stream that cannot be written stays failed behind the filter", "[printable]") {
    struct Full : std::streambuf {};  // takes nothing
    Full full;
    std::ostream to(&full);
    {
        const PrintableStream filter(to);
        to << "text";
    }
    CHECK_FALSE(to);
}

TEST_CASE("JSON that is written is safe on a terminal and means the same", "[printable]") {
    const std::string name = "\x1b[2J \x7f \u009b \u202e \"q\" \\ 叶\n";
    const std::string text = writeJsonLine(JsonValue::makeString(name));
    CHECK(text == "\"\\u001b[2J \\u007f \\u009b \\u202e \\\"q\\\" \\\\ 叶\\n\"");
    CHECK(printable(text) == text);
    CHECK(parseJson(text, "text").text == name);
    // a file's name in bytes that are no UTF-8
    CHECK(parseJson(writeJsonLine(JsonValue::makeString("a\xff")), "text").text == "a\ufffd");
}
