// The looks that `shoal export` writes: colours, opacity and size over age and speed, colliders, and
// what it warns of.
#include <cmath>
#include <cstring>
#include <filesystem>

#include "cli/shoal_command.h"
#include "core/file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

// A .glb file: its JSON, and the numbers of accessors.
class Glb {
  public:
    explicit Glb(const std::string& file) : bytes_(readFile(file)) {
        REQUIRE(bytes_.substr(0, 4) == "glTF");
        const size_t length = word(12);
        json = parseJson(bytes_.substr(20, length), file);
        data_ = 20 + length + 8;
    }
    JsonValue json;

    const JsonValue& mesh(const std::string& name) const {
        for (const JsonValue& one : member(json, "meshes").items)
            if (member(one, "name").text == name) return one;
        FAIL("no mesh \"" << name << "\"");
        return json;
    }
    // Returns the numbers of each vertex of a mesh's first primitive, as many as their type has.
    std::vector<std::vector<float>> values(const std::string& name, const std::string& attribute) const {
        const JsonValue& attributes = member(member(mesh(name), "primitives").items.at(0), "attributes");
        const JsonValue& accessor =
            member(json, "accessors").items.at(size_t(member(attributes, attribute).number));
        const JsonValue& view =
            member(json, "bufferViews").items.at(size_t(member(accessor, "bufferView").number));
        const std::string& type = member(accessor, "type").text;
        const size_t each = type == "SCALAR" ? 1 : size_t(type.back() - '0');
        std::vector<std::vector<float>> out(size_t(member(accessor, "count").number),
                                            std::vector<float>(each));
        size_t at = data_ + size_t(member(view, "byteOffset").number);
        for (std::vector<float>& one : out) {
            std::memcpy(one.data(), bytes_.data() + at, each * sizeof(float));
            at += each * sizeof(float);
        }
        return out;
    }

  private:
    uint32_t word(size_t at) const {
        uint32_t out = 0;
        std::memcpy(&out, bytes_.data() + at, sizeof out);
        return out;
    }
    std::string bytes_;
    size_t data_ = 0;
};

std::string sceneOf(const std::string& keys) {
    return R"({"format": "shoal-scene-1", "camera": {"eye": [0.6, 0.5, 3], "target": [0.6, 0, 0]}, )" + keys +
           "}";
}

std::string gridOf(const std::string& what, int count) {
    return sceneOf(R"("groups": [{)" + what +
                   R"(, "place": {"on": "grid", "spacing": [0.4, 1, 1], "cells": [)" + std::to_string(count) +
                   ", 1, 1]}}]");
}

std::string quad() {
    return R"("name": "quads", "molecule": ")" + sourceFile("molecules/quad.json") + '"';
}

Outcome exported(const std::string& scene, const Words& more) {
    Words words{"export", scene};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome out = runShoal(words);
    INFO(out.err);
    REQUIRE(out.code == 0);
    return out;
}

// The scene as a .glb after so many frames.
Glb glbOf(const Scratch& scratch, const std::string& scene, int frames = 0) {
    const std::string file = scratch.path("a.glb");
    exported(scratch.write("a.scene.json", scene), {"--glb", file, "--first", std::to_string(frames)});
    return Glb(file);
}

const std::string redToBlue =
    R"("name": "particle", "particle": {"size": 0.3, "growth": [1, 3],
        "colors": [{"age": 0, "color": [1, 0, 0]}, {"age": 1, "color": [0, 0, 1], "opacity": 0.2}]},
       "life": {"span": 1}, "count": 4)";

}  // namespace

TEST_CASE("particles are exported with the colour, opacity and size of their age", "[cli][export]") {
    const Scratch scratch;
    const std::string scene = gridOf(redToBlue, 4);
    const Glb glb = glbOf(scratch, scene, 30);  // half of their life
    const auto colors = glb.values("particle", "COLOR_0"), sizes = glb.values("particle", "_SIZE");
    REQUIRE((colors.size() == 4 && sizes.size() == 4));
    const float wanted[] = {0.5f, 0, 0.5f, 0.6f};
    for (size_t i = 0; i < 4; ++i) {
        for (size_t k = 0; k < 4; ++k)
            CHECK(colors[i].at(k) == Approx(wanted[k]).margin(1e-5));
        CHECK(sizes[i][0] == Approx(0.6f).margin(1e-5));
    }
    const std::string usd = scratch.path("a.usda");
    exported(scratch.path("a.scene.json"), {"--usd", usd, "--first", "30", "--frames", "1"});
    const std::string text = readFile(usd);
    const auto first = [&](const std::string& attribute) {
        const size_t at = text.find(attribute + ".timeSamples = {\n");
        REQUIRE(at != std::string::npos);
        return std::strtod(
            text.c_str() + text.find_first_of("0123456789", text.find("[", at + attribute.size())), nullptr);
    };
    CHECK(first("color3f[] primvars:displayColor") == Approx(0.5).margin(1e-5));
    CHECK(first("float[] primvars:displayOpacity") == Approx(0.6).margin(1e-5));
    CHECK(first("float[] widths") == Approx(0.6).margin(1e-5));
    CHECK_THAT(text, Contains("string inputs:varname = \"displayOpacity\""));
}

