// Vector fields from .vf, .vti and raw numbers, and numbered files: what they become, and what is refused.
#include <cstdio>
#include <limits>

#include "core/file.h"
#include "core/random.h"
#include "scene/field_files/field_file.h"
#include "scene/field_kinds.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"
#include "support/vti_text.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

constexpr glm::ivec3 size{3, 2, 4};

// Returns a velocity for each cell, different from all others, exact as float and as text.
std::vector<glm::dvec3> numbered(glm::ivec3 cells = size) {
    std::vector<glm::dvec3> out;
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x)
                out.emplace_back(x + 0.5, -y, 8 * z + 0.25);
    return out;
}

template <typename T>
std::string bytesOf(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string asFloatBytes(const std::vector<glm::dvec3>& values) {
    std::string out;
    for (const glm::dvec3& v : values)
        for (int k = 0; k < 3; ++k)
            out += bytesOf(float(v[k]));
    return out;
}

std::string vf(glm::ivec3 cells = size, const std::string& word = "VF_V") {
    std::string out = word;
    for (int i = 0; i < 3; ++i)
        out += bytesOf(uint16_t(cells[i]));
    return out + asFloatBytes(numbered(cells));
}

void same(const FileGrid& grid, const std::vector<glm::dvec3>& expected) {
    REQUIRE(grid.values.size() == expected.size());
    for (size_t i = 0; i < expected.size(); ++i)
        REQUIRE(glm::dvec3(grid.values[i]) == expected[i]);
}

constexpr const char* layoutText = R"({"format": "shoal-field-1", "resolution": [3, 2, 4],
  "bounds": {"low": [0, 0, 0], "high": [3, 2, 4]})";

RawLayout layout(const std::string& more = {}) {
    return parseRawLayout(layoutText + more + "}", "wind.json");
}

// A scene with one grid field of these keys.
Scene sceneOf(const Scratch& scratch, const std::string& keys) {
    return parseScene(
        R"({"format": "shoal-scene-1", "fields": [{"type": "grid", )" + keys +
            R"(}], "groups": [{"particle": {}, "place": {"on": "grid", "spacing": [1, 1, 1], "cells": [1, 1, 1]}}]})",
        scratch.path("s.json"));
}

}  // namespace

TEST_CASE(".vf: header, order, errors", "[fieldFiles]") {
    const FileGrid grid = parseVf(vf(), "w.vf");
    CHECK(grid.resolution == size);
    same(grid, numbered());

    const auto message = [](const std::string& bytes) { return messageOf([&] { parseVf(bytes, "w.vf"); }); };
    CHECK_THAT(message(""), Contains("w.vf: expected a file that begins with \"VF_V\""));
    CHECK_THAT(message("VF_V\1"), Contains("expected a header of 10 bytes, found 5"));
    CHECK_THAT(message(vf(size, "VF_F")), Contains("single numbers"));
    CHECK_THAT(message(vf({3, 0, 4})),
               Contains("resolution along y as a whole number of at least 1, found 0"));
    CHECK_THAT(message("VF_V\xff\xff\xff\xff\xff\xff"), Contains("more than 16777216 cells"));
    CHECK_THAT(message(vf() + "x"), Contains("3 x 2 x 4 cells take 298 bytes, found 299"));
    for (size_t length = 0; length < vf().size(); ++length)
        REQUIRE(!message(vf().substr(0, length)).empty());
}

TEST_CASE(".vf needs bounds, and Unity's axes are left-handed", "[fieldFiles]") {
    const Scratch scratch;
    scratch.write("w.vf", vf());
    CHECK_THAT(messageOf([&] { sceneOf(scratch, R"("file": "w.vf")"); }),
               Contains("w.vf: this format does not say where the field lies: the scene needs \"bounds\""));
    const Scene scene = sceneOf(scratch, R"("file": "w.vf", "axes": "unity", "velocityScale": 2,
        "bounds": {"low": [-1, 0, -1], "high": [1, 1, 1]})");
    const GridField& grid = std::get<GridField>(*scene.fields[0].shape);
    CHECK(grid.low == glm::dvec3(-1, 0, -1));
    CHECK(grid.resolution == size);
    // the file's cell (1, 1, 3) is the scene's (1, 1, 0)
    CHECK(grid.values[1 + 3 * 1] == glm::vec3(3, -2, -48.5f));
}

