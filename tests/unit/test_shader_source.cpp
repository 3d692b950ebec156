#include "gpu/shader_source.h"

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/file.h"
#include "support/catch.h"

using namespace shoal::gpu;
using Files = std::map<std::string, std::string>;

static ShaderSource resolve(const Files& files, const std::string& file,
                            const std::vector<std::string>& defines = {}) {
    return resolveShader("nowhere", file, defines, files, header330());
}

// "file:line" of the n-th line of the text, counted from 1.
static std::string origin(const ShaderSource& source, size_t n) {
    const ShaderSource::Line& line = source.lines.at(n - 1);
    return source.files.at(static_cast<size_t>(line.file)) + ":" + std::to_string(line.line);
}

TEST_CASE("a shader is its header, its defines and its includes, once each", "[shader]") {
    const ShaderSource source = resolve({{"main.frag",
                                          "#include \"lib/a.glsl\"\n"
                                          "#include \"lib/b.glsl\"\n"
                                          "void main() {}\n"},
                                         {"lib/a.glsl", "float a;\n#include \"lib/b.glsl\"\nfloat a2;"},
                                         {"lib/b.glsl", "#include \"lib/a.glsl\"\nfloat b;\n"}},
                                        "main.frag", {"COUNT 3", "FLAG"});
    CHECK(source.text ==
          "#version 330 core\n"
          "#define COUNT 3\n"
          "float a;\n"
          "float b;\n"
          "float a2;\n"
          "void main() {}\n");
    REQUIRE(source.lines.size() == 6);
    CHECK(std::count(source.text.begin(), source.text.end(), '\n') == 6);
    CHECK(origin(source, 1) == "shader header:1");
    CHECK(origin(source, 2) == "shader header:2");
    CHECK(origin(source, 3) == "generated:lib/a.glsl:1");
    CHECK(origin(source, 4) == "generated:lib/b.glsl:2");
    CHECK(origin(source, 5) == "generated:lib/a.glsl:3");
    CHECK(origin(source, 6) == "generated:main.frag:3");
}

TEST_CASE("only directives include", "[shader]") {
    const ShaderSource source = resolve({{"main.frag",
                                          "// #include \"none.glsl\"\n"
                                          "/* a comment\n"
                                          "#include \"none.glsl\"\n"
                                          "*/\n"
                                          "#includes\n"
                                          "  #  include  \"some.glsl\"  // with a reason\r\n"},
                                         {"some.glsl", "float some;\n"}},
                                        "main.frag");
    CHECK(source.text == "#version 330 core\n#includes\nfloat some;\n");
    CHECK(origin(source, 2) == "generated:main.frag:5");
    CHECK(origin(source, 3) == "generated:some.glsl:1");
}

TEST_CASE("comments and blank lines leave no trace in the text", "[shader]") {
    const auto textOf = [](const char* text) { return resolve({{"main.frag", text}}, "main.frag").text; };
    CHECK(textOf("// Why.\n\nfloat a; // m\n#ifdef A // no\nfloat b;\n#endif\n") ==
          "#version 330 core\nfloat a;\n");
    // what follows a comment keeps its column
    CHECK(textOf("float /* m */ a;\n/* one // two\n** /* */ float b; /**/\n/*/ float c; */ float d;\n") ==
          "#version 330 core\nfloat         a;\n         float b;\n                float d;\n");
}

TEST_CASE("what a condition leaves out includes nothing, and is there for whoever asks later", "[shader]") {
    const Files files = {{"main.frag",
                          "#if defined(DEEP) && !defined(FLAT)\n"
                          "#include \"lib/deep.glsl\"\n"
                          "#elif LEVELS > 2\n"
                          "float levels;\n"
                          "#else\n"
                          "uniform float flat;\n"
                          "#endif\n"
                          "#include \"lib/shared.glsl\"\n"},
                         {"lib/deep.glsl", "#include \"lib/shared.glsl\"\nfloat deep;\n"},
                         {"lib/shared.glsl", "float shared;\n"}};
    const auto textOf = [&](const std::vector<std::string>& defines) {
        return resolve(files, "main.frag", defines).text;
    };
    const std::string header = "#version 330 core\n#define LEVELS 2\n";
    CHECK(textOf({"LEVELS 2"}) == header + "uniform float flat;\nfloat shared;\n");
    CHECK(textOf({"LEVELS 2", "DEEP"}) == header + "float shared;\nfloat deep;\n");
    CHECK(textOf({"LEVELS 2", "DEEP", "FLAT"}) == header + "uniform float flat;\nfloat shared;\n");
    CHECK(textOf({"LEVELS 3"}) == "#version 330 core\n#define LEVELS 3\nfloat levels;\nfloat shared;\n");
    CHECK(resolve(files, "main.frag", {"LEVELS 3"}).leftOut.find("uniform float flat;") != std::string::npos);
}

