// Tests what the command says about itself, and about words that it does not know.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "cli/shoal_command.h"
#include "core/parallel.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("version and help", "[cli]") {
    const Outcome version = runShoal({"--version"});
    CHECK(version.code == 0);
    CHECK(version.out.rfind("shoal ", 0) == 0);
    CHECK(version.err.empty());

    const Outcome help = runShoal({"--help"});
    CHECK(help.code == 0);
    for (const char* command : {"run", "check", "explain", "info", "bench"})
        CHECK_THAT(help.out, Catch::Contains(command));

    const Outcome run = runShoal({"run", "--help"});
    CHECK(run.code == 0);
    for (const char* option : {"--context", "--headless", "--frames", "--dt", "--solver", "--substeps",
                               "--count", "--seed", "--size", "--capture", "--export", "--json"})
        CHECK_THAT(run.out, Catch::Contains(option));
}

TEST_CASE("unknown words are refused with the nearest known one", "[cli]") {
    const std::string scene = squaresScene();
    refusal({}, "subcommand is required");
    refusal({"rn", scene}, "unknown command \"rn\" (did you mean \"run\"?)");
    refusal({"run", scene, "--headles"}, "unknown option --headles (did you mean \"--headless\"?)");
    refusal({"run", scene, "--captur=x"}, "unknown option --captur (did you mean \"--capture\"?)");
    refusal({"explain", scene, "--jsn"}, "did you mean \"--json\"?");
    refusal({"run", "--headless"}, "scene is required");
    refusal({"run", scene, scene}, "scene");
    refusal({"check"}, "files is required");
}

TEST_CASE("values out of range are refused", "[cli]") {
    struct Case {
        const char *option, *value, *message;
    };
    const Case cases[] = {
        {"--size", "160", "--size: expected WIDTHxHEIGHT"},
        {"--size", "0x90", "--size: expected WIDTHxHEIGHT"},
        {"--size", "160x90x3", "--size: expected WIDTHxHEIGHT"},
        {"--size", "160x99999", "each from 1 to 16384"},
        {"--dt", "0", "--dt: expected a time from 1e-5 to 1 s, found \"0\""},
        {"--dt", "-0.1", "--dt: expected a time from 1e-5 to 1 s"},
        {"--dt", "nan", "--dt: expected a time from 1e-5 to 1 s, found \"nan\""},
        {"--dt", "1s", "--dt: expected a time from 1e-5 to 1 s, found \"1s\""},
        {"--solver", "eulr", "unknown solver \"eulr\" (did you mean \"euler\"?)"},
        {"--frames", "0", "--frames: expected a whole number, 1 or more, found \"0\""},
        {"--frames", "1.5", "--frames: expected a whole number, 1 or more, found \"1.5\""},
        {"--frames", "99999999999", "--frames: expected a whole number"},
        {"--substeps", "0", "--substeps: expected a whole number from 1 to 1000, found \"0\""},
        {"--count", "0", "--count: expected a whole number from 1 to 1073741824, found \"0\""},
        {"--context", "egll", "unknown context \"egll\" (did you mean \"egl\"?)"},
        {"--seed", "x", "--seed: expected a whole number"},
        {"--seed", "-1", "--seed: expected a whole number from 0"},
        {"--capture-every", "0", "--capture-every: expected a whole number, 1 or more"},
        {"--export-frames", "-1", "--export-frames: expected a whole number, 0 or more"},
        {"--export-frames", "1,x", "--export-frames: expected a whole number, 0 or more, found \"x\""},
    };
    for (const Case& one : cases)
        refusal({"run", squaresScene(), "--headless", "--capture", "x", "--export", "x.csv",
                 concat(one.option, "=", one.value)},
                one.message);
    refusal({"run", squaresScene(), "--headless", "--frames"}, "--frames");
    refusal(
        {"run", squaresScene(), "--headless", "--frames", "2", "--export", "x.csv", "--export-frames", "3"},
        "frame 3 is beyond the last, 2");
    refusal({"run", squaresScene(), "--headless", "--context", "window"}, "exclude each other");
}

