// glTF: what its arrays, nodes, skins, targets, instances, materials and extensions mean, and what is
// refused.
#include <algorithm>
#include <cmath>
#include <limits>

#include <meshoptimizer.h>

#include "core/image.h"
#include "geometry/mesh.h"
#include "support/catch.h"
#include "support/gltf_text.h"
#include "support/model_text.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

const char* nameOf(const std::string& bytes) {
    return bytes.starts_with("glTF") ? "m.glb" : "m.gltf";
}

Mesh read(const std::string& bytes, bool lenient = false) {
    return modelOf(nameOf(bytes), bytes, lenient);
}

std::string refusal(const std::string& bytes) {
    return refusalOf(nameOf(bytes), bytes);
}

void checkBox(const Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high) {
    INFO(mesh.low.x << " " << mesh.low.y << " " << mesh.low.z << " to " << mesh.high.x << " " << mesh.high.y
                    << " " << mesh.high.z);
    CHECK(glm::distance(mesh.low, low) < 1e-4);
    CHECK(glm::distance(mesh.high, high) < 1e-4);
}

// A file of the box, whose positions are accessor 0 and whose triangles are 1.
GltfText box() {
    GltfText out;
    out.points(boxPoints);
    out.indices(boxTriangles);
    return out;
}

constexpr const char* boxMesh =
    R"("meshes": [{"name": "box", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}])";
constexpr const char* oneNode = R"("scenes": [{"nodes": [0]}], "nodes": [{"name": "crate", "mesh": 0}], )";

// One triangle with these keys of its primitive, attributes 0 to 2 being points, and of the root.
std::string triangle(GltfText& file, const std::string& attributes, const std::string& primitive,
                     const std::string& root) {
    return file.text(concat(R"("nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {)",
                            attributes, "}", primitive, "}]}]", root));
}

std::string notesOf(const Mesh& mesh) {
    return joined(mesh.notes, "\n");
}

const std::vector<float> threePoints = {0, 0, 0, 1, 0, 0, 0, 1, 0};

}  // namespace

TEST_CASE("quantised positions are read at the scale of their node", "[model][gltf]") {
    GltfText file;
    std::vector<uint16_t> steps;
    for (size_t i = 0; i < boxPoints.size(); i += 3)
        for (const float number : {boxPoints[i], boxPoints[i + 1], boxPoints[i + 2], 0.0f})
            steps.push_back(uint16_t(number * 5461));
    file.addView(steps);
    file.say(0, R"("byteStride": 8)");
    file.addAccessor(0, 8, "VEC3", 5123);
    file.indices(boxTriangles);
    const std::string extensions =
        R"("extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"], )";
    const Mesh mesh = read(file.text(concat(extensions, R"("nodes": [{"mesh": 0, "scale": [)", 1 / 5461.0,
                                            ", ", 1 / 5461.0, ", ", 1 / 5461.0, "]}], ", boxMesh)));
    checkBox(mesh, {0, 0, 0}, {1, 2, 3});
    CHECK(mesh.notes.empty());
    CHECK(examineSurface(mesh).closed());
}

TEST_CASE("normalised integers are fractions, and colours stay linear", "[model][gltf]") {
    GltfText file;
    file.points(threePoints);
    file.add<int8_t>({127, 0, 0, 0, -128, 127, 0, 0, -127, 0, 0, 0}, "VEC4", 5120, 4,
                     R"(, "normalized": true)");
    file.add<uint8_t>({255, 51, 0, 255, 0, 255, 0, 255, 0, 0, 255, 0}, "VEC4", 5121, 4,
                      R"(, "normalized": true)");
    const Mesh mesh = read(triangle(file, R"("POSITION": 0, "COLOR_0": 2)", "", ""));
    REQUIRE(mesh.colors.size() == 3);
    CHECK(glm::distance(mesh.colors[0], glm::dvec3(1, 0.2, 0)) < 1e-9);
    CHECK(notesOf(mesh) == "the alpha of its vertices' colours is not drawn");
    CHECK_THAT(refusal(triangle(file, R"("POSITION": 0, "NORMAL": 1)", "", "")),
               Contains("is not of the kind that is expected of it") && Contains("$.accessors[1].type"));
}

