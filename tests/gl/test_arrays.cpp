// Arrays made from a table: given to programs by name, written by passes in either form.
#include "core/file.h"
#include "gl/gl_test.h"
#include "gpu/arrays.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::gpu;
using Form = ArrayTable::Form;

namespace {

const char* const rows =
    "#include \"state/lanes.glsl\"\n"
    "values   | both | float4 | 2*place | step | 0 | always | two values of a place\n"
    "sums     | both | float4 | place   | step | - | always | their sums\n"
    "factors  | both | uint1  | given   | plan | - | always | factors\n"
    "unneeded | both | uint1  | place   | step | - | never  | nothing\n";
const char* const first =
    "#pragma reads factors\n#pragma writes values\n"
    "void main() {\n"
    "    int i = ownLane();\n"
    "    putValues(firstNumber + i, 0, vec4(float(firstNumber + i)));\n"
    "    putValues(firstNumber + i, 1, vec4(float(factorsAt(firstNumber + i))));\n"
    "}\n";
const char* const second =
    "#pragma reads values\n#pragma writes sums\n"
    "void main() {\n"
    "    int i = firstNumber + ownLane();\n"
    "    putSums(i, valuesAt(i, 0) + valuesAt(i, 1));\n"
    "}\n";

}  // namespace

TEST_CASE("passes over arrays read what passes before have written", "[arrays]") {
    for (const Form form : {Form::buffers, Form::textures}) {
        const bool textures = form == Form::textures;
        if (!textures && !testContext().info().computeShaders) continue;
        CAPTURE(textures);
        const test::Scratch scratch;
        writeFile(scratch.path("arrays.txt"), rows);
        const ArrayTable table(scratch.path("arrays.txt"), form);
        constexpr int places = 200;
        Arrays arrays(testContext(), table, {{{"place", places}}, 0, 4}, "test");
        std::vector<uint32_t> factors(places);
        for (uint32_t i = 0; i < places; ++i)
            factors[i] = 3 * i;
        arrays.give("factors", factors.data(), factors.size());
        const auto make = [&](const char* text) {
            ProgramOptions options;
            options.arrays = &table;
            options.generated = {{"pass.glsl", text}};
            (textures ? options.fragment : options.compute) = "pass.glsl";
            if (textures) options.vertex = "passes/fullscreen.vert";
            if (textures) options.defines = {"TEXTURES", "ROW_BITS 4"};
            return Program(testContext(), options);
        };
        const Program fills = make(first), adds = make(second);
        drawPlainly();
        arrays.run(arrays.use(fills), 0, places);
        arrays.run(arrays.use(adds), 0, places);
        arrays.settle();
        std::vector<glm::vec4> sums(textures ? 16 * 13 : places);
        if (textures)
            arrays.texture("sums").download(Traffic::Kind::state, 0, 0, 16, 13, sums.data(),
                                            sums.size() * sizeof sums[0]);
        else
            arrays.buffer("sums").download(Traffic::Kind::state, 0, sums.data(),
                                           sums.size() * sizeof sums[0]);
        for (int i = 0; i < places; ++i)
            CHECK(sums[size_t(i)] == glm::vec4(float(4 * i)));
        CHECK((arrays.has("values") && !arrays.has("unneeded")));
        CHECK(arrays.dispatches() == 2);
        arrays.swap("sums", "values");
        CHECK((arrays.has("sums") && arrays.bytes() > 0));
        testContext().checkErrors("arrays");
    }
}