TEST_CASE("a report that cannot be written is an error", "[cli]") {
    Surroundings full;
    full.standardOutput = "/dev/full";
    if (!std::filesystem::exists(full.standardOutput)) {
        WARN("skipped: this system has no /dev/full");
        return;
    }
    for (const Words& words :
         {Words{"--version"}, Words{"--help"}, Words{"info", "--json"},
          Words{"explain", squaresScene(), "--json"}, Words{"check", squaresScene(), "--json"},
          Words{"run", squaresScene(), "--headless", "--frames", "1", "--json"}})
        refusal(words, "standard output cannot be written", full);
}

TEST_CASE("info names each context and why one is missing", "[cli]") {
    const Outcome outcome =
        runShoal({"info", "--json"}, {.environment = {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}}});
    const JsonValue report = outcome.json();
    CHECK_FALSE(member(report, "version").text.empty());
    CHECK_FALSE(member(report, "commit").text.empty());
    const std::vector<JsonValue>& contexts = member(report, "contexts").items;
    REQUIRE(contexts.size() == 3);
    bool any = false;
    for (size_t i = 0; i < 3; ++i) {
        const char* const names[] = {"window", "egl", "osmesa"};
        CHECK(member(contexts[i], "context").text == names[i]);
        if (!member(contexts[i], "available").boolean) {
            CHECK_FALSE(member(contexts[i], "reason").text.empty());
            continue;
        }
        any = true;
        for (const char* key : {"platform", "renderer", "vendor", "version", "glslVersion"})
            CHECK_FALSE(member(contexts[i], key).text.empty());
        CHECK(member(contexts[i], "maxTextureSize").number >= 1024);
        const std::vector<JsonValue>& paths = member(contexts[i], "paths").items;
        const bool fused = member(contexts[i], "computeShaders").boolean;
        REQUIRE(paths.size() == (fused ? 3 : 2));
        CHECK(paths.front().text == (fused ? "fused" : "fragments"));
        CHECK(paths.back().text == "ping-pong");
    }
    CHECK_FALSE(member(contexts[0], "available").boolean);
    CHECK_THAT(member(contexts[0], "reason").text, Catch::Contains("display"));
    CHECK(outcome.code == (any ? 0 : 1));
    CHECK(
        runShoal({"info", "--context", "window"}, {.environment = {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}}})
            .code == 1);
}

TEST_CASE("--gpu takes one of the devices that info lists", "[cli]") {
    const JsonValue report = runShoal({"info", "--json"}).json();
    const std::vector<JsonValue>& devices = member(report, "devices").items;
    const std::string beyond = std::to_string(devices.size());
    refusal({"run", squaresScene(), "--gpu", beyond, "--frames", "1"}, "there is no device " + beyond);
    refusal({"info", "--gpu", beyond}, "there is no device " + beyond);
    refusal({"run", squaresScene(), "--gpu", "-1", "--frames", "1"},
            "--gpu: expected a whole number, 0 or more, found \"-1\"");
    refusal({"run", squaresScene(), "--gpu", "0", "--context", "egl"}, "excludes");
    if (devices.empty()) {
        WARN("skipped: EGL lists no devices here");
        return;
    }
    const JsonValue run = runShoal({"run", squaresScene(), "--gpu", "0", "--frames", "1", "--json"}).json();
    CHECK(member(member(run, "context"), "renderer").text == member(devices[0], "renderer").text);
    const JsonValue alone = runShoal({"info", "--gpu", "0", "--json"}).json();
    CHECK(member(alone, "platform").text == "EGL, device 0");
}

