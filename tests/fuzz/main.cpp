// Damaged files: every reader succeeds or throws a located Error; it never crashes, hangs, takes memory
// without measure or throws anything else. Worth most when built with the sanitizers (`./dev fuzz`).
//
//   shoal-fuzz [--kind NAME] [--count N] [--seconds S] [--seed N]
//
// Each kind reads at most N inputs and takes its share of S. The input being read lies in the folder that is
// printed first: after a crash it is the one that did it. Input i of a seed is always the same.
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include "author/from_mesh.h"
#include "compile/plan.h"
#include "core/image.h"
#include "fuzz/mutate.h"
#include "geometry/mesh.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "scene/field_files/field_file.h"
#include "scene/field_kinds.h"
#include "scene/json/scene_file.h"
#include "scene/placement.h"
#include "simulate/checkpoint.h"
#include "simulate/checkpoint_head.h"
#include "support/gltf_text.h"
#include "support/scratch.h"
#include "support/small_scene.h"
#include "support/vti_text.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr unsigned longestSeconds = 60;   // for one input
constexpr long mostKilobytes = 3l << 20;  // of this process, at any time
constexpr int mostCompiled = 2000;        // molecules of a scene that is compiled as well
const std::string sources = SHOAL_SOURCE_DIR "/";

// One seed: how it is damaged and under which name it is read.
struct Seed {
    std::string name, bytes;
    bool text = true;
};

struct Kind {
    const char* name;
    std::vector<Seed> seeds;
    std::function<void(const std::string& file, const std::string& bytes)> read;
    std::function<void(std::string& bytes, Random& random)> mend = {};  // so that checksums fit again
};

// ---- Molecules and scenes

void readOneMolecule(const std::string& file, const std::string& bytes) {
    const Molecule molecule = parseMolecule(bytes, file);
    check(molecule);
    // what is read can be written, and read again
    parseMolecule(writeMolecule(molecule), file);
}

Kind molecules() {
    Kind kind{"molecules", {{"small.json", smallMolecule}}, readOneMolecule};
    for (const char* name : {"quad", "leaf", "fish", "minnow", "berry"})
        kind.seeds.push_back({concat(name, ".json"), readFile(sources + "molecules/" + name + ".json")});
    return kind;
}

void readOneScene(const std::string& file, const std::string& bytes) {
    const Scene scene = parseScene(bytes, file);
    int count = 0;
    for (size_t g = 0; g < scene.groups.size() && count <= mostCompiled; ++g)
        count += scene.groups[g].life ? scene.groups[g].life->capacity : scene.groups[g].count;
    if (count <= mostCompiled) compile(scene);
}

Kind scenes(const Scratch& scratch) {
    writeSmallScene(scratch);
    Kind kind{"scenes", {{scratch.path("small.scene.json"), smallScene}}, readOneScene};
    for (const char* name : {"hello/hello", "panes/panes", "bees/bees", "fountain/fountain"}) {
        const std::string file = sources + "models/" + name + ".scene.json";
        kind.seeds.push_back({file, readFile(file)});
    }
    return kind;
}

// Scenes through the command: it ends by itself, and nothing that it exports is not a number. The names are
// ours, and need no quotes.
void runOneScene(const std::string& file, const std::string&) {
    const std::string exported = file + ".csv", said = file + ".txt";
    const int status =
        std::system(concat("SHOAL_CACHE=", file, ".cache timeout ", longestSeconds, " " SHOAL_COMMAND " run ",
                           file, " --headless --frames 2 --count 20 --export ", exported, " >", said, " 2>&1")
                        .c_str());
    if (!WIFEXITED(status) || WEXITSTATUS(status) > 2)
        throw std::runtime_error(concat("the command ended with status ", status, ": ", readFile(said)));
    if (WEXITSTATUS(status) != 0) throw Error(Location{file, 0, 0, {}}, readFile(said));
    std::istringstream lines(readFile(exported));
    for (std::string line; std::getline(lines, line);)
        if (line.find("nan") != std::string::npos || line.find("inf") != std::string::npos)
            throw std::runtime_error("not a number in an export: " + line);
}

Kind runs(const Scratch& scratch) {
    writeSmallScene(scratch);
    return {"runs", {{scratch.path("run.scene.json"), smallScene}}, runOneScene};
}

// ---- Fields, images, checkpoints, meshes

std::string little(uint64_t number, size_t bytes) {
    return {reinterpret_cast<const char*>(&number), bytes};
}