TEST_CASE("a mesh stands at each of its instances", "[model][gltf]") {
    GltfText file = box();
    file.points({0, 0, 0, 10, 0, 0, 20, 0, 0});
    file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f}, "VEC4", 4);
    const auto instances = [&](const std::string& attributes) {
        return file.text(concat(R"("extensionsUsed": ["EXT_mesh_gpu_instancing"], "nodes": [{"mesh": 0,
            "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {)",
                                attributes, "}}}}], ", boxMesh));
    };
    const Mesh three = read(instances(R"("TRANSLATION": 2)"));
    checkBox(three, {0, 0, 0}, {21, 2, 3});
    CHECK(three.triangles.size() == 36);
    CHECK(three.objects.size() == 1);
    CHECK(three.notes.empty());
    // The last is turned by a quarter about z: its y points to -x.
    checkBox(read(instances(R"("TRANSLATION": 2, "ROTATION": 3)")), {0, 0, 0}, {20, 2, 3});
    file.points({1, 1, 1});
    CHECK_THAT(refusal(instances(R"("TRANSLATION": 2, "SCALE": 4)")),
               Contains("has 1 elements, the others 3"));
}

TEST_CASE("what a skin moves stands where its joints are", "[model][gltf]") {
    GltfText file = box();
    std::vector<uint8_t> joints;
    std::vector<float> weights;
    for (int i = 0; i < 8; ++i) {
        joints.insert(joints.end(), {1, 0, 0, 0});
        weights.insert(weights.end(), {0.75f, 0.25f, 0, 0});
    }
    file.add(joints, "VEC4", 5121, 4);
    file.floats(weights, "VEC4", 4);
    file.floats(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -4, 0, 0, 1},
        "MAT4", 16);
    const auto skinned = [&](const std::string& nodes) {
        return file.text(concat(R"("nodes": [)", nodes, R"(], "skins": [{"joints": [1, 2],
            "inverseBindMatrices": 4}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0,
            "JOINTS_0": 2, "WEIGHTS_0": 3}, "indices": 1}]}])"));
    };
    const std::string moved = R"({"mesh": 0, "skin": 0, "translation": [100, 0, 0]}, )";
    // The second joint is undone by its matrix; both move by 10 in y, of which the first halves y.
    const Mesh mesh =
        read(skinned(moved + R"({"name": "hip", "translation": [0, 10, 0], "scale": [1, 0.5, 1]},
        {"name": "knee", "translation": [4, 10, 0], "scale": [1, 0.5, 1]})"));
    checkBox(mesh, {0, 10, 0}, {1, 11, 3});
    REQUIRE(mesh.bones.size() == mesh.positions.size());
    for (const int bone : mesh.bones)
        CHECK(mesh.boneNames[size_t(bone)] == "knee");
    joints.assign(32, 7);
    GltfText wrong = box();
    wrong.add(joints, "VEC4", 5121, 4);
    wrong.floats(weights, "VEC4", 4);
    CHECK_THAT(refusal(wrong.text(R"("nodes": [{"mesh": 0, "skin": 0}], "skins": [{"joints": [0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}}]}])")),
               Contains("is moved by joint 7 of 1"));
}

TEST_CASE("morph targets count by their default weights, the node's before the mesh's", "[model][gltf]") {
    GltfText file = box();
    std::vector<float> moves(24, 0.0f);
    for (size_t i = 12; i < 24; i += 3)
        moves[i] = 4;
    file.points(moves);
    const auto morphed = [&](const std::string& node, const std::string& mesh) {
        return read(file.text(concat(R"("nodes": [{"mesh": 0)", node, R"(}], "meshes": [{)", mesh,
                                     R"("primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
                                     "targets": [{"POSITION": 2}]}]}])")));
    };
    checkBox(morphed("", ""), {0, 0, 0}, {1, 2, 3});
    checkBox(morphed("", R"("weights": [1], )"), {0, 0, 0}, {5, 2, 3});
    checkBox(morphed(R"(, "weights": [0.5])", R"("weights": [1], )"), {0, 0, 0}, {3, 2, 3});
}

TEST_CASE("without normals a surface is flat, with them corners are shared", "[model][gltf]") {
    GltfText file = box();
    const Mesh flat = read(file.text(std::string(oneNode) + boxMesh));
    CHECK(flat.positions.size() == 36);
    CHECK(flat.weldedPositions.size() == 8);
    for (const glm::dvec3& n : flat.normals)
        CHECK(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) == Approx(1));
    REQUIRE(flat.objects.size() == 1);
    CHECK(flat.objects[0].name == "crate");
    REQUIRE(flat.parts.size() == 1);
    CHECK(flat.parts[0].mesh == "box");
    CHECK(flat.parts[0].look == -1);
    file.points(boxPoints);  // leaning normals
    const Mesh smooth = read(file.text(std::string(oneNode) + R"("meshes": [{"primitives": [{"attributes":
        {"POSITION": 0, "NORMAL": 2}, "indices": 1}]}])"));
    CHECK(smooth.positions.size() == 8);
}