TEST_CASE("a condition of another form is located, and one that does not end", "[shader]") {
    for (const char* wrong : {"#if FOO", "#if (defined(FOO))", "#if FOO > 1", "#else", "#endif",
                              "#elif defined(A)", "#if defined(A)", "#ifdef A\n#else"}) {
        INFO(wrong);
        CHECK_THROWS_WITH(resolve({{"main.frag", wrong}}, "main.frag"),
                          Catch::Contains("generated:main.frag:1: "));
    }
    CHECK_THROWS_WITH(resolve({{"main.frag", "#include \"a\"\n#endif\n"}, {"a", "#ifdef A\n"}}, "main.frag"),
                      Catch::Contains("generated:a:1: #if without #endif"));
}

TEST_CASE("an include that is missing is located where it is asked for", "[shader]") {
    const Files files = {{"main.frag", "\n  #include \"lib/sprong.glsl\"\n"}, {"lib/spring.glsl", ""}};
    try {
        resolve(files, "main.frag");
        FAIL("resolved");
    } catch (const shoal::Error& error) {
        CHECK(error.location().file == "generated:main.frag");
        CHECK(error.location().line == 2);
        CHECK(error.location().column == 3);
        CHECK(
            error.message() ==
            "there is no shader file \"lib/sprong.glsl\" below nowhere (did you mean \"lib/spring.glsl\"?)");
    }
    CHECK_THROWS_WITH(resolve({}, "main.frag"), Catch::Contains("main.frag"));
    for (const char* wrong :
         {"#include", "#include <a>", "#include \"a", "#include \"\"", "#include \"a\" b"}) {
        INFO(wrong);
        CHECK_THROWS_WITH(resolve({{"main.frag", wrong}, {"a", ""}}, "main.frag"),
                          Catch::Contains("generated:main.frag:1:1: expected #include"));
    }
}

TEST_CASE("files come from the root of the shaders", "[shader]") {
    const std::filesystem::path root = std::filesystem::temp_directory_path() / "shoal_test_shader_source";
    shoal::writeFile(root / "passes" / "test.frag",
                     std::string_view("#include \"lib/x.glsl\"\nvoid main() {}\n"));
    shoal::writeFile(root / "lib" / "x.glsl", std::string_view("float x;\n"));
    const ShaderSource source = resolveShader(root.string(), "passes/test.frag", {}, {}, header430());
    CHECK(source.text.substr(0, 18) == "#version 430 core\n");
    const std::string name = (root / "lib" / "x.glsl").string();
    CHECK(std::find(source.files.begin(), source.files.end(), name) != source.files.end());
    shoal::writeFile(root / "passes" / "test.frag", std::string_view("#include \"lib/y.glsl\"\n"));
    CHECK_THROWS_WITH(resolveShader(root.string(), "passes/test.frag", {}, {}, header330()),
                      Catch::Contains("test.frag:1:1: there is no shader file \"lib/y.glsl\"") &&
                          Catch::Contains("did you mean \"lib/x.glsl\"?"));
    std::filesystem::remove_all(root);
}

