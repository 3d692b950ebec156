// Tables of GPU arrays, and what shaders declare of them.
#include "core/file.h"
#include "gpu/array_table.h"
#include "gpu/shader_source.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using gpu::ArrayRow;
using gpu::ArrayTable;
using Form = ArrayTable::Form;

namespace {

const char* const rows =
    "# a comment\n"
    "#include \"state/numbered.glsl\"\n"
    "places  | both     | float4 | slot      | step  | far | always      | where\n"
    "totals  | both     | float4 | 2*slot    | steps | 0   | rest !self  | sums\n"
    "lists   | buffers  | uint1  | list*slot | step  | -   | always      | others\n"
    "lists   | textures | 4uint1 | list*slot | step  | -   | always      | others\n"
    "pairs   | textures | 2uint2 | given     | step  | -   | always      | x key, y number\n"
    "starts  | both     | uint1  | key+1     | stage | -   | always      | first slots\n"
    "pushes  | both     | float4 | list*slot | step  | -   | always      | impulses\n"
    "anchors | both     | float4 | list*slot | step  | -   | always      | anchors\n"
    "words   | buffers  | record | 11        | step  | 0   | always      | counts\n";

ArrayTable tableOf(const std::string& text, Form form, const std::set<std::string>& holds = {"rest"}) {
    const test::Scratch scratch;
    writeFile(scratch.path("arrays.txt"), text);
    return {scratch.path("arrays.txt"), form, holds};
}

std::string messageOf(const std::string& row) {
    try {
        tableOf(row, Form::buffers);
    } catch (const Error& error) {
        CHECK(error.location().line == 1);
        return error.what();
    }
    return "";
}

// The text of a shader with a table.
std::string shaderOf(const ArrayTable& table, const std::string& text) {
    return gpu::resolveShader("nowhere", "main.comp", {}, {{"main.comp", text}, {"state/numbered.glsl", ""}},
                              "", &table)
        .text;
}

}  // namespace

TEST_CASE("a row says what an array is", "[arrays]") {
    const ArrayTable table = tableOf(rows, Form::buffers);
    CHECK(table.includes() == std::vector<std::string>{"state/numbered.glsl"});
    CHECK(table.rows().size() == 7);
    const ArrayRow& totals = *table.find("totals");
    CHECK((totals.count == 2 && totals.index == "slot" && totals.start == ArrayRow::Start::zero));
    CHECK(totals.when == std::vector<std::string>{"rest", "!self"});
    CHECK((table.find("lists")->ofList && table.find("lists")->packed == 1));
    CHECK((table.find("starts")->index == "key" && table.find("starts")->more == 1));
    CHECK((table.find("words")->isRecord && table.find("words")->count == 11 &&
           table.find("words")->index.empty()));
    CHECK(table.find("pairs") == nullptr);
    CHECK(tableOf(rows, Form::textures).find("lists")->packed == 4);
}

TEST_CASE("a shader declares arrays by name, with buffers or in fragments", "[arrays]") {
    const ArrayTable buffers = tableOf(rows, Form::buffers), textures = tableOf(rows, Form::textures);
    using Catch::Contains;
    const std::string read = shaderOf(buffers, "#pragma reads places totals\n#pragma reads places\n");
    CHECK_THAT(read, Contains("uniform samplerBuffer places;\nvec4 placesAt(int i)"));
    CHECK_THAT(read, Contains("texelFetch(totals, 2 * (i) + (k))"));
    CHECK(read.find("placesAt") == read.rfind("placesAt"));
    CHECK_THAT(shaderOf(textures, "#pragma reads totals\n"), Contains("uniform sampler2DArray totals;"));
    CHECK_THAT(shaderOf(textures, "#pragma reads lists\n"), Contains("ivec3(texelOf(i), e >> 2), 0)[e & 3]"));
    CHECK_THAT(shaderOf(textures, "#pragma reads pairs\n"), Contains("? two.xy : two.zw"));
    CHECK_THAT(shaderOf(buffers, "#pragma writes starts\n"),
               Contains("writeonly buffer Starts { uint startsBuffer[]; };"));
    const std::string updated = shaderOf(buffers, "#pragma updates lists\n#pragma reads lists\n");
    CHECK_THAT(updated, Contains("return listsBuffer[(e) * listStride + (i)];"));
    CHECK_THAT(updated, !Contains("samplerBuffer"));
    const std::string written = shaderOf(textures, "#pragma writes pushes anchors\n");
    CHECK_THAT(written, Contains("layout(location = 0) out vec4 newPushes[ENTRIES_A_DRAW];"));
    CHECK_THAT(written, Contains("layout(location = 4) out vec4 newAnchors[ENTRIES_A_DRAW];"));
    CHECK_THAT(written, Contains("#define ENTRIES_A_DRAW 4"));
    // one text for both: fragments read what it updates, and what another form alone has takes nothing
    const std::string kept = shaderOf(textures, "#pragma updates totals\n#pragma writes words\n");
    CHECK_THAT(kept,
               Contains("uniform sampler2DArray totals;") && Contains("#define putTotals(i, k, value)\n"));
    CHECK_THAT(kept, Contains("#define putWords(i, k, value)\n") && !Contains("buffer"));
}