TEST_CASE("what glows is exported in its hue, and no brighter than 1", "[cli][export]") {
    const Scratch scratch;
    const Glb glb = glbOf(
        scratch,
        gridOf(R"("name": "sparks", "particle": {"size": [0.1, 0.3], "colors": [{"color": [8, 2, 0]}]})", 6));
    for (const std::vector<float>& color : glb.values("sparks", "COLOR_0"))
        CHECK((color[0] == 1 && color[1] == Approx(0.25f) && color[2] == 0));
    float low = 1, high = 0;
    for (const std::vector<float>& size : glb.values("sparks", "_SIZE"))
        low = std::min(low, size[0]), high = std::max(high, size[0]);
    CHECK((low >= 0.1f && high <= 0.3f && high - low > 0.02f));
}

TEST_CASE("one colour for all is one colour for all", "[cli][export]") {
    const Scratch scratch;
    const auto brightness = [&](const std::string& keys) {
        const Glb glb = glbOf(scratch, gridOf(quad() + keys, 8));
        glm::vec2 span(2, -1);
        for (const std::vector<float>& color : glb.values("quads", "COLOR_0"))
            for (const float channel : color)
                span = {std::min(span.x, channel), std::max(span.y, channel)};
        return span;
    };
    CHECK(brightness(R"(, "color": [1, 1, 1])") == glm::vec2(1));
    CHECK(brightness(R"(, "color": [1, 1, 1], "secondColor": [1, 1, 1], "variation": 0)") == glm::vec2(1));
    const glm::vec2 varied = brightness(R"(, "color": [1, 1, 1], "variation": 0.5)");
    CHECK((varied.x >= 0.5f && varied.x < 0.9f && varied.y <= 1));
    const glm::vec2 grey = brightness(R"(, "color": [0.5, 0.5, 0.5], "variation": 0.5)");
    CHECK((grey.x >= 0.25f && grey.x < 0.45f && grey.y > 0.55f && grey.y <= 0.75f));
}

TEST_CASE("colours by speed and growth are exported as they are drawn", "[cli][export]") {
    const Scratch scratch;
    const Glb fast = glbOf(
        scratch,
        gridOf(quad() +
                   R"(, "velocity": [0, 0.75, 0], "colorBy": {"to": 1, "colors": [[0, 0, 0], [1, 0.5, 0]]})",
               2));
    for (const std::vector<float>& color : fast.values("quads", "COLOR_0"))
        CHECK((color[0] == Approx(0.75f) && color[1] == Approx(0.375f) && color[2] == 0));

    const auto width = [&](int frames) {
        const Glb glb =
            glbOf(scratch, gridOf(quad() + R"(, "count": 1, "life": {"span": 2, "shrink": 1})", 1), frames);
        float low = 1e9f, high = -1e9f;
        for (const std::vector<float>& place : glb.values("quads", "POSITION"))
            low = std::min(low, place[0]), high = std::max(high, place[0]);
        return high - low;
    };
    const float whole = width(30);
    CHECK(width(90) == Approx(0.5f * whole).epsilon(0.01));
}