TEST_CASE("raw numbers in every layout", "[fieldFiles]") {
    const std::vector<glm::dvec3> values = numbered();
    same(parseRaw(asFloatBytes(values), layout(), "w.raw"), values);
    CHECK(layout().bounds->high == glm::dvec3(3, 2, 4));

    std::string wide, big, half, planar, zFastest;
    for (const glm::dvec3& v : values)
        for (int k = 0; k < 3; ++k) {
            wide += bytesOf(v[k]);
            std::string number = bytesOf(float(v[k]));
            big += std::string(number.rbegin(), number.rend());
        }
    same(parseRaw("head" + wide, layout(R"(, "encoding": "float64", "skip": 4)"), "w.raw"), values);
    same(parseRaw(big, layout(R"(, "byteOrder": "big")"), "w.raw"), values);
    for (int k = 0; k < 3; ++k)
        for (const glm::dvec3& v : values)
            planar += bytesOf(float(v[k]));
    same(parseRaw(planar, layout(R"(, "components": "planar")"), "w.raw"), values);
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 2; ++y)
            for (int z = 0; z < 4; ++z)
                zFastest += asFloatBytes({values[size_t(x + 3 * (y + 2 * z))]});
    same(parseRaw(zFastest, layout(R"(, "order": "zFastest")"), "w.raw"), values);
    // 1, -2, 0.5 as halves
    const RawLayout one = parseRawLayout(
        R"({"format": "shoal-field-1", "resolution": [1, 1, 1], "encoding": "float16"})", "wind.json");
    same(parseRaw(std::string("\x00\x3c\x00\xc0\x00\x38", 6), one, "w.raw"), {{1, -2, 0.5}});
}

TEST_CASE("raw numbers: errors", "[fieldFiles]") {
    CHECK_THAT(messageOf([] { parseRaw("xxxx", layout(), "w.raw"); }),
               Contains("w.raw: the layout of 3 x 2 x 4 cells takes 288 bytes, found 4"));
    const auto message = [](const std::string& text) {
        return messageOf([&] { parseRawLayout(text, "wind.json"); });
    };
    CHECK_THAT(message(R"({"format": "shoal-field-1", "resolution": [3, 2]})"),
               Contains("wind.json:1:43: expected three"));
    CHECK_THAT(message(R"({"format": "shoal-field-1", "resolution": [3, 0, 1]})"),
               Contains("along y as a whole number"));
    CHECK_THAT(message(R"({"format": "shoal-field-1", "resolution": [2000000000, 2000000000, 1]})"),
               Contains("more than 16777216 cells"));
    CHECK_THAT(message(R"({"format": "shoal-field-1"})"), Contains("resolution"));
    CHECK_THAT(message(R"({"format": "shoal-field-1", "resolution": [1, 1, 1], "encodin": "float32"})"),
               Contains("did you mean \"encoding\""));
    const Scratch scratch;
    scratch.write("w.raw", asFloatBytes({{1, 2, std::numeric_limits<double>::quiet_NaN()}}));
    scratch.write("w.json", R"({"format": "shoal-field-1", "resolution": [1, 1, 1],
        "bounds": {"low": [0, 0, 0], "high": [1, 1, 1]}})");
    CHECK_THAT(messageOf([&] { sceneOf(scratch, R"("file": "w.raw", "layout": "w.json")"); }),
               Contains("w.raw: cell (0, 0, 0) holds (1, 2, nan), expected finite numbers"));
    CHECK_THAT(messageOf([&] { sceneOf(scratch, R"("file": "w.raw")"); }), Contains("\"layout\""));
}

TEST_CASE(".vti in every encoding", "[fieldFiles]") {
    using Format = VtiText::Format;
    for (const Format format : {Format::ascii, Format::binary, Format::appendedRaw, Format::appendedBase64})
        for (int bits = 0; bits < 16; ++bits) {
            const VtiText text{.format = format,
                               .bigEndian = (bits & 1) != 0,
                               .longHeader = (bits & 2) != 0,
                               .zlib = (bits & 4) != 0,
                               .wide = (bits & 8) != 0};
            INFO("format " << int(format) << ", bits " << bits);
            const FileGrid grid = parseVti(text.write(numbered()), "w.vti");
            CHECK(grid.resolution == size);
            // points are the middles of cells
            CHECK(grid.low == glm::dvec3(0.75, 1.875, 2));
            CHECK(grid.high == glm::dvec3(2.25, 2.375, 10));
            same(grid, numbered());
        }
}