std::string floats(const std::vector<float>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

Kind fields(const Scratch& scratch) {
    scratch.write("wind.raw.json", R"({"format": "shoal-field-1", "resolution": [2, 1, 1]})");
    Kind kind{"fields", {{"wind.fga", smallField}}, [&scratch](const std::string& file, const std::string&) {
                  GridField field;
                  field.source.bounds = Box{{0, 0, 0}, {1, 1, 1}};
                  addFrame(field, readFieldFile(file, field.source, scratch.path("wind.raw.json")), file);
              }};
    const std::vector<glm::dvec3> values(24, {1, -2, 0.5});
    using Format = VtiText::Format;
    for (const Format format : {Format::ascii, Format::binary, Format::appendedRaw, Format::appendedBase64})
        for (const bool zlib : {false, true})
            if (format != Format::ascii || !zlib)
                kind.seeds.push_back({"wind.vti", VtiText{.format = format, .zlib = zlib}.write(values),
                                      format != Format::appendedRaw});
    kind.seeds.push_back(
        {"wind.vf", "VF_V" + little(2, 2) + little(1, 2) + little(1, 2) + floats({1, 2, 3, 4, 5, 6}), false});
    kind.seeds.push_back({"wind.raw", floats({1, 2, 3, 4, 5, 6}), false});
    return kind;
}

uint32_t crcOf(std::string_view bytes) {
    return uint32_t(::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), uInt(bytes.size())));
}

// Makes the checksums of a PNG's chunks fit again, or the decoder sees none of the damage.
void mendPng(std::string& bytes, Random& random) {
    if (below(random, 4) == 0) return;
    for (size_t at = 8; at + 12 <= bytes.size();) {
        const auto byte = [&](size_t i) { return size_t(uint8_t(bytes[at + i])); };
        const size_t length = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
        if (length > bytes.size() - at - 12) return;
        const uint32_t crc = crcOf(std::string_view(bytes).substr(at + 4, length + 4));
        for (size_t i = 0; i < 4; ++i)
            bytes[at + 8 + length + i] = char(crc >> (24 - 8 * i) & 0xff);
        at += length + 12;
    }
}

Kind images() {
    Kind kind{"images",
              {},
              [](const std::string& file, const std::string& bytes) {
                  decodePng(bytes, file);
                  decodeHeightPng(bytes, file);
              },
              mendPng};
    for (const int channels : {1, 2, 3, 4}) {
        Image image;
        image.width = 5;
        image.height = 7;
        image.channels = channels;
        for (int i = 0; i < image.width * image.height * channels; ++i)
            image.pixels.push_back(uint8_t(i * 7));
        const std::vector<std::byte> png = encodePng(image);
        kind.seeds.push_back({"image.png", {reinterpret_cast<const char*>(png.data()), png.size()}, false});
    }
    return kind;
}

// Makes the checksum of a checkpoint's head fit again (simulate/checkpoint.h).
void mendCheckpoint(std::string& bytes, Random& random) {
    constexpr size_t start = 24;
    uint32_t version = 0;
    uint64_t length = 0;
    if (bytes.size() < start || below(random, 4) == 0) return;
    std::memcpy(&version, bytes.data() + 12, sizeof version);
    std::memcpy(&length, bytes.data() + 16, sizeof length);
    if (length > bytes.size() - start || bytes.size() - start - length < 8) return;
    checkpoint::Checksum sum;
    sum.add(version);
    sum.add(length);
    sum.add(bytes.data() + start, size_t(length));
    const uint64_t fitting = sum.sum();
    std::memcpy(bytes.data() + start + length, &fitting, sizeof fitting);
}

Kind checkpoints(const Scratch& scratch) {
    auto plan = std::make_shared<Plan>(compile(readScene(writeSmallScene(scratch))));
    Checkpoint start;
    start.parameters = parametersOf(*plan);
    for (const GroupPlan& group : plan->groups)
        start.state.groups.push_back(group.start);
    writeCheckpoint(scratch / "start.shoal", *plan, start);
    return {"checkpoints",
            {{"run.shoal", readFile(scratch / "start.shoal"), false}},
            [plan](const std::string& file, const std::string&) { readCheckpoint(file, *plan); },
            mendCheckpoint};
}

void readOneMesh(const std::string& file, const std::string& bytes) {
    const Mesh mesh = loadMesh(file);
    if (bytes.size() % 8 != 0) return;  // of one in eight, a molecule as well
    const MadeMolecule made = makeMolecule(mesh, {});
    parseMolecule(writeMolecule(made.molecule), file);
}

