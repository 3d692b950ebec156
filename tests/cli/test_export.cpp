// `shoal export`: animation textures and glTF, read back by readers that are not ours and compared with the
// CSV files of the same run.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>

#include <OpenEXR/ImfRgbaFile.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <png.h>
#include <assimp/Importer.hpp>

#include "cli/shoal_command.h"
#include "core/file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Colour and alpha in [0, 1], rows from the top.
struct Texels {
    int width = 0, height = 0;
    std::vector<glm::vec4> values;
    const glm::vec4& at(int x, int y) const { return values[size_t(y * width + x)]; }
};

Texels readPng16(const std::string& file) {
    Texels out;
    FILE* stream = std::fopen(file.c_str(), "rb");
    REQUIRE(stream);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, stream);
    png_read_png(png, info, PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
    REQUIRE(png_get_bit_depth(png, info) == 16);
    const int channels = png_get_channels(png, info);
    out.width = int(png_get_image_width(png, info));
    out.height = int(png_get_image_height(png, info));
    png_bytepp rows = png_get_rows(png, info);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            const auto* value = reinterpret_cast<const uint16_t*>(rows[y]) + channels * x;
            out.values.emplace_back(value[0], value[1], value[2], channels == 4 ? value[3] : 65535);
            out.values.back() /= 65535.0f;
        }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(stream);
    return out;
}

struct Row {
    glm::dvec3 place, normal;
};

// Returns the rows of each frame of a run, in the order of its columns.
std::vector<std::vector<Row>> statesOf(const std::string& folder, int frames) {
    std::vector<std::vector<Row>> out;
    for (int frame = 0; frame < frames; ++frame) {
        char name[64];
        std::snprintf(name, sizeof name, "/state-%05d.csv", frame);
        std::istringstream lines(readFile(folder + name));
        std::string line;
        std::getline(lines, line);
        out.emplace_back();
        while (std::getline(lines, line)) {
            Row row;
            double v[3];
            REQUIRE(std::sscanf(line.c_str(), "%*d,%*g,%*d,%*d,%*d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf",
                                &row.place.x, &row.place.y, &row.place.z, v, v + 1, v + 2, &row.normal.x,
                                &row.normal.y, &row.normal.z) == 9);
            out.back().push_back(row);
        }
    }
    return out;
}

std::vector<std::vector<Row>> statesOfHello(const Scratch& scratch, int frames) {
    const std::string folder = scratch.path("csv");
    const Outcome run = runShoal({"run", squaresScene(), "--headless", "--frames", std::to_string(frames - 1),
                                  "--export", folder, "--export-every", "1"});
    INFO(run.err);
    REQUIRE(run.code == 0);
    return statesOf(folder, frames);
}

glm::dvec3 vectorOf(const JsonValue& value) {
    return {value.items.at(0).number, value.items.at(1).number, value.items.at(2).number};
}

// Out of Blender's axes.
glm::dvec3 ours(const glm::dvec3& v) {
    return {v.x, v.z, -v.y};
}

// The first mesh of a file, as Assimp reads it: that of the molecules.
class ReadMesh {
  public:
    explicit ReadMesh(const std::string& file) {
        const aiScene* scene = importer_.ReadFile(file, 0);
        INFO(importer_.GetErrorString());
        REQUIRE(scene);
        mesh_ = scene->mMeshes[0];
        material_ = scene->mMaterials[mesh_->mMaterialIndex];
    }
    const aiMesh& operator*() const { return *mesh_; }
    const aiMesh* operator->() const { return mesh_; }
    const aiMaterial& material() const { return *material_; }
    glm::dvec3 place(size_t i) const {
        return {mesh_->mVertices[i].x, mesh_->mVertices[i].y, mesh_->mVertices[i].z};
    }

  private:
    Assimp::Importer importer_;
    const aiMesh* mesh_ = nullptr;
    const aiMaterial* material_ = nullptr;
};

Outcome exported(Words more) {
    Words words{"export", squaresScene()};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome out = runShoal(words);
    INFO(out.err);
    REQUIRE(out.code == 0);
    return out;
}

}  // namespace

