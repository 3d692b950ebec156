// Loops over a molecule's vertices, written out or spread over lanes, as text.
#include <algorithm>

#include "gpu/shader_source.h"
#include "simulate/vertex_loops.h"
#include "support/catch.h"

using namespace shoal;
using Form = VertexLoops::Form;

namespace {

gpu::ShaderSource expanded(const std::string& text, const VertexLoops& loops) {
    gpu::ShaderSource source = gpu::resolveShader("nowhere", "main.comp", {}, {{"main.comp", text}}, "");
    expand(source, loops);
    return source;
}

std::string writtenOut(const std::string& text, int vertices) {
    return expanded(text, {vertices, Form::writeOut, Form::writeOut}).text;
}

std::string loop(const std::string& body, char variable = 'i') {
    const std::string n(1, variable);
    return "for (int " + n + " = 0; " + n + " < VERTICES; ++" + n + ") {\n" + body + "}\n";
}

}  // namespace

TEST_CASE("a loop over the vertices is written out", "[loops]") {
    CHECK(writtenOut("a;\n" + loop("    x[i] += h;\n") + "b;\n", 3) ==
          "a;\nx[0] += h;\nx[1] += h;\nx[2] += h;\nb;\n");
    // what a body declares stays its own
    CHECK(writtenOut(loop("    vec3 d = x[i];\n    v[i] = d;\n"), 2) ==
          "{\n    vec3 d = x[0];\n    v[0] = d;\n}\n{\n    vec3 d = x[1];\n    v[1] = d;\n}\n");
    CHECK(writtenOut(loop("    x[i] += h;\n"), 1) == "x[0] += h;\n");
    CHECK(writtenOut(loop("    x[j] += h * float(i);\n", 'j'), 2) ==
          "x[0] += h * float(i);\nx[1] += h * float(i);\n");
}

TEST_CASE("only the variable is replaced", "[loops]") {
    const std::string body = "    int index = i;\n    v.i = vi + i_ + fi(i) + x[i+1] + 2*i;\n";
    const std::string out = writtenOut(loop(body), 8);
    CHECK_THAT(out, Catch::Contains("int index = 7;\n"));
    CHECK_THAT(out, Catch::Contains("v.i = vi + i_ + fi(7) + x[7+1] + 2*7;\n"));
}

TEST_CASE("nested braces inside the body belong to it", "[loops]") {
    const std::string body =
        "    if (a) {\n        b(i);\n    } else { c(i); }\n"
        "    d(i);\n"
        "    for (int s = 0; s < n; ++s) {\n        e(i, s);\n    }\n";
    std::string expected;
    for (const char* vertex : {"0", "1"}) {
        std::string one = body;
        for (const char* call : {"b(", "c(", "d(", "e("})
            one.replace(one.find(std::string(call) + "i") + 2, 1, vertex);
        expected += "{\n" + one + "}\n";
    }
    CHECK(writtenOut(loop(body) + "end;\n", 2) == expected + "end;\n");
}

TEST_CASE("other loops are left alone", "[loops]") {
    for (const std::string text : {"for (int i = 0; i < VERTICES; i++) {\n    x[i] = 0.0;\n}\n",
                                   "for (int i = 1; i < VERTICES; ++i) {\n    x[i] = 0.0;\n}\n",
                                   "for (int k = 0; k < VERTICES; ++k) {\n    x[k] = 0.0;\n}\n",
                                   "x; for (int i = 0; i < VERTICES; ++i) {\n"})
        CHECK(writtenOut(text, 4) == text);
    const std::string text = "    " + loop("        x[i] = u;\n");
    CHECK(expanded(text, {4, Form::keep, Form::writeOut}).text == text);
}

TEST_CASE("lines keep where they came from", "[loops]") {
    const std::string text = "#include \"lib/a.glsl\"\n" + loop("    one(i);\n    two(i);\n") + "after;\n";
    for (const Form form : {Form::keep, Form::writeOut}) {
        gpu::ShaderSource source = gpu::resolveShader(
            "nowhere", "main.comp", {"COUNT 3"},
            {{"main.comp", text}, {"lib/a.glsl", "first;\nsecond;\n" + loop("    in(i);\n")}},
            gpu::header430());
        expand(source, {3, form, form});
        const auto lines = std::count(source.text.begin(), source.text.end(), '\n');
        REQUIRE(size_t(lines) == source.lines.size());
        std::map<std::string, int> expected{{"first", 1}, {"second", 2}, {"in(", 4},
                                            {"one(", 3},  {"two(", 4},   {"after", 6}};
        size_t start = 0, found = 0;
        for (const gpu::ShaderSource::Line& origin : source.lines) {
            const std::string line = source.text.substr(start, source.text.find('\n', start) - start);
            start += line.size() + 1;
            for (const auto& [word, number] : expected) {
                if (line.find(word) == std::string::npos) continue;
                INFO(line);
                CHECK(origin.line == number);
                const bool inA = word == "first" || word == "second" || word == "in(";
                CHECK(source.files[size_t(origin.file)] ==
                      (inA ? "generated:lib/a.glsl" : "generated:main.comp"));
                ++found;
            }
        }
        CHECK(found == (form == Form::writeOut ? 12 : 6));
    }
}