TEST_CASE("strips, fans and sparse arrays make the triangles that they mean", "[model][gltf]") {
    GltfText file;
    file.points({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    file.indices({0, 1, 3, 2});
    file.addView(std::vector<uint8_t>{3});
    file.addView(std::vector<float>{2, 2, 0});
    file.addAccessor(0, 4, "VEC3", 5126, R"(, "sparse": {"count": 1, "indices": {"bufferView": 2,
        "componentType": 5121}, "values": {"bufferView": 3}})");
    const auto facing = [&](const std::string& attributes, const std::string& primitive) {
        const Mesh mesh = read(triangle(file, attributes, primitive, ""));
        CHECK(mesh.triangles.size() == 2);
        for (const glm::dvec3& n : mesh.normals)
            CHECK(n.z == Approx(1));
        return mesh;
    };
    checkBox(facing(R"("POSITION": 0)", R"(, "mode": 5)"), {0, 0, 0}, {1, 1, 0});
    checkBox(facing(R"("POSITION": 0)", R"(, "mode": 6, "indices": 1)"), {0, 0, 0}, {1, 1, 0});
    checkBox(facing(R"("POSITION": 2)", R"(, "mode": 5)"), {0, 0, 0}, {2, 2, 0});
    const Mesh lines = read(file.text(R"("nodes": [{"mesh": 0}], "meshes": [{"primitives": [
        {"attributes": {"POSITION": 0}, "mode": 1}, {"attributes": {"POSITION": 0}, "mode": 5}]}])"));
    CHECK(lines.triangles.size() == 2);
    CHECK(notesOf(lines) == "its points and lines are not drawn");
    const Mesh cloud = read(triangle(file, R"("POSITION": 0)", R"(, "mode": 0)", ""));
    CHECK(cloud.triangles.empty());
    CHECK(cloud.positions.size() == 4);
    CHECK_THAT(notesOf(read(triangle(file, R"("POSITION": 0)", "", ""))),
               Contains("the last 1 of 4 corners at $.meshes[0].primitives[0] make no triangle"));
}

TEST_CASE("arrays that meshoptimizer compressed are read, beside a buffer that is not there",
          "[model][gltf]") {
    std::vector<uint8_t> packed(meshopt_encodeVertexBufferBound(8, 12));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), boxPoints.data(), 8, 12));
    const std::vector<unsigned> triangles(boxTriangles.begin(), boxTriangles.end());
    std::vector<uint8_t> faces(meshopt_encodeIndexBufferBound(36, 8));
    faces.resize(meshopt_encodeIndexBuffer(faces.data(), faces.size(), triangles.data(), 36));
    const auto file = [&](const char* stride, const std::vector<uint8_t>& vertices) {
        GltfText out;
        out.addView(vertices), out.addView(faces);
        const auto view = [&](int number, size_t size, const std::string& keys) {
            const size_t offset = number == 0 ? 0 : (vertices.size() + 3) / 4 * 4;
            out.say(number,
                    concat(R"("extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteOffset": )",
                           offset, R"(, "byteLength": )", size, ", ", keys, "}}"));
        };
        view(0, vertices.size(), concat(R"("count": 8, "mode": "ATTRIBUTES", "byteStride": )", stride));
        view(1, faces.size(), R"("count": 36, "mode": "TRIANGLES", "byteStride": 2)");
        out.addAccessor(0, 8, "VEC3", 5126);
        out.addAccessor(1, 36, "SCALAR", 5123);
        return out.binary(
            concat(R"("extensionsUsed": ["EXT_meshopt_compression"], "extensionsRequired":
            ["EXT_meshopt_compression"], )",
                   oneNode, boxMesh),
            R"(, {"byteLength": 168, "extensions": {"EXT_meshopt_compression": {"fallback": true}}})");
    };
    const Mesh mesh = read(file("12", packed));
    checkBox(mesh, {0, 0, 0}, {1, 2, 3});
    CHECK(examineSurface(mesh).closed());
    // a filtered number is 24 bits times 2 to the other 8; these are whole
    const std::vector<uint32_t> words(boxPoints.begin(), boxPoints.end());
    std::vector<uint8_t> filtered(meshopt_encodeVertexBufferBound(8, 12));
    filtered.resize(meshopt_encodeVertexBuffer(filtered.data(), filtered.size(), words.data(), 8, 12));
    checkBox(read(file(R"(12, "filter": "EXPONENTIAL")", filtered)), {0, 0, 0}, {1, 2, 3});
    CHECK_THAT(refusal(file(R"(12, "filter": "QUATERNION")", packed)), Contains("does not fit its mode"));
    CHECK_THAT(refusal(file("13", packed)), Contains("does not fit its mode and filter"));
    CHECK_THAT(refusal(file("12", {packed.begin(), packed.end() - 9})),
               Contains("compressed bytes are damaged"));
}