TEST_CASE("an animation texture plays back what the run was", "[cli][export]") {
    const Scratch scratch;
    const int frames = 13, columns = 80;
    const auto states = statesOfHello(scratch, frames);
    const std::string folder = scratch.path("vat");
    const JsonValue report = exported({"--vat", folder, "--frames", std::to_string(frames), "--json"}).json();
    CHECK(filesIn(folder) == std::vector<std::string>{"quad-remap_info.json", "quad.glb", "quad_vat.png"});
    CHECK(member(report, "columns").number == columns);

    const JsonValue file = readJson(folder + "/quad-remap_info.json"), &remap = member(file, "os-remap");
    const glm::dvec3 low = vectorOf(member(remap, "Min")), high = vectorOf(member(remap, "Max"));
    CHECK(member(remap, "Frames").number == frames);
    const JsonValue& clip = member(member(file, "animations"), "quad");
    CHECK(member(clip, "endFrame").number == frames);
    CHECK(member(clip, "framerate").number == 60);
    CHECK_FALSE(member(clip, "looping").boolean);

    const Texels texels = readPng16(folder + "/quad_vat.png");
    REQUIRE(texels.width == columns);
    REQUIRE(texels.height == 2 * frames);
    const ReadMesh mesh(folder + "/quad.glb");
    REQUIRE(mesh->mNumVertices == unsigned(columns));
    REQUIRE(mesh->GetNumUVChannels() == 2);
    const glm::dvec3 step = (high - low) / 65535.0;
    CHECK(member(report, "positionStep").number == Approx(std::max({step.x, step.y, step.z})));
    double worst = 0, turned = 0;
    for (int i = 0; i < columns; ++i) {
        // Assimp turns the second coordinates over.
        const aiVector3D at = mesh->mTextureCoords[1][i];
        const int column = int(at.x * float(columns)), row = int((1 - at.y) * float(2 * frames));
        CHECK(column == i);
        CHECK(row == 0);
        for (int frame = 0; frame < frames; ++frame) {
            const glm::dvec3 share(texels.at(column, frame)), normal(texels.at(column, frames + frame));
            const Row& wanted = states[size_t(frame)][size_t(i)];
            const glm::dvec3 off = mesh.place(size_t(i)) + ours(low + share * (high - low)) - wanted.place;
            worst = std::max(
                {worst, std::abs(off.x) / step.x, std::abs(off.y) / step.z, std::abs(off.z) / step.y});
            turned = std::max(turned, glm::length(ours(2.0 * normal - 1.0) - wanted.normal));
        }
    }
    INFO(worst << " steps, normals " << turned);
    CHECK(worst < 0.6);  // half a step, and the rounding of floats
    CHECK(turned < 1e-4);
}

TEST_CASE("a rigid animation texture turns and moves each molecule", "[cli][export]") {
    const Scratch scratch;
    const int frames = 40, molecules = 20;
    const auto states = statesOfHello(scratch, frames);
    const std::string folder = scratch.path("vat");
    const JsonValue report =
        exported({"--vat", folder, "--frames", std::to_string(frames), "--rigid", "--json"}).json();
    const JsonValue file = readJson(folder + "/quad-remap_info.json"), &remap = member(file, "os-remap");
    CHECK(member(file, "rigid").boolean);
    const glm::dvec3 low = vectorOf(member(remap, "Min")), high = vectorOf(member(remap, "Max"));
    const Texels texels = readPng16(folder + "/quad_vat.png");
    REQUIRE(texels.width == molecules);
    const ReadMesh mesh(folder + "/quad.glb");
    double worst = 0;
    for (int i = 0; i < 4 * molecules; ++i) {
        const int column = int(mesh->mTextureCoords[1][i].x * float(molecules));
        CHECK(column == i / 4);
        for (int frame = 0; frame < frames; ++frame) {
            const glm::vec4 q = 2.0f * texels.at(column, frames + frame) - 1.0f;
            const glm::dquat turn = glm::normalize(glm::dquat(q.w, q.x, q.y, q.z));
            const glm::dvec3 middle = low + glm::dvec3(texels.at(column, frame)) * (high - low);
            worst = std::max(worst, glm::distance(middle + turn * mesh.place(size_t(i)),
                                                  states[size_t(frame)][size_t(i)].place));
        }
    }
    const double residual = member(report, "rigidResidual").number;
    INFO("residual " << residual << ", found " << worst);
    CHECK(residual > 1e-4);  // they bend
    CHECK(worst == Approx(residual).margin(1e-4));
    CHECK(member(report, "rigidResidualRms").number < residual);
}