TEST_CASE("a moment holds what colliders draw", "[cli][export]") {
    const Scratch scratch;
    const std::string colliders = R"("colliders": [{"type": "plane", "name": "floor"},
        {"type": "sphere", "name": "ball", "center": [1, 2, 3], "radius": 0.5, "color": [1, 0, 0]},
        {"type": "box", "name": "crate", "center": [0, 1, 0], "size": [2, 2, 2], "draw": false},
        {"type": "sphere", "name": "swing", "center": [0, 0, 0], "radius": 0.1,
         "path": {"keyframes": [{"time": 0}, {"time": 1, "position": [0, 6, 0]}]}}],
        "groups": [{)" + quad() + R"(, "place": {"on": "list", "items": [{"position": [0, 3, 0]}]}}])";
    const Glb glb = glbOf(scratch, sceneOf(colliders), 30);
    const auto box = [&](const std::string& name) {
        glm::vec3 low(1e9f), high(-1e9f);
        for (const std::vector<float>& x : glb.values(name, "POSITION"))
            low = glm::min(low, glm::vec3(x[0], x[1], x[2])),
            high = glm::max(high, glm::vec3(x[0], x[1], x[2]));
        return std::pair(low, high);
    };
    CHECK(glm::distance(box("ball").first, glm::vec3(0.5f, 1.5f, 2.5f)) < 1e-5f);
    CHECK(glm::distance(box("ball").second, glm::vec3(1.5f, 2.5f, 3.5f)) < 1e-5f);
    CHECK(glm::distance(box("swing").first, glm::vec3(-0.1f, 2.9f, -0.1f)) < 1e-5f);
    CHECK((box("floor").first.y == 0 && box("floor").second.y == 0 && box("floor").second.x > 100));
    for (const JsonValue& mesh : member(glb.json, "meshes").items)
        CHECK(member(mesh, "name").text != "crate");

    const std::string usd = scratch.path("a.usda");
    exported(scratch.path("a.scene.json"), {"--usd", usd, "--frames", "2"});
    const std::string text = readFile(usd);
    for (const char* part : {"def Mesh \"floor\"", "def Mesh \"ball\"", "def Mesh \"swing\""})
        CHECK_THAT(text, Contains(part));
    const size_t swing = text.find("def Mesh \"swing\"");
    CHECK(text.find("point3f[] points.timeSamples", swing) != std::string::npos);
}

TEST_CASE("export warns as check does, and of rigid molecules that bend", "[cli][export]") {
    const Scratch scratch;
    const std::string scene = scratch.write(
        "a.scene.json", sceneOf(R"("colliders": [{"type": "plane"}], "groups": [{)" + quad() +
                                R"(, "place": {"on": "list", "items": [{"position": [0, -1, 0]}]}}])"));
    const std::string inside = "start inside the plane";
    CHECK_THAT(runShoal({"check", scene}).out, Contains(inside));
    CHECK_THAT(exported(scene, {"--glb", scratch.path("a.glb")}).err, Contains(inside));

    scratch.write("soft.json", R"({"format": "shoal-molecule-1", "name": "soft",
        "vertices": [{"position": [0, 0, 0], "mass": 0.01, "pinned": true}, {"position": [0.1, 0, 0], "mass": 0.01},
                     {"position": [0, 0, 0.1], "mass": 0.01, "pinned": true}],
        "springs": [{"a": 0, "b": 1, "stiffness": 1}, {"a": 1, "b": 2, "stiffness": 1},
                    {"a": 0, "b": 2, "stiffness": 1}],
        "triangles": [[0, 2, 1]]})");
    const std::string soft = scratch.write(
        "b.scene.json", sceneOf(R"("gravity": [0, -9.81, 0], "groups": [{"molecule": "soft.json",
            "place": {"on": "list", "items": [{"position": [0.6, 0, 0]}]}}])"));
    for (const Words& words : {Words{"--usd", scratch.path("b.usda"), "--frames", "20", "--rigid"},
                               Words{"--vat", scratch.path("vat"), "--frames", "20", "--rigid"}})
        CHECK_THAT(exported(soft, words).err, Contains("\"soft\" bends: rigid molecules are off by up to"));
    CHECK(exported(soft, {"--usd", scratch.path("c.usda"), "--frames", "20"}).err.find("bends") ==
          std::string::npos);
}

TEST_CASE("Khronos' validator finds nothing in what is exported", "[cli][export]") {
    const std::string modules = environment("SHOAL_NODE_MODULES"), node = findProgram("node");
    if (node.empty() || modules.empty() || !std::filesystem::exists(modules + "/gltf-validator")) {
        WARN("skipped: SHOAL_NODE_MODULES names no folder with gltf-validator (npm install gltf-validator)");
        return;
    }
    const Scratch scratch;
    Words words{sourceFile("tests/exchange/validate.mjs"), modules};
    const auto add = [&](const std::string& scene, const Words& more = {}) {
        Words all{"--glb", scratch.path(std::to_string(words.size()) + ".glb")};
        all.insert(all.end(), more.begin(), more.end());
        exported(scene, all);
        words.push_back(all[1]);
    };
    add(scratch.write("a.scene.json", gridOf(redToBlue, 4)), {"--first", "20"});
    add(scratch.write("b.scene.json", gridOf(quad() + R"(, "color": [1, 1, 1])", 8)));
    add(squaresScene(), {"--first", "5"});
    add("panes", {"--count", "40"});
    add("tree/leaves", {"--count", "50"});
    exported(squaresScene(), {"--vat", scratch.path("vat"), "--frames", "3"});
    words.push_back(scratch.path("vat") + "/quad.glb");
    const Outcome read = runProgram(node, words);
    INFO(read.out << read.err);
    CHECK(read.code == 0);
}
