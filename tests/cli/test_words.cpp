// Scenes by their names, exit codes, help, and what is installed beside the command.
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

const Surroundings noDisplay{.environment = {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}}};

// The first word of each line.
std::vector<std::string> namesIn(const std::string& list) {
    std::vector<std::string> out;
    std::istringstream lines(list);
    for (std::string line; std::getline(lines, line);)
        out.push_back(line.substr(0, line.find(' ')));
    return out;
}

}  // namespace

TEST_CASE("scenes are listed without a display, and each is called as it is listed", "[cli]") {
    const Outcome list = runShoal({"scenes"}, noDisplay);
    CHECK(list.code == 0);
    CHECK(list.err.empty());
    CHECK_THAT(list.out,
               Catch::Contains("hello/hello") && Catch::Contains("Twenty leaves fall onto a plane"));
    CHECK(runShoal({"run"}, noDisplay).out == list.out);
    const std::vector<std::string> names = namesIn(list.out);
    CHECK(names.size() >= 14);
    for (const std::string& name : names)
        CHECK(std::filesystem::exists(sourceFile("models/" + name + ".scene.json")));
    // those of the README
    const std::string readme = readFile(sourceFile("README.md"));
    size_t last = 0;
    for (const std::string& name : names) {
        const size_t at = readme.find("`" + name + "`", readme.find("| scene in `models` |"));
        if (at == std::string::npos) {
            CHECK_THAT(readme, Catch::Contains("models/" + name + ".scene.json"));
            continue;
        }
        INFO(name << " stands elsewhere in the README's table");
        CHECK(at > last);
        last = at;
    }
    for (const std::string& name : names)  // for the window's chooser
        CHECK(std::filesystem::exists(sourceFile("models/" + name + ".scene.png")));

    const Scratch scratch;
    scratch.write("own/a.scene.json", R"({"name": "of its own"})");
    CHECK(runShoal({"scenes", scratch.path("own")}).out ==
          scratch.path("own/a.scene.json") + "  of its own\n");
    CHECK(runShoal({"run", scratch.path("own")}, noDisplay).out ==
          runShoal({"scenes", scratch.path("own")}).out);
    refusal({"scenes", scratch.path("none")}, "there is no scene");
}

TEST_CASE("what files may say is printed", "[cli]") {
    const std::string all = runShoal({"keys"}, noDisplay).out;
    CHECK_THAT(all, Catch::Contains("scene.groups[].emitters[]: ") &&
                        Catch::Contains("molecule.springs[]: ") && Catch::Contains("layout: "));
    CHECK_THAT(runShoal({"keys", "gust"}, noDisplay).out,
               Catch::Contains("type \"gust\"") && Catch::Contains("  frontSpeed: number, m/s; "));
    CHECK_THAT(
        runShoal({"keys", "softness"}, noDisplay).out,
        Catch::Contains("scene.groups[].particle\n  softness: ") && Catch::Contains("Only with `blend`"));
    const Outcome wrong = runShoal({"keys", "softnes"}, noDisplay);
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("did you mean \"softness\"?"));
}

TEST_CASE("a scene that ships goes by its name", "[cli]") {
    const Scratch scratch;
    const Surroundings elsewhere{.folder = scratch.path("")};
    const std::string plan = runShoal({"explain", sourceFile("models/hello/hello.scene.json")}).out;
    CHECK(runShoal({"explain", "hello"}, elsewhere).out == plan);
    CHECK(runShoal({"explain", "hello/hello"}, elsewhere).out == plan);
    CHECK_THAT(
        runShoal({"check", "tree/leaves", "sweets"}, elsewhere).out,
        Catch::Contains("tree/leaves.scene.json: scene") && Catch::Contains("jar/sweets.scene.json: scene"));
    const Outcome run =
        runShoal({"run", "hello", "--headless", "--frames", "8", "--size", "64x64"}, elsewhere);
    CHECK(run.code == 0);
    CHECK_THAT(run.out, Catch::Contains("pictures: pictures/hello, 8 pictures\n"));
    CHECK_THAT(run.err, Catch::Contains("frames: 7 of 8, ") && Catch::Contains(" left\n"));
    refusal({"run", "leaves", "--headless"}, "say birdbath/leaves or tree/leaves", elsewhere);
    refusal({"run", "helo", "--headless"}, "(did you mean \"hello\"?); shoal scenes lists them", elsewhere);
    refusal({"check", "helo"}, "helo: no such file", elsewhere);
    // a file goes before a name
    scratch.write("hello", "no JSON");
    refusal({"explain", "hello"}, "hello:1:1: ", elsewhere);
}