TEST_CASE("a loop ends where it begins", "[cli][export]") {
    const Scratch scratch;
    const auto jump = [&](const Words& more) {
        Words words{"--vat", scratch.path("vat"), "--first", "4", "--frames", "30"};
        words.insert(words.end(), more.begin(), more.end());
        exported(words);
        const Texels texels = readPng16(scratch.path("vat") + "/quad_vat.png");
        const JsonValue remap = member(readJson(scratch.path("vat") + "/quad-remap_info.json"), "os-remap");
        const glm::dvec3 span = vectorOf(member(remap, "Max")) - vectorOf(member(remap, "Min"));
        double most = 0;
        for (int x = 0; x < texels.width; ++x)
            most = std::max(most, glm::length(glm::dvec3(texels.at(x, 0) - texels.at(x, 29)) * span));
        return most;
    };
    const double open = jump({}), closed = jump({"--loop", "10"});
    INFO("from the last frame to the first " << open << " m, looped " << closed << " m");
    CHECK(open > 0.5);
    CHECK(closed < 0.3 * open);
    CHECK(
        member(member(member(readJson(scratch.path("vat") + "/quad-remap_info.json"), "animations"), "quad"),
               "looping")
            .boolean);
}

TEST_CASE("floats in OpenEXR say the same as 16 bits", "[cli][export]") {
    const Scratch scratch;
    for (const std::string format : {"png", "half", "float"})
        exported({"--vat", scratch.path(format), "--frames", "5", "--texels", format});
    const Texels png = readPng16(scratch.path("png") + "/quad_vat.png");
    for (const std::string format : {"half", "float"}) {
        Imf::RgbaInputFile file((scratch.path(format) + "/quad_vat.exr").c_str());
        const auto box = file.dataWindow();
        REQUIRE(box.max.x + 1 == png.width);
        REQUIRE(box.max.y + 1 == png.height);
        std::vector<Imf::Rgba> pixels(png.values.size());
        file.setFrameBuffer(pixels.data(), 1, size_t(png.width));
        file.readPixels(0, box.max.y);
        double worst = 0;
        for (size_t i = 0; i < pixels.size(); ++i)
            worst = std::max(worst, double(std::max({std::abs(pixels[i].r - png.values[i].x),
                                                     std::abs(pixels[i].g - png.values[i].y),
                                                     std::abs(pixels[i].b - png.values[i].z)})));
        CHECK(worst < 6e-4);  // the reader gives halves
    }
}

TEST_CASE("a skin is exported, and what is too wide for a texture is split", "[cli][export]") {
    const Scratch scratch;
    const std::string scene =
        scratch.write("s.scene.json", R"({"format": "shoal-scene-1", "groups": [{"molecule": ")" +
                                          sourceFile("molecules/minnow.json") +
                                          R"(", "count": 20, "place": {"on": "volume",
        "box": {"low": [-1, 0, -1], "high": [1, 1, 1]}}}]})");
    const std::string folder = scratch.path("vat");
    const Outcome out = runShoal({"export", scene, "--vat", folder, "--frames", "2"});
    INFO(out.err);
    REQUIRE(out.code == 0);
    CHECK(out.out.find("split into 2 textures of at most 16384 columns") != std::string::npos);
    const ReadMesh first(folder + "/minnow.glb"), second(folder + "/minnow-2.glb");
    CHECK(first->mNumVertices == 16 * 974);
    CHECK(second->mNumVertices == 4 * 974);
    CHECK(readPng16(folder + "/minnow_vat.png").width == 16 * 974);
    aiString path;
    CHECK(first.material().GetTexture(aiTextureType_DIFFUSE, 0, &path) == aiReturn_SUCCESS);
}