Kind meshes() {
    static constexpr const char* corners[] = {"0 0 0", "1 0 0", "1 1 0", "0 1 0",
                                              "0 0 1", "1 0 1", "1 1 1", "0 1 1"};
    static constexpr std::array<std::array<int, 4>, 6> faces = {
        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
    std::string
        obj = "o box\n",
        off = "OFF\n8 6 0\n", stl = "solid box\n",
        ply =
            "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
    std::string bytesOfPly = ply;
    bytesOfPly.replace(bytesOfPly.find("ascii"), 5, "binary_little_endian");
    for (const char* corner : corners) {
        obj += concat("v ", corner, "\n");
        off += concat(corner, "\n");
        ply += concat(corner, "\n");
        float p[3];
        std::sscanf(corner, "%f %f %f", &p[0], &p[1], &p[2]);
        bytesOfPly += floats({p[0], p[1], p[2]});
    }
    for (const auto& f : faces) {
        const std::string indices = concat(f[0], " ", f[1], " ", f[2], " ", f[3]);
        obj += concat("f ", f[0] + 1, " ", f[1] + 1, " ", f[2] + 1, " ", f[3] + 1, "\n");
        off += concat("4 ", indices, "\n");
        ply += concat("4 ", indices, "\n");
        bytesOfPly += '\4';
        for (const int index : f)
            bytesOfPly += little(uint32_t(index), 4);
        for (const std::array<int, 3> t : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
            stl += "facet normal 0 0 0\nouter loop\n";
            for (const int corner : t)
                stl += concat("vertex ", corners[corner], "\n");
            stl += "endloop\nendfacet\n";
        }
    }
    stl += "endsolid box\n";
    const std::string rich =
        "ply\nformat ascii 1.0\ncomment TextureFile none.png\nelement vertex 4\nproperty double x\n"
        "property double y\nproperty double z\nproperty uchar red\nproperty uchar green\nproperty uchar "
        "blue\n"
        "element face 2\nproperty list ushort int vertex_index\nproperty list uchar float texcoord\n"
        "property int texnumber\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0 9 9 9\n"
        "3 0 1 2 6 0 0 1 0 1 1 0\n4 0 1 2 3 8 0 0 1 0 1 1 0 1 1\n5 0 1 2 -1 3\n";
    GltfText gltf;
    gltf.points(boxPoints);
    gltf.indices(boxTriangles);
    gltf.add(std::vector<uint8_t>(32, 0), "VEC4", 5121, 4);
    gltf.floats(std::vector<float>(32, 0.25f), "VEC4", 4);
    gltf.addView(std::vector<uint8_t>{3, 5});
    gltf.addView(std::vector<float>{2, 2, 0, 1, 0, 1});
    gltf.addAccessor(0, 8, "VEC3", 5126, R"(, "sparse": {"count": 2, "indices": {"bufferView": 4,
        "componentType": 5121}, "values": {"bufferView": 5}})");
    const std::string parts = R"("extensionsUsed": ["EXT_mesh_gpu_instancing", "KHR_x"], "scene": 0,
        "scenes": [{"nodes": [0, 2]}], "skins": [{"joints": [0, 1]}], "nodes": [{"children": [1]},
        {"mesh": 0, "skin": 0, "scale": [1, 0.5, -1]}, {"mesh": 0, "rotation": [0, 0, 1, 0], "extensions":
        {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}}], "materials": [{"alphaMode":
        "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
        "images": [{"bufferView": 2}], "meshes": [{"weights": [0.5], "primitives": [{"attributes": {
        "POSITION": 4, "JOINTS_0": 2, "WEIGHTS_0": 3}, "targets": [{"POSITION": 0}], "indices": 1, "material": 0}]}])";
    return {"meshes",
            {{"box.gltf", gltf.text(parts)},
             {"box.glb", gltf.binary(parts), false},
             {"box.obj", obj},
             {"box.off", off},
             {"box.stl", stl},
             {"box.ply", ply},
             {"bytes.ply", bytesOfPly, false},
             {"rich.ply", rich}},
            readOneMesh};
}

// ---- The driver

// The file of the current input, for the signal handler to name.
char currentInput[4096];

[[noreturn]] void tooLong(int) {
    const char said[] = "\nshoal-fuzz: an input took too long: ";
    [[maybe_unused]] ssize_t written = ::write(2, said, sizeof said - 1);
    written = ::write(2, currentInput, std::strlen(currentInput));
    written = ::write(2, "\n", 1);
    ::_exit(3);
}

std::string inputOf(const Kind& kind, const Seed& seed, Random& random) {
    std::string bytes = seed.text ? mutateText(seed.bytes, random) : mutateBytes(seed.bytes, random);
    if (kind.mend) kind.mend(bytes, random);
    return bytes;
}

