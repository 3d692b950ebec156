// Tables of results as text and CSV.
#include "core/json_build.h"
#include "core/table.h"
#include "support/catch.h"

using namespace shoal;

namespace {

constexpr Column columns[] = {{"case", "case", -8},
                              {"time.min", "ms", 8, "%.1f", 1e3},
                              {"bytes", "B/s", 8, nullptr, 1, "time.min"},
                              {"", "a second", 10, "%.0f", 1, "time.min"},
                              {"held", "held", 6}};

std::vector<JsonValue> rows() {
    return {object(key("group", "few"), key("case", "a"), key("time", object(key("min", 0.25))),
                   key("bytes", 50), key("held", true)),
            object(key("group", "few"), key("case", "b"), key("leftOut", "needs more")),
            object(key("group", "many"), key("case", "c"), key("time", JsonValue()), key("held", false))};
}

}  // namespace

TEST_CASE("a table picks, scales and divides what rows hold, by groups", "[table]") {
    CHECK(tableText(columns, rows(), "group") == R"(
few
  case          ms     B/s  a second  held
  a          250.0     200         4   yes
  b         left out: needs more

many
  case          ms     B/s  a second  held
  c              -       -         -    no
)");
    CHECK(tableText(columns, {}) == "");
}

TEST_CASE("a CSV has what rows hold, and nothing where they do not", "[table]") {
    const JsonValue quoted = object(key("case", "say \"a, b\""), key("held", true));
    CHECK(tableCsv("case,min,held", "case,time.min,held", {rows()[0], rows()[1], quoted}) ==
          "case,min,held\na,0.25,1\nb,,\n\"say \"\"a, b\"\"\",,1\n");
}