TEST_CASE("a moment as glTF holds all that is drawn", "[cli][export]") {
    const Scratch scratch;
    const std::string file = scratch.path("scene.glb");
    exported({"--glb", file, "--first", "12"});
    const auto states = statesOfHello(scratch, 13);
    const ReadMesh mesh(file);
    REQUIRE(mesh->mNumVertices == 80);
    REQUIRE(mesh->HasVertexColors(0));
    double worst = 0;
    for (size_t i = 0; i < 80; ++i)
        worst = std::max(worst, glm::distance(mesh.place(i), states[12][i].place));
    CHECK(worst < 1e-5);

    const Outcome tree = runShoal({"export", "autumn", "--glb", scratch.path("tree.glb"), "--count", "50"});
    INFO(tree.err);
    REQUIRE(tree.code == 0);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(scratch.path("tree.glb"), 0);
    REQUIRE(scene);
    std::vector<std::string> names;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i)
        names.emplace_back(scene->mMeshes[i]->mName.C_Str());
    CHECK_THAT(names, Catch::VectorContains(std::string("leaves on the tree")) &&
                          Catch::VectorContains(std::string("tree")));
    CHECK(scene->mNumCameras == 1);
    CHECK(scene->mNumTextures > 0);
}

namespace {

// The samples of an attribute of three numbers, by time.
std::map<int, std::vector<glm::dvec3>> samplesIn(const std::string& text, const std::string& attribute) {
    std::map<int, std::vector<glm::dvec3>> out;
    size_t at = text.find(attribute + ".timeSamples = {\n");
    REQUIRE(at != std::string::npos);
    std::istringstream lines(text.substr(at));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.find('}') == std::string::npos) {
        std::vector<glm::dvec3>& values = out[std::atoi(line.c_str())];
        glm::dvec3 v;
        for (const char* c = line.c_str(); (c = std::strchr(c, '(')) != nullptr; ++c) {
            REQUIRE(std::sscanf(c, "(%lf,%lf,%lf)", &v.x, &v.y, &v.z) == 3);
            values.push_back(v);
        }
    }
    return out;
}

void compare(const std::map<int, std::vector<glm::dvec3>>& samples,
             const std::vector<std::vector<Row>>& states, glm::dvec3 Row::*value, double within) {
    REQUIRE(samples.size() == states.size());
    double worst = 0;
    for (const auto& [frame, values] : samples) {
        REQUIRE(values.size() == states[size_t(frame)].size());
        for (size_t i = 0; i < values.size(); ++i)
            worst = std::max(worst, glm::distance(values[i], states[size_t(frame)][i].*value));
    }
    CHECK(worst < within);
}

}  // namespace