TEST_CASE("a context that cannot be had says what helps", "[cli]") {
    const Surroundings noDisplay{.environment = {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}}};
    const std::string window = refusal({"run", squaresScene(), "--context", "window", "--frames", "1"},
                                       "there is no display", noDisplay);
    CHECK_THAT(window, Catch::Contains("xvfb-run"));

    Surroundings noEgl = noDisplay;
    noEgl.environment["__EGL_VENDOR_LIBRARY_DIRS"] = "/nonexistent";
    noEgl.environment["__EGL_VENDOR_LIBRARY_FILENAMES"] = std::nullopt;
    if (runShoal({"info", "--context", "egl"}, noEgl).code == 0) {
        WARN("skipped: this libEGL takes no notice of __EGL_VENDOR_LIBRARY_DIRS");
        return;
    }
    const std::string egl =
        refusal({"run", squaresScene(), "--context", "egl", "--frames", "1"}, "egl: ", noEgl);
    CHECK_THAT(egl, Catch::Contains("install libegl1"));
    if (!hasContext("osmesa")) return;
    // without EGL, "auto" goes on to OSMesa
    const Outcome other = runShoal({"run", squaresScene(), "--headless", "--frames", "1", "--json"}, noEgl);
    REQUIRE(other.code == 0);
    CHECK(member(member(other.json(), "context"), "kind").text == "osmesa");
}

TEST_CASE("a driver that crashes is told of, and the others are tried", "[cli]") {
    const Scratch scratch;
    const Surroundings crashing{.environment = {{"LD_LIBRARY_PATH", SHOAL_CRASHING_DRIVER},
                                                {"SHOAL_CACHE", scratch.path("cache")},
                                                {"DISPLAY", {}},
                                                {"WAYLAND_DISPLAY", {}}}};
    const std::string crash = "osmesa: its driver crashes when a context is made (Segmentation fault)";
    refusal({"run", squaresScene(), "--context", "osmesa", "--frames", "1"}, crash, crashing);
    const Outcome info = runShoal({"info", "--context", "osmesa"}, crashing);
    CHECK(info.code == 1);
    CHECK_THAT(info.out, Catch::Contains("not available: its driver crashes when a context is made"));
    const JsonValue all = runShoal({"info", "--json"}, crashing).json();
    for (const JsonValue& context : member(all, "contexts").items)
        if (member(context, "context").text == "egl")
            CHECK(member(context, "available").boolean == hasContext("egl"));
    // One that makes a context is tried once.
    if (!hasContext("egl")) return;
    const auto tried = [&] {
        CHECK(runShoal({"explain", squaresScene(), "--cost", "--context", "egl"}, crashing).code == 0);
        const std::vector<std::string> files = filesIn(scratch.path("cache"));
        return std::count_if(files.begin(), files.end(),
                             [](const std::string& file) { return file.ends_with(".driver"); });
    };
    CHECK(tried() == 1);
    CHECK(tried() == 1);
}

namespace {

// An option as the tables of `shoal --markdown` have it.
struct Option {
    Words command;     // "molecule", "new"
    std::string name;  // "--size"
    std::string type;  // "INT", "FLOAT", "a|b", "FILE" …; empty: it takes no value
};

std::vector<Option> allOptions() {
    std::vector<Option> out;
    Words command;
    std::istringstream lines(runShoal({"--markdown"}).out);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("## shoal ", 0) == 0) {
            std::istringstream words(line.substr(9));
            command = Words(std::istream_iterator<std::string>(words), {});
        }
        if (line.rfind("| `-", 0) != 0) continue;
        std::istringstream cell(line.substr(3, line.find("` |") - 3));
        Option option{command, "", ""};
        cell >> option.name >> option.type;
        option.name = option.name.substr(option.name.rfind(',') + 1);
        out.push_back(option);
    }
    return out;
}

// A command line that never comes to run anything: its file is not there, or is there already; or its last
// word is unknown, which is told after what is wrong with an option's value.
Words idle(const Option& option, const std::string& there) {
    Words out = option.command;
    const std::string last = out.back();
    if (last == "new")
        out.push_back(there);
    else if (last == "info" || last == "bench" || last == "edit")
        out.push_back("--no-such");
    else
        out.push_back("nowhere.obj");
    return out;
}