struct Counts {
    int read = 0, refused = 0, failed = 0;
};

// Why the reader failed; nothing when it read the input or refused it as it should.
std::optional<std::string> failure(const Kind& kind, const std::string& file, const std::string& bytes,
                                   Counts& counts) {
    try {
        kind.read(file, bytes);
        ++counts.read;
    } catch (const Error& error) {
        ++counts.refused;
        if (error.message().empty()) return "an error without a message";
        if (error.location().empty() && std::strcmp(kind.name, "meshes") != 0)
            return "an error without a place: " + error.message();
    } catch (const std::exception& other) {
        return std::string("threw something else: ") + other.what();
    }
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    if (used.ru_maxrss > mostKilobytes) return concat("took ", used.ru_maxrss, " kB of memory");
    return {};
}

Counts fuzz(const Kind& kind, const Scratch& scratch, uint64_t seed, int count, double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto until = Clock::now() + std::chrono::duration<double>(seconds);
    Counts counts;
    for (int i = 0; i < count && Clock::now() < until; ++i) {
        Random random(seed, uint64_t(i));
        const Seed& chosen = kind.seeds[below(random, kind.seeds.size())];
        const std::string bytes = inputOf(kind, chosen, random);
        // A scene is read as if it lay where its files are.
        const bool absolute = chosen.name.front() == '/';
        const bool there = absolute && std::strcmp(kind.name, "scenes") == 0;
        const std::string input =
            absolute && !there
                ? chosen.name
                : scratch.path("input-" + std::filesystem::path(chosen.name).filename().string());
        std::snprintf(currentInput, sizeof currentInput, "%s", input.c_str());
        writeFile(input, bytes);
        ::alarm(longestSeconds);
        const std::optional<std::string> why = failure(kind, there ? chosen.name : input, bytes, counts);
        ::alarm(0);
        if (!why) continue;
        ++counts.failed;
        const std::string kept = concat("fuzz-", kind.name, "-", seed, "-", i,
                                        std::filesystem::path(chosen.name).extension().string());
        writeFile(kept, bytes);
        std::fprintf(stderr, "%s, input %d: %s (kept as %s)\n", kind.name, i, why->c_str(), kept.c_str());
    }
    return counts;
}

struct Arguments {
    std::string kind;
    int count = 5000;
    double seconds = 1e9;
    uint64_t seed = 1;
};

Arguments argumentsOf(int argc, char** argv) {
    Arguments out;
    for (int i = 1; i < argc; i += 2) {
        const std::string option = argv[i];
        if (i + 1 == argc)
            throw Error("expected [--kind NAME] [--count N] [--seconds S] [--seed N], found " + option);
        const std::string value = argv[i + 1];
        if (option == "--kind")
            out.kind = value;
        else if (option == "--count")
            out.count = std::stoi(value);
        else if (option == "--seconds")
            out.seconds = std::stod(value);
        else if (option == "--seed")
            out.seed = std::stoull(value);
        else
            throw Error("unknown option " + option);
    }
    return out;
}

int fuzzAll(const Arguments& arguments) {
    const Scratch scratch;
    std::printf("the input being read lies in %s\n", scratch.folder().c_str());
    std::vector<Kind> kinds = {molecules(), scenes(scratch),      runs(scratch), fields(scratch),
                               images(),    checkpoints(scratch), meshes()};
    if (!arguments.kind.empty())
        std::erase_if(kinds, [&](const Kind& kind) { return arguments.kind != kind.name; });
    if (kinds.empty()) throw Error("no such kind: " + arguments.kind);
    std::signal(SIGALRM, tooLong);
    int failed = 0, good = 0;
    for (const Kind& kind : kinds) {
        const Counts n =
            fuzz(kind, scratch, arguments.seed, arguments.count, arguments.seconds / double(kinds.size()));
        const int inputs = n.read + n.refused;
        std::printf("%-12s %6d inputs: %d read, %d refused, %d failed\n", kind.name, inputs, n.read,
                    n.refused, n.failed);
        std::fflush(stdout);
        // damage that nobody notices, or that leaves nothing to read, tries nothing
        const bool tried = inputs < 200 || (n.read > 0 && n.refused > inputs / 20);
        if (!tried) std::fprintf(stderr, "%s: these inputs try nothing\n", kind.name);
        failed += n.failed + (tried ? 0 : 1);
        good += inputs > 0 && n.failed == 0;
    }
    std::printf("%d passed, %d failed\n", good, failed);
    return failed == 0 && good == int(kinds.size()) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return fuzzAll(argumentsOf(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shoal-fuzz: %s\n", error.what());
        return 2;
    }
}