TEST_CASE("exit code 2 is a wrong command line, 1 a run that failed", "[cli]") {
    const Scratch scratch;
    const std::string bad = scratch.write("bad.scene.json", "{");
    struct Case {
        int code;
        Words words;
    };
    const std::string scene = squaresScene();
    const Case cases[] = {
        {2, {}},
        {2, {"rn"}},
        {2, {"molecule"}},
        {2, {"molecule", "shw"}},
        {2, {"run", scene, "--headles"}},
        {2, {"run", scene, scene}},
        {2, {"run", scene, "--frames"}},
        {2, {"run", scene, "--frames", "x"}},
        {2, {"run", scene, "--frames", "0"}},
        {2, {"run", scene, "--context", "egll"}},
        {2, {"run", scene, "--headless", "--context", "window"}},
        {2, {"run", scene, "--capture", "x.gif"}},
        {2, {"run", scene, "--save-frames", "1"}},
        {2, {"run", "--headless"}},
        {2, {"run", scratch.path(""), "--headless"}},
        {2, {"run", scene, "--headless", "--frames", "2", "--export", "x.csv", "--export-frames", "3"}},
        {2, {"check"}},
        {2, {"explain"}},
        {2, {"explain", scene, "--path", "ping-pong", "--shader"}},
        {2, {"measure"}},
        {2, {"measure", scene, "--solvers", "eulr"}},
        {2, {"bench", "nope"}},
        {2, {"bench", "sort", "--only", "x"}},
        {2, {"field", scene, "--slice", "w"}},
        {2, {"molecule", "from-mesh", "x.obj", "--springs", "x"}},
        {1, {"run", scratch.path("none.scene.json"), "--headless"}},
        {1, {"run", "nosuchscene", "--headless"}},
        {1, {"run", bad, "--headless"}},
        {1, {"run", scene, "--headless", "--frames", "1", "--capture", "/dev/null/x"}},
        {1, {"run", scene, "--headless", "--resume", bad}},
        {1, {"check", bad}},
        {1, {"explain", bad}},
        {1, {"measure", bad}},
        {1, {"field", scratch.path("none.obj")}},
        {1, {"scenes", scratch.path("none")}},
        {1, {"molecule", "from-mesh", scratch.path("none.obj")}},
        {0, {"--help"}},
        {0, {"run", "--help"}},
        {0, {"--version"}},
        {0, {"check", scene}},
    };
    for (const Case& one : cases) {
        const Outcome outcome = runShoal(one.words, {.folder = scratch.path("")});
        std::string shown;
        for (const std::string& word : one.words)
            shown += " " + word;
        INFO("shoal" << shown << "\n" << outcome.err);
        CHECK(outcome.code == one.code);
        CHECK(outcome.messages().size() == (one.code == 0 ? 0 : 1));
    }
    const std::string help = std::regex_replace(runShoal({"--help"}).out, std::regex("\\s+"), " ");
    CHECK_THAT(help, Catch::Contains("2 when the command line is wrong"));
}

TEST_CASE("messages point to the help of the command they are of", "[cli]") {
    refusal({"rn"}, "; see shoal --help");
    refusal({"run", squaresScene(), "--headles"}, "; see shoal run --help");
    refusal({"check"}, "; see shoal check --help");
    refusal({"molecule", "shw"}, "; see shoal molecule --help");
    refusal({"molecule", "show", "x.json", "--captur", "x.png"}, "; see shoal molecule show --help");
    refusal({"bench", "nope"}, "expected one of sort, collide, particles, school");
}