TEST_CASE(".vti of cells, of an extent that does not begin at 0, and of one array among several",
          "[fieldFiles]") {
    VtiText text;
    text.ofCells = true;
    text.extent = size;
    const FileGrid grid = parseVti(text.write(numbered()), "w.vti");
    CHECK(grid.resolution == size);
    CHECK(grid.low == glm::dvec3(1, 2, 3));
    CHECK(grid.high == glm::dvec3(2.5, 2.5, 11));

    text.before =
        R"(<DataArray type="Float32" Name="force" NumberOfComponents="3" format="ascii">0</DataArray>
<DataArray type="Float32" Name="p" format="ascii">0</DataArray>)";
    CHECK_THAT(messageOf([&] { parseVti(text.write(numbered()), "w.vti"); }),
               Contains("w.vti:4:2: expected \"array\" to say which of \"force\", \"velocity\""));
    CHECK_THAT(messageOf([&] { parseVti(text.write(numbered()), "w.vti", "speed"); }),
               Contains("has no array \"speed\"; of three components: \"force\", \"velocity\""));
    CHECK_THAT(messageOf([&] { parseVti(text.write(numbered()), "w.vti", "p"); }),
               Contains("expected three components of \"p\", found 1"));
    same(parseVti(text.write(numbered()), "w.vti", "velocity"), numbered());
    std::string active = text.write(numbered());
    active.replace(active.find("<CellData"), 9, "<CellData Vectors=\"velocity\"");
    same(parseVti(active, "w.vti"), numbered());

    VtiText shifted;
    std::string moved = shifted.write(numbered());
    for (const char* key : {"WholeExtent=\"0 2", " Extent=\"0 2"})
        moved.replace(moved.find(key) + std::string(key).size() - 3, 3, "4 6");
    CHECK(parseVti(moved, "w.vti").low == glm::dvec3(0.75 + 4 * 0.5, 1.875, 2));
}

TEST_CASE(".vti with a direction along the axes is turned, one across them refused", "[fieldFiles]") {
    VtiText text;
    text.more = R"(Origin="1 2 3" Direction="0 0 -1 1 0 0 0 1 0")";  // x = -k, y = i, z = j
    const FileGrid grid = parseVti(text.write(numbered()), "w.vti");
    CHECK(grid.resolution == glm::ivec3(4, 3, 2));
    CHECK(grid.low == glm::dvec3(1 - 3.5, 2 - 0.5, 3 - 0.5));
    CHECK(grid.high == glm::dvec3(1.5, 4.5, 4.5));
    const std::vector<glm::dvec3> values = numbered();
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 3; ++i)
                REQUIRE(glm::dvec3(grid.values[size_t((3 - k) + 4 * (i + 3 * j))]) ==
                        values[size_t(i + 3 * (j + 2 * k))]);
    for (const char* direction : {"0.8 0.6 0 -0.6 0.8 0 0 0 1", "1 0 0 1 0 0 0 0 1", "0 0 0 0 1 0 0 0 1"}) {
        text.more = concat("Direction=\"", direction, "\"");
        CHECK_THAT(messageOf([&] { parseVti(text.write(numbered()), "w.vti"); }),
                   Contains("expected a direction along the axes"));
    }
}

TEST_CASE(".vti of whole numbers of every width and sign", "[fieldFiles]") {
    const std::pair<const char*, size_t> types[] = {{"Int8", 1},  {"UInt8", 1},  {"Int16", 2}, {"UInt16", 2},
                                                    {"Int32", 4}, {"UInt32", 4}, {"Int64", 8}, {"UInt64", 8}};
    for (const auto& [type, bytes] : types)
        for (const bool big : {false, true})
            for (const auto format : {VtiText::Format::ascii, VtiText::Format::appendedRaw}) {
                INFO(type << " " << big);
                const bool negative = type[0] == 'I';
                std::vector<glm::dvec3> values(24, {1, negative ? -2 : 200, 3});
                values[23] = {negative ? -128 : 255, 0, 100};
                const VtiText text{.format = format, .bigEndian = big, .whole = type, .wholeBytes = bytes};
                same(parseVti(text.write(values), "w.vti"), values);
            }
}