TEST_CASE("extensions that are not read are named: required ones refuse, others are told", "[model][gltf]") {
    const GltfText file = box();
    const auto with = [&](const std::string& keys) { return file.text(keys + oneNode + boxMesh); };
    const std::string required = with(R"("extensionsUsed": ["EXT_x"], "extensionsRequired": ["EXT_x"], )");
    CHECK_THAT(refusal(required), Contains("m.gltf: it requires the extension EXT_x, which is not read") &&
                                      Contains("--lenient"));
    const Mesh lenient = read(required, true);
    checkBox(lenient, {0, 0, 0}, {1, 2, 3});
    CHECK(notesOf(lenient) == "it requires the extension EXT_x, which is not read");
    CHECK(notesOf(read(with(R"("extensionsUsed": ["KHR_x"], )"))) == "its extension KHR_x is not read");
    CHECK_THAT(refusal(with(R"("extensionsRequired": ["KHR_draco_mesh_compression"], )")),
               Contains("compressed by Draco (KHR_draco_mesh_compression), which is not read"));
    CHECK(notesOf(read(with(R"("animations": [{}], "cameras": [{}], )"))) ==
          "its animations are not played: it is read in its pose\nits cameras are not read");
}

TEST_CASE("a material of glTF keeps its numbers, images and how they lie", "[model][gltf][material]") {
    const Scratch scratch;
    writePng(scratch.path("red dot.png"), Image{1, 1, 4, {255, 0, 0, 255}});
    GltfText file;
    file.points(threePoints);
    file.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    const auto materialOf = [&](const std::string& keys) {
        const Mesh mesh = loadMesh(scratch.write(
            "m.gltf", triangle(file, R"("POSITION": 0, "TEXCOORD_0": 1)", R"(, "material": 0)",
                               concat(R"(, "images": [{"uri": "red%20dot.png"}], "textures": [{"source": 0}],
                               "materials": [{"name": "paint", )",
                                      keys, "}]"))));
        REQUIRE(mesh.materials.size() == 1);
        REQUIRE(mesh.parts.size() == 1);
        CHECK(mesh.parts[0].look == 0);
        CHECK(mesh.parts[0].material == "paint");
        return mesh;
    };
    const Mesh plain = materialOf(R"("emissiveFactor": [1, 0.5, 0], "extensions":
        {"KHR_materials_emissive_strength": {"emissiveStrength": 3}})");
    CHECK(plain.materials[0].metallic == 1);
    CHECK(plain.materials[0].roughness == 1);
    CHECK(glm::distance(plain.materials[0].emissive, glm::dvec3(3, 1.5, 0)) < 1e-9);
    CHECK(plain.uvs[0] == glm::dvec2(0, 1));  // glTF's v points down
    const Mesh glass = materialOf(R"("pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5],
        "metallicFactor": 0, "roughnessFactor": 0.25}, "alphaMode": "BLEND", "extensions":
        {"KHR_materials_transmission": {"transmissionFactor": 0.5}, "KHR_materials_ior": {"ior": 1.3}})");
    CHECK(glass.materials[0].alpha == SurfaceMaterial::Alpha::blend);
    CHECK(glass.materials[0].color.a == 0.25);
    CHECK(glass.materials[0].refraction == 1.3);
    CHECK(glass.materials[0].roughness == 0.25);
    const Mesh image = materialOf(R"("alphaMode": "MASK", "alphaCutoff": 0.2, "pbrMetallicRoughness":
        {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0],
        "scale": [2, 4], "rotation": 1.5707963267948966}}}})");
    CHECK(notesOf(image).empty());
    REQUIRE(image.materials[0].colorImage == 0);
    CHECK(image.materials[0].alpha == SurfaceMaterial::Alpha::cut);
    CHECK(image.materials[0].alphaCut == 0.2);
    // (1, 0) is scaled to (2, 0), turned to (0, -2), shifted to (0.5, -2); and v turned up.
    CHECK(glm::distance(image.uvs[1], glm::dvec2(0.5, 3)) < 1e-6);
    CHECK_THAT(notesOf(materialOf(R"("occlusionTexture": {"index": 0}, "normalTexture": {"index": 0},
        "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0, "texCoord": 1})")),
               Contains("its emissive image lies by set 0") && Contains("images of occlusion are not drawn"));
}