TEST_CASE("USD holds the run, in one file or a file a frame", "[cli][export]") {
    const Scratch scratch;
    const int frames = 9;
    const auto states = statesOfHello(scratch, frames);
    const std::string file = scratch.path("run.usda"), folder = scratch.path("clips");
    exported({"--usd", file, "--frames", std::to_string(frames)});
    const std::string text = readFile(file);
    for (const char* part :
         {"metersPerUnit = 1", "upAxis = \"Y\"", "endTimeCode = 8", "def Camera \"camera\"",
          "def Mesh \"quad\"", "UsdPreviewSurface", "rel material:binding = </scene/materials/m0>"})
        CHECK_THAT(text, Catch::Contains(part));
    compare(samplesIn(text, "point3f[] points"), states, &Row::place, 1e-6);
    compare(samplesIn(text, "normal3f[] normals"), states, &Row::normal, 1e-5);
    CHECK(samplesIn(text, "vector3f[] velocities").size() == size_t(frames));

    exported({"--usd", folder, "--frames", std::to_string(frames)});
    CHECK(filesIn(folder).size() == size_t(frames) + 2);
    CHECK_THAT(readFile(folder + "/clips.usda"), Catch::Contains("@./frames/clips-00008.usda@"));
    std::map<int, std::vector<glm::dvec3>> clips;
    for (int frame = 0; frame < frames; ++frame)
        clips.merge(samplesIn(readFile(folder + "/frames/clips-0000" + std::to_string(frame) + ".usda"),
                              "point3f[] points"));
    compare(clips, states, &Row::place, 1e-6);

    const JsonValue rigid = exported({"--usd", file, "--frames", "40", "--rigid", "--json"}).json();
    const double residual = member(member(rigid, "rigidResidual"), "quad").number;
    CHECK(residual > 1e-4);
    const std::string instances = readFile(file);
    CHECK_THAT(instances, Catch::Contains("def PointInstancer \"quad\""));
    CHECK(samplesIn(instances, "point3f[] positions").at(39).size() == 20);
    // a colour a molecule, and none of the shape's own
    const size_t colors = instances.find("color3f[] primvars:displayColor");
    CHECK(instances.find("color3f[] primvars:displayColor", colors + 1) == std::string::npos);
    const size_t list = instances.find(" = [", colors);
    const std::string values = instances.substr(list, instances.find(']', list) - list);
    CHECK(std::count(values.begin(), values.end(), '(') == 20);

    // Within a bound: what all frames, run ahead, are within.
    exported({"--usd", file, "--frames", "40", "--rigid-within", std::to_string(1.01 * residual)});
    CHECK((readFile(file) == instances));
    exported({"--usd", file, "--frames", "40"});
    const std::string meshes = readFile(file);
    exported({"--usd", file, "--frames", "40", "--rigid-within", std::to_string(0.99 * residual)});
    CHECK((readFile(file) == meshes));
    const Words within = {"--usd", file, "--frames", "2", "--rigid-within", "1e-9"};
    CHECK_THAT(exported(within).out, Catch::Contains("\"quad\": meshes, as rigid vertices would lie up to"));
}

TEST_CASE("three.js and tinyusdz read what is exported", "[cli][export]") {
    const std::string modules = environment("SHOAL_NODE_MODULES"), node = findProgram("node");
    if (modules.empty() || node.empty()) {
        WARN(
            "skipped: SHOAL_NODE_MODULES names no folder of three and tinyusdz (npm install three tinyusdz)");
        return;
    }
    const Scratch scratch;
    exported({"--glb", scratch.path("a.glb")});
    exported({"--usd", scratch.path("a.usda"), "--frames", "3"});
    exported({"--usd", scratch.path("r.usda"), "--frames", "3", "--rigid"});
    const Outcome read =
        runProgram(node, {sourceFile("tests/exchange/readers.mjs"), modules, scratch.path("a.glb"),
                          scratch.path("a.usda"), scratch.path("r.usda")});
    INFO(read.out << read.err);
    CHECK(read.code == 0);
    CHECK_THAT(read.out,
               Catch::Contains("three: 1705 vertices, 1 cameras") && Catch::Contains("tinyusdz: 2 meshes"));
    const auto states = statesOfHello(scratch, 2);
    char first[64];
    std::snprintf(first, sizeof first, "first point %.5f %.5f %.5f", states[0][0].place.x,
                  states[0][0].place.y, states[0][0].place.z);
    CHECK_THAT(read.out, Catch::Contains(first));
}

TEST_CASE("Blender plays an animation texture back", "[cli][export][blender]") {
    const std::string program = findProgram("blender");
    if (program.empty()) {
        WARN("skipped: Blender is not installed");
        return;
    }
    const Scratch scratch;
    statesOfHello(scratch, 9);
    exported({"--vat", scratch.path("vat"), "--frames", "9"});
    const Outcome blender = runProgram(program, {"--background", "--factory-startup", "--python-exit-code",
                                                 "1", "--python", sourceFile("tests/exchange/blender.py"),
                                                 "--", scratch.path("vat"), "quad", scratch.path("csv")});
    INFO(blender.out << blender.err);
    CHECK(blender.code == 0);
    CHECK(blender.out.find("720 places: worst ") != std::string::npos);
}