TEST_CASE(".vti of a flat image is one layer about its plane, of points or of cells", "[fieldFiles]") {
    for (const bool ofCells : {true, false}) {
        VtiText text{.ofCells = ofCells, .extent = {4, 4, 0}};
        const auto grid = [&](const char* spacing) {
            text.more = concat("Origin=\"0 0 3\" Spacing=\"", spacing, "\"");
            const int side = ofCells ? 4 : 5;
            const std::vector<glm::dvec3> values = numbered({side, side, 1});
            const FileGrid out = parseVti(text.write(values), "w.vti");
            CHECK(out.resolution == glm::ivec3(side, side, 1));
            same(out, values);
            return out;
        };
        const double half = ofCells ? 0 : 0.125;
        CHECK(grid("0.25 0.5 0.25").low == glm::dvec3(-half, -2 * half, 2.875));
        CHECK(grid("0.25 0.5 0.25").high == glm::dvec3(1 + half, 2 + 2 * half, 3.125));
        CHECK(grid("0.25 0.5 0").low.z == 2.875);
        CHECK(grid("0.25 0.5 0").high.z == 3.125);
        text.more = "Spacing=\"0 0 0\"";
        CHECK_THAT(messageOf([&] {
                       parseVti(text.write(numbered({5, 5, 1})), "w.vti");
                   }),
                   Contains("expected a spacing above 0, found 0"));
    }
}

TEST_CASE(".vti mistakes are located", "[fieldFiles]") {
    const std::string good = VtiText{}.write(numbered());
    const auto exchanged = [&](const std::string& text, const std::string& from, const std::string& to) {
        std::string out = text;
        REQUIRE(out.find(from) != std::string::npos);
        out.replace(out.find(from), from.size(), to);
        return messageOf([&] { parseVti(out, "w.vti"); });
    };
    CHECK_THAT(exchanged(good, "</Piece>", ""), Contains("is not XML"));
    CHECK_THAT(exchanged(good, "type=\"ImageData\"", "type=\"PolyData\""),
               Contains("w.vti:2:2: expected type=\"ImageData\", found \"PolyData\""));
    CHECK_THAT(exchanged(good, "Spacing=\"0.5", "Spacing=\"0"),
               Contains("expected a spacing above 0, found 0"));
    CHECK_THAT(exchanged(good, "Spacing=\"0.5", "Spacing=\"wide"),
               Contains("w.vti:3:2: Spacing: expected a number, found \"wide\""));
    std::string reversed = good;
    for (const char* key : {"WholeExtent=\"0 2", " Extent=\"0 2"})
        reversed.replace(reversed.find(key) + std::string(key).size() - 3, 3, "2 0");
    CHECK_THAT(messageOf([&] { parseVti(reversed, "w.vti"); }),
               Contains("expected an extent of whole numbers in order, found 2 to 0"));
    CHECK_THAT(exchanged(good, "Piece Extent=\"0 2", "Piece Extent=\"0 1"),
               Contains("a piece that is the whole extent"));
    CHECK_THAT(exchanged(good, "Float32", "String"),
               Contains("expected numbers as Float32, Float64, or Int8 to UInt64, found \"String\""));
    CHECK_THAT(exchanged(good, "NumberOfComponents=\"3\"", ""), Contains("has no array of three components"));
    CHECK_THAT(exchanged(good, "0.5 0 0.25\n", "0.5 zero 0.25\n"),
               Contains("w.vti:7:5: expected a number, found \"zero\""));
    CHECK_THAT(exchanged(good, "0.5 0 0.25\n", "0.5 0.25\n"), Contains("expected 72 values, found 71"));
    CHECK_THAT(exchanged(good, "0.5 0 0.25\n", "0.5 0 0.25 4\n"), Contains("expected 72 values, found more"));
    std::string huge = good;
    for (const char* key : {"WholeExtent=\"0 2", " Extent=\"0 2"})
        huge.replace(huge.find(key) + std::string(key).size() - 1, 1, "2000000000");
    CHECK_THAT(messageOf([&] { parseVti(huge, "w.vti"); }), Contains("more than 16777216 cells"));
    const std::string packed =
        VtiText{.format = VtiText::Format::appendedRaw, .zlib = true}.write(numbered());
    CHECK_THAT(exchanged(packed, "vtkZLibDataCompressor", "vtkLZ4DataCompressor"),
               Contains("compressed by vtkZLibDataCompressor, found vtkLZ4DataCompressor"));
    CHECK_THAT(exchanged(packed, "offset=\"0", "offset=\"99999"), Contains("outside the appended data"));
    std::string damaged = packed;
    damaged[packed.find("\n _") + 60] ^= 0x55;
    CHECK_THAT(messageOf([&] { parseVti(damaged, "w.vti"); }), Contains("of the compressed data is damaged"));
}