TEST_CASE("nodes: mirrored ones keep their front, hidden ones are left out, none lies in itself",
          "[model][gltf]") {
    const GltfText file = box();
    const auto with = [&](const std::string& nodes) {
        return file.text(
            concat(R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)", nodes, "], ", boxMesh));
    };
    const Mesh mirrored = read(with(R"({"mesh": 0, "scale": [-1, 1, 1]})"));
    checkBox(mirrored, {-1, 0, 0}, {0, 2, 3});
    CHECK(examineSurface(mirrored).volume == Approx(examineSurface(read(with(R"({"mesh": 0})"))).volume));
    checkBox(read(with(R"({"children": [1], "translation": [0, 0, 5]}, {"mesh": 0, "matrix":
        [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1]}, {"mesh": 0, "translation": [99, 0, 0]})")),
             {7, 0, 5}, {9, 2, 8});
    checkBox(read(with(R"({"children": [1, 2]}, {"mesh": 0}, {"children": [3], "extensions":
        {"KHR_node_visibility": {"visible": false}}}, {"mesh": 0, "scale": [9, 9, 9]})")),
             {0, 0, 0}, {1, 2, 3});
    CHECK_THAT(refusal(with(R"({"children": [1]}, {"children": [0]})")), Contains("lies within itself"));
    CHECK_THAT(refusal(with(R"({"children": [2]}, {"children": [2]}, {"mesh": 0})")),
               Contains("node 2 is a child of two nodes"));
    CHECK_THAT(refusal(with(R"({"mesh": 3})")), Contains("$.nodes[0].mesh") && Contains("found 3"));
    CHECK_THAT(refusal(with(R"({"mesh": 0, "rotation": [0, 0, 0, 0]})")), Contains("quaternion"));
    std::string deep;
    for (int i = 1; i < 20000; ++i)
        deep += concat("{\"children\": [", i, "]}, ");
    checkBox(read(with(deep + "{\"mesh\": 0}")), {0, 0, 0}, {1, 2, 3});
}

TEST_CASE("damaged files of glTF are one error at the place", "[model][gltf]") {
    const GltfText file = box();
    const std::string good = file.text(std::string(oneNode) + boxMesh);
    const auto instead = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        const std::string message = refusal(text.replace(at, from.size(), to));
        CHECK(message.find('\n') == std::string::npos);
        return message;
    };
    CHECK_THAT(instead("\"count\": 8", "\"count\": 9"),
               Contains("its 9 elements end beyond the 96 bytes") && Contains("$.accessors[0]"));
    CHECK_THAT(instead("\"count\": 8", "\"count\": 4000000000"), Contains("$.accessors[0].count"));
    CHECK_THAT(instead("\"count\": 8", "\"count\": 7"),
               Contains("has a triangle with vertex 7 of a mesh of 7"));
    CHECK_THAT(instead("\"byteLength\": 96", "\"byteLength\": 4294967295"), Contains("$.bufferViews[0]"));
    CHECK_THAT(instead("5126", "5127"), Contains("$.accessors[0].componentType"));
    CHECK_THAT(instead("base64,", "base64,*"), Contains("not base64"));
    CHECK_THAT(instead(";base64,", ","), Contains("expected data in base64"));
    CHECK_THAT(instead("data:application/octet-stream;base64,", "none.bin?"), Contains("$.buffers[0].uri"));
    CHECK_THAT(instead("\"2.0\"", "\"1.0\""), Contains("is of version 1.0 of glTF, expected 2.0"));
    CHECK_THAT(instead("\"POSITION\": 0", "\"POSITION\": -1"), Contains("POSITION"));
    CHECK_THAT(instead("{\"asset\"", "{\"asset"), Contains("m.gltf:1:"));
    std::vector<float> points = boxPoints;
    points[4] = std::numeric_limits<float>::quiet_NaN();
    GltfText odd;
    odd.points(points);
    odd.indices(boxTriangles);
    CHECK_THAT(refusal(odd.text(std::string(oneNode) + boxMesh)),
               Contains("vertex 1 of mesh \"box\" is not finite"));
    const std::string binary = file.binary(std::string(oneNode) + boxMesh);
    checkBox(read(binary), {0, 0, 0}, {1, 2, 3});
    for (const size_t length : {4u, 12u, 19u, 30u, unsigned(binary.size() - 1)})
        CHECK_FALSE(refusal(binary.substr(0, length)).empty());
}