TEST_CASE("the logs of all drivers point into our files", "[shader]") {
    const ShaderSource source = resolve(
        {{"main.frag", "#include \"lib/a.glsl\"\nvoid main() {}\n"}, {"lib/a.glsl", "float a;\nfloat b\n"}},
        "main.frag");
    // Line 3 of the text is line 2 of the included file, line 4 is line 2 of the one that includes it.
    CHECK(source.rewriteLog("0:3(7): error: syntax error\n") ==
          "generated:lib/a.glsl:2:7: error: syntax error");
    CHECK(source.rewriteLog("0(3) : error C0000: syntax error") ==
          "generated:lib/a.glsl:2: error C0000: syntax error");
    CHECK(source.rewriteLog("ERROR: 0:4: 'void' : syntax error") ==
          "generated:main.frag:2: error: 'void' : syntax error");
    CHECK(source.rewriteLog("WARNING: 0:4: odd") == "generated:main.frag:2: warning: odd");
    CHECK(source.rewriteLog("ERROR: 1 compilation errors.\n\n0:99(1): error: beyond\n") ==
          "ERROR: 1 compilation errors.\n\n0:99(1): error: beyond");
    const shoal::Location first = source.firstLocation("error: none\n0:4(2): error: x\n0:3(1): error: y\n");
    CHECK(first.file == "generated:main.frag");
    CHECK(first.line == 2);
    CHECK(first.column == 2);
    CHECK(source.firstLocation("nothing here").empty());
}

TEST_CASE("an error goes before the warnings above it", "[shader]") {
    const ShaderSource source = resolve({{"main.frag", "float a;\nfloat b;\nfloat c\n"}}, "main.frag");
    // line n of the text is line n - 1 of the file
    for (const char* log : {"0:2(1): warning: `a' used uninitialized\n0:4(9): error: syntax error\n",
                            "0(2) : warning C7050: \"a\" might be used\n0(4) : error C0000: syntax error",
                            "WARNING: 0:2: 'a' : odd\nERROR: 0:4: '' : syntax error\nERROR: 0:3: more"}) {
        INFO(log);
        CHECK(source.firstLocation(log).line == 3);
    }
    CHECK(source.firstLocation("0:3(1): warning: odd\n0:2(1): warning: too\n").line == 2);
}

TEST_CASE("declared uniforms are found, and nothing else", "[shader]") {
    const auto names = declared(
        "uniform highp sampler2D position, velocity;\n"
        "uniform vec4 list[COUNT];\n"
        "layout(std140) uniform Types { vec4 row; float tail; } types;\n"
        "in vec2 uv;\n"
        "float uniformly;\n",
        "uniform");
    for (const char* name : {"position", "velocity", "list", "Types", "row", "tail", "types"}) {
        INFO(name);
        CHECK(names.count(name) == 1);
    }
    for (const char* name : {"uv", "uniformly"}) {
        INFO(name);
        CHECK(names.count(name) == 0);
    }
}

TEST_CASE("declared storage blocks are found, uniforms are not among them", "[shader]") {
    const auto names = declared(
        "layout(std430) readonly buffer Positions { vec4 position[]; };\n"
        "layout(std430) buffer writeonly Sums { float sums[]; } out1;\n"
        "uniform samplerBuffer part;\n"
        "uniform Types { vec4 types[2]; };\n"
        "float buffered;\n",
        "buffer");
    for (const char* name : {"Positions", "position", "Sums", "sums", "out1"}) {
        INFO(name);
        CHECK(names.count(name) == 1);
    }
    for (const char* name : {"part", "Types", "buffered"}) {
        INFO(name);
        CHECK(names.count(name) == 0);
    }
    CHECK(declared("layout(std430) buffer Positions { vec4 position[]; };", "uniform").empty());
}

TEST_CASE("the file that a program names may exist in memory only", "[shader]") {
    const ShaderSource source =
        resolveShader("nowhere", "generated/kernel.comp", {"SIZE 64"},
                      {{"generated/kernel.comp", "#include \"lib/a.glsl\"\nvoid main() {}\n"},
                       {"lib/a.glsl", "float a;\n#include \"generated/kernel.comp\"\n"}},
                      header430());
    CHECK(source.text == "#version 430 core\n#define SIZE 64\nfloat a;\nvoid main() {}\n");
    CHECK(origin(source, 3) == "generated:lib/a.glsl:1");
    CHECK(origin(source, 4) == "generated:generated/kernel.comp:2");
}