TEST_CASE("what is wrong with a row or a name is told where it stands", "[arrays]") {
    using Catch::Contains;
    CHECK_THAT(messageOf("places | both | float4\n"), Contains("arrays.txt:1") && Contains("eight columns"));
    CHECK_THAT(messageOf("a | all | float4 | slot | step | - | always | x\n"), Contains("a form"));
    CHECK_THAT(messageOf("a | both | float5 | slot | step | - | always | x\n"), Contains("a value: float4"));
    CHECK_THAT(messageOf("a | both | float4 | slot | week | - | always | x\n"), Contains("a life"));
    CHECK_THAT(messageOf("a | both | float4 | slot | step | 1 | always | x\n"), Contains("a start"));
    const std::string row = "a | both | float4 | slot | step | - | always | x\n";
    CHECK_THROWS_WITH(tableOf(row + row, Form::buffers),
                      Contains("arrays.txt:2") && Contains("there are two arrays \"a\""));
    const ArrayTable buffers = tableOf(rows, Form::buffers), textures = tableOf(rows, Form::textures);
    CHECK_THROWS_WITH(shaderOf(buffers, "\n#pragma reads place\n"),
                      Contains("main.comp:2") && Contains("did you mean \"places\"?"));
    CHECK_THROWS_WITH(shaderOf(buffers, "#pragma takes places\n"),
                      Contains("expected #pragma reads, writes or updates"));
    CHECK_THROWS_WITH(shaderOf(buffers, "#pragma reads lists\n#pragma updates lists\n"),
                      Contains("updated after it was read"));
}

TEST_CASE("an array that a form or a scene lacks takes nothing", "[arrays]") {
    using Catch::Contains;
    const ArrayTable buffers = tableOf(rows, Form::buffers, {"rest"}),
                     without = tableOf(rows, Form::buffers, {});
    CHECK((buffers.find("totals")->isNeeded && !without.find("totals")->isNeeded));
    CHECK(shaderOf(buffers, "#pragma reads pairs\n") == "#define pairsAt(i) uvec2(0)\n");
    CHECK(
        shaderOf(without, "#pragma updates totals\n#pragma reads totals\n") ==
        "#define putTotals(i, k, value)\n#define putAllTotals(i, values)\n#define totalsAt(i, k) vec4(0)\n");
    CHECK_THAT(shaderOf(buffers, "#pragma writes totals when rest buffers\n"), Contains("buffer Totals"));
    CHECK(shaderOf(buffers, "#pragma writes totals when !rest\n") ==
          "#define putTotals(i, k, value)\n#define putAllTotals(i, values)\n");
    // what buffers update and fragments write anew
    const std::string both = "#pragma updates totals when buffers\n#pragma writes totals\n";
    CHECK_THAT(shaderOf(buffers, both), Contains("buffer Totals") && Contains("totalsAt(int i, int k)"));
    CHECK_THAT(shaderOf(tableOf(rows, Form::textures), both),
               Contains("#undef putTotals") && Contains("out vec4 newTotals[2]"));
    // it would read zeros in fragments
    const std::string trap = "#pragma updates totals when buffers\n#pragma reads totals\n";
    CHECK_THAT(shaderOf(buffers, trap), Contains("buffer Totals"));
    CHECK_THROWS_WITH(shaderOf(tableOf(rows, Form::textures), trap),
                      Contains("\"totals\" is read, but was updated for some scenes or forms only"));
}