TEST_CASE("damaged .vti, .vf and raw files are refused or read", "[fieldFiles][mutations]") {
    using Format = VtiText::Format;
    Random random(5, 0);
    size_t refused = 0, tried = 0;
    const auto attempt = [&](const std::string& text) {
        ++tried;
        try {
            GridField field;
            addFrame(field, parseVti(text, "w.vti"), "w.vti");
        } catch (const Error& error) {
            ++refused;
            REQUIRE(!error.location().file.empty());
        }
    };
    for (const Format format : {Format::ascii, Format::binary, Format::appendedRaw, Format::appendedBase64})
        for (const bool zlib : {false, true}) {
            const std::string text =
                VtiText{.format = format, .zlib = zlib, .extent = {1, 1, 1}}.write(numbered({2, 2, 2}));
            for (size_t length = 0; length < text.size(); ++length)
                attempt(text.substr(0, length));
            for (int i = 0; i < 400; ++i) {
                std::string flipped = text;
                for (int k = 0; k < 1 + i % 3; ++k)
                    flipped[random.next() % text.size()] ^= char(1 << random.next() % 8);
                attempt(flipped);
            }
        }
    CHECK(refused > tried / 2);
    for (int i = 0; i < 400; ++i) {
        std::string flipped = vf();
        flipped[random.next() % 40] ^= char(1 << random.next() % 8);
        try {
            GridField field;
            field.source.bounds = Box{};
            addFrame(field, parseVf(flipped, "w.vf"), "w.vf");
        } catch (const Error&) {
        }
    }
}

TEST_CASE("numbered files are a sequence in time", "[fieldFiles]") {
    const Scratch scratch;
    for (int i = 1; i <= 3; ++i)
        scratch.write(concat("w-0", i, ".vti"),
                      VtiText{}.write(std::vector<glm::dvec3>(24, {double(i), 0, 0})));
    const Scene found = sceneOf(scratch, R"("file": "w-##.vti", "sequence": {"frameRate": 4, "start": 1})");
    const GridField& grid = std::get<GridField>(*found.fields[0].shape);
    CHECK(grid.times == std::vector<double>{1, 1.25, 1.5});
    CHECK(!grid.repeats);
    CHECK(grid.period() == 0.75);
    REQUIRE(grid.values.size() == 72);
    CHECK(grid.values[24] == glm::vec3(2, 0, 0));
    const Scene chosen = sceneOf(
        scratch,
        R"("file": "w-##.vti", "sequence": {"first": 1, "last": 3, "step": 2, "times": [0, 7], "repeats": true})");
    CHECK(std::get<GridField>(*chosen.fields[0].shape).values[24] == glm::vec3(3, 0, 0));
    CHECK(std::get<GridField>(*chosen.fields[0].shape).period() == 14);

    const auto message = [&](const std::string& keys) { return messageOf([&] { sceneOf(scratch, keys); }); };
    CHECK_THAT(message(R"("file": "w-##.vti")"), Contains("numbered files need \"sequence\""));
    CHECK_THAT(message(R"("file": "w-01.vti", "sequence": {"frameRate": 1})"),
               Contains("expected one run of #"));
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {})"), Contains("frameRate"));
    CHECK_THAT(message(R"("file": "v-##.vti", "sequence": {"frameRate": 1})"),
               Contains("no such files: ") && Contains("v-00.vti"));
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {"frameRate": 1, "last": 5})"),
               Contains("no such file: ") && Contains("w-04.vti, of the numbers 1 to 5"));
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {"frameRate": 1, "first": 3, "last": 3})"),
               Contains("expected 2 to 10000 files"));
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {"times": [0, 1]})"),
               Contains("expected 3 times, one a file, found 2"));
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {"times": [0, 1, 1]})"),
               Contains("expected rising times, found 1 and then 1"));
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {"frameRate": 1, "times": [0, 1, 2]})"),
               Contains("frameRate"));
    scratch.write("w-03.vti", VtiText{.extent = {2, 1, 2}}.write(numbered({3, 2, 3})));
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {"frameRate": 1})"),
               Contains("w-03.vti: has 3 x 2 x 3 cells, ") &&
                   Contains("w-01.vti of the same sequence has 3 x 2 x 4"));
    VtiText moved;
    moved.more = R"(Origin="1 2 4" Spacing="0.5 0.25 2")";
    scratch.write("w-03.vti", moved.write(numbered()));
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {"frameRate": 1})"),
               Contains("w-03.vti: reaches from 3 to 11 m along z, "));
    scratch.write("w-03.vti", "");
    CHECK_THAT(message(R"("file": "w-##.vti", "sequence": {"frameRate": 1})"), Contains("w-03.vti"));
}