// Whether it was taken, and the command then told what else is wrong.
bool isTaken(const Outcome& outcome) {
    for (const char* later : {"no such file", "nowhere.obj", "is there already", "unknown option --no-such",
                              "say what to write", "requires", "is required"})
        if (outcome.err.find(later) != std::string::npos) return true;
    return false;
}

}  // namespace

TEST_CASE("every option of every command takes what it can use, and names itself when it cannot", "[cli]") {
    const Scratch scratch;
    const std::string there = scratch.write("there.json", "{}");
    const std::vector<Option> options = allOptions();
    REQUIRE(options.size() > 150);
    struct Try {
        const Option* option;
        std::string value;
        bool refused;  // whatever the option is for, this is no value of it
        Outcome outcome = {};
    };
    std::vector<Try> tries;
    for (const Option& option : options) {
        const bool flag = option.type.empty(), word = option.type.find('|') != std::string::npos;
        const bool whole = option.type == "INT" || option.type == "UINT";
        tries.push_back({&option, "", true});
        tries.push_back({&option, "5", flag || word});
        if (flag) continue;
        tries.push_back({&option, "--json", true});
        tries.push_back({&option, "x1", word || whole || option.type == "FLOAT" || option.type == "WxH"});
        if (word) continue;
        tries.push_back({&option, "1e999", whole || option.type == "FLOAT"});
        tries.push_back({&option, "4294967297x1", whole || option.type == "WxH"});
        if (option.type == "FILE" || option.type == "TEXT") continue;
        tries.push_back({&option, "99999999999999999999", whole});
        tries.push_back({&option, "-1", false});
        tries.push_back({&option, "0", option.name == "--divisions" || option.name == "--frames"});
    }
    parallel(int(tries.size()), 4, [&](int i) {
        Try& one = tries[size_t(i)];
        Words words = idle(*one.option, there);
        words.push_back(concat(one.option->name, "=", one.value));
        one.outcome = runShoal(words, {.folder = scratch.folder().string()});
    });
    for (const Try& one : tries) {
        std::string command;
        for (const std::string& word : one.option->command)
            command += word + " ";
        INFO("shoal " << command << one.option->name << "=" << one.value << "\n" << one.outcome.err);
        CHECK(one.outcome.messages().size() == 1);
        CHECK(one.outcome.out.empty());
        const bool named = one.outcome.err.find(one.option->name) != std::string::npos;
        if (one.refused || !isTaken(one.outcome)) CHECK((named && one.outcome.code == 2));
    }
    CHECK(filesIn(scratch.folder().string()) == Words{"there.json"});
}

TEST_CASE("an option of several values leaves the words behind it alone", "[cli]") {
    const Scratch scratch;
    const Surroundings there{.folder = scratch.folder().string()};
    for (const Words& words :
         {Words{"molecule", "from-mesh", "--pin-name", "red", "nowhere.obj"},
          Words{"molecule", "from-mesh", "--pin", "y<0.1", "--pin", "y>0.9", "nowhere.obj"},
          Words{"run", "--save", "s.shoal", "--save-frames", "1,2", "nowhere.obj"},
          Words{"measure", "--solvers", "euler,leapfrog", "nowhere.obj"}})
        CHECK_THAT(runShoal(words, there).err, Catch::Contains("nowhere.obj"));
    refusal({"run", squaresScene(), "--save", "--headless"},
            "--save: expected a value, found the option --headless", there);
    refusal({"run", squaresScene(), "--save=", "--headless"}, "--save: expected a value, found nothing",
            there);
    refusal({"explain", ""}, "scene: expected a value, found nothing", there);
    CHECK(filesIn(scratch.folder().string()).empty());
}