TEST_CASE("help is in groups, and every option of it is on the man page and completed", "[cli]") {
    const std::string help = runShoal({"run", "--help"}).out;
    for (const char* group :
         {"In place of what the scene says:", "How it runs:", "Pictures:", "State:", "Window:"})
        CHECK_THAT(help, Catch::Contains(std::string("\n") + group));
    const std::string page = runShoal({"--man-page"}).out, bash = runShoal({"--bash-completion"}).out;
    CHECK_THAT(page, Catch::Contains(".TH SHOAL 1") && Catch::Contains(".SS shoal molecule from\\-mesh"));
    for (const Words& command :
         {Words{"run"}, Words{"measure"}, Words{"bench"}, Words{"field"}, Words{"edit"}, Words{"explain"},
          Words{"check"}, Words{"info"}, Words{"molecule", "from-mesh"}}) {
        Words words = command;
        words.push_back("--help");
        std::istringstream text(runShoal(words).out);
        for (std::string word; text >> word;) {
            word = word.substr(0, word.find_first_of("=,:"));
            if (word.rfind("--", 0) != 0 || word == "--help") continue;
            std::string escaped;
            for (const char c : word)
                escaped += c == '-' ? "\\-" : std::string(1, c);
            INFO(command[0] << " " << word);
            CHECK(page.find(escaped) != std::string::npos);
            CHECK(bash.find(word) != std::string::npos);
        }
    }
}

TEST_CASE("bash completes commands, options, their words and scenes, and expands no name", "[cli]") {
    if (std::system("bash --version >/dev/null 2>&1") != 0) {
        WARN("skipped: bash is not installed");
        return;
    }
    const Scratch scratch;
    scratch.write("completion", runShoal({"--bash-completion"}).out);
    std::filesystem::create_directories(scratch / "data/shaders/passes");
    scratch.write("data/shaders/passes/advect.frag", "");
    scratch.write("data/models/$(touch pwned).scene.json", "{}");
    scratch.write("data/models/hello/hello.scene.json", "{}");
    const auto completed = [&](const std::string& words) {
        const std::string script =
            "source completion; COMP_WORDS=(" + words +
            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _shoal 2>/dev/null; printf '%s\\n' "
            "\"${COMPREPLY[@]}\" > out";
        scratch.write("script", script);
        CHECK(std::system(
                  ("cd '" + scratch.path("") + "' && SHOAL_DATA='" + scratch.path("data") + "' bash script")
                      .c_str()) == 0);
        std::istringstream lines(readFile(scratch / "out"));
        std::set<std::string> out;
        for (std::string line; std::getline(lines, line);)
            out.insert(line);
        return out;
    };
    const std::string shoal = SHOAL_COMMAND;
    CHECK(completed(shoal + " me") == std::set<std::string>{"measure"});
    CHECK(completed(shoal + " molecule ''") == std::set<std::string>{"--help", "from-mesh", "new", "show"});
    CHECK(completed(shoal + " run hello --conte") == std::set<std::string>{"--context"});
    CHECK(completed(shoal + " run hello --context e") == std::set<std::string>{"egl"});
    CHECK(completed(shoal + " bench c") == std::set<std::string>{"collide"});
    CHECK(completed(shoal + " run h") == std::set<std::string>{"hello/hello"});
    CHECK(completed(shoal + " run '$'").size() == 1);
    CHECK_FALSE(std::filesystem::exists(scratch / "pwned"));
}

TEST_CASE("docs/command.md has every option of every command as it is declared, and nothing more", "[cli]") {
    const std::string page = readFile(sourceFile("docs/command.md")), mark = "<!-- shoal --markdown -->\n";
    const size_t at = page.find(mark);
    REQUIRE(at != std::string::npos);
    INFO("to renew it, put what shoal --markdown prints behind the mark");
    CHECK(page.substr(at + mark.size()) == runShoal({"--markdown"}).out);
}
