// Chooses the reader of a model file and runs it in a child process.
#include <algorithm>
#include <cmath>

#include "core/activity.h"
#include "core/cache_folder.h"
#include "core/confined.h"
#include "core/error.h"
#include "core/file.h"
#include "geometry/mesh.h"
#include "geometry/model_reader.h"

namespace shoal {

namespace {

Mesh readModel(const ModelFile& model) {
    static constexpr std::pair<const char*, Mesh (*)(const ModelFile&)> readers[] = {
        {".3mf", read3mf}, {".glb", readGltf}, {".gltf", readGltf}, {".obj", readObj},
        {".off", readOff}, {".ply", readPly},  {".xyz", readXyz}};
    const std::string ending = lowerExtension(model.name);
    const auto own = std::find_if(std::begin(readers), std::end(readers),
                                  [&](const auto& reader) { return ending == reader.first; });
    Mesh mesh = own == std::end(readers) ? readWithAssimp(model) : own->second(model);
    if (mesh.positions.empty()) throw Error(Location{model.name}, noTriangles);
    if (mesh.triangles.empty())
        mesh.notes.push_back(concat("it is a cloud of ",
                                    many(int64_t(mesh.positions.size()), "point", "points"),
                                    " without triangles, of which nothing is drawn"));
    return mesh;
}

// Names end in a zero byte; the numbers are the first triangles and their counts, in the same order.
struct Names {
    std::vector<char> text;
    std::vector<int> numbers;
    size_t offset = 0;  // in the text, of the next name

    void add(const std::string& name) {
        text.insert(text.end(), name.c_str(), name.c_str() + name.size() + 1);
    }
    std::string next() {
        const auto end = std::find(text.begin() + std::ptrdiff_t(offset), text.end(), '\0');
        std::string out(text.begin() + std::ptrdiff_t(offset), end);
        offset = std::min(offset + out.size() + 1, text.size());
        return out;
    }
};

void put(ToParent& parent, const Mesh& mesh) {
    parent.put(mesh.positions);
    parent.put(mesh.normals);
    parent.put(mesh.colors);
    parent.put(mesh.uvs);
    parent.put(mesh.triangles);
    Names objects, parts;
    for (const Mesh::Object& object : mesh.objects) {
        objects.add(object.name);
        objects.numbers.insert(objects.numbers.end(), {object.firstTriangle, object.triangleCount});
    }
    for (const Mesh::Part& part : mesh.parts) {
        parts.add(part.mesh);
        parts.add(part.material);
        parts.numbers.insert(parts.numbers.end(), {part.firstTriangle, part.triangleCount, part.look});
    }
    const auto listed = [](const std::vector<std::string>& texts) {
        Names out;
        for (const std::string& text : texts)
            out.add(text);
        out.numbers = {int(texts.size())};
        return out;
    };
    parent.put(mesh.bones);
    for (const Names& names :
         {objects, parts, listed(mesh.notes), listed(mesh.losses), listed(mesh.boneNames)}) {
        parent.put(names.text);
        parent.put(names.numbers);
    }
    parent.put(mesh.materials);
    std::vector<glm::ivec2> sizes;
    for (const Image& image : mesh.images)
        sizes.emplace_back(image.width, image.height);
    parent.put(sizes);
    for (const Image& image : mesh.images)
        parent.put(image.pixels);
}

// The child's memory may be another's by now: nothing that it says is taken for granted.
void checkWhole(const Mesh& mesh, const Location& location) {
    const size_t count = mesh.positions.size();
    const auto fits = [&](int first, int triangles) {
        return first >= 0 && triangles >= 0 && size_t(first) + size_t(triangles) <= mesh.triangles.size();
    };
    bool whole = count <= mostElements && mesh.triangles.size() <= mostElements && count > 0 &&
                 mesh.normals.size() == count && (mesh.colors.empty() || mesh.colors.size() == count) &&
                 (mesh.uvs.empty() || mesh.uvs.size() == count) &&
                 (mesh.bones.empty() || mesh.bones.size() == count);
    for (const int bone : mesh.bones)
        whole = whole && bone >= -1 && bone < int(mesh.boneNames.size());
    for (const glm::ivec3& t : mesh.triangles)
        whole = whole && std::min({t.x, t.y, t.z}) >= 0 && size_t(std::max({t.x, t.y, t.z})) < count;
    for (const auto* vectors : {&mesh.positions, &mesh.normals, &mesh.colors})
        for (const glm::dvec3& v : *vectors)
            whole = whole && isFinite(v);
    for (const Mesh::Object& object : mesh.objects)
        whole = whole && fits(object.firstTriangle, object.triangleCount);
    for (const Mesh::Part& part : mesh.parts)
        whole = whole && fits(part.firstTriangle, part.triangleCount) && part.look >= -1 &&
                part.look < int(mesh.materials.size());
    for (const Image& image : mesh.images)
        whole = whole && std::min(image.width, image.height) > 0 &&
                std::max(image.width, image.height) <= largestModelImage &&
                image.pixels.size() == size_t(image.width) * size_t(image.height) * 4;
    for (const SurfaceMaterial& look : mesh.materials) {
        for (const int image : {look.colorImage, look.emissiveImage, look.normalImage, look.roughnessImage})
            whole = whole && image >= -1 && image < int(mesh.images.size());
        for (const double number :
             {look.color.r, look.color.g, look.color.b, look.color.a, look.emissive.r, look.emissive.g,
              look.emissive.b, look.metallic, look.roughness, look.normalScale, look.alphaCut})
            whole = whole && std::isfinite(number);
        whole = whole && int(look.alpha) >= 0 && int(look.alpha) <= int(SurfaceMaterial::Alpha::blend);
    }
    if (!whole) throw Error(location, "cannot be read: its reader went astray");
}

Mesh readConfined(const std::string& file) {
    const Location location{file};
    Confined child(location, ConfinedLimits{}, [&](ToParent& parent) {
        put(parent, readModel({file, [&](uint64_t bytes) { parent.opened(bytes); }}));
    });
    Mesh mesh;
    mesh.positions = child.get<glm::dvec3>();
    mesh.normals = child.get<glm::dvec3>();
    mesh.colors = child.get<glm::dvec3>();
    mesh.uvs = child.get<glm::dvec2>();
    mesh.triangles = child.get<glm::ivec3>();
    mesh.bones = child.get<int>();
    Names objects{child.get<char>(), child.get<int>()};
    for (size_t i = 0; i + 1 < objects.numbers.size(); i += 2)
        mesh.objects.push_back({objects.next(), objects.numbers[i], objects.numbers[i + 1]});
    Names parts{child.get<char>(), child.get<int>()};
    for (size_t i = 0; i + 2 < parts.numbers.size(); i += 3) {
        std::string name = parts.next(), material = parts.next();
        mesh.parts.push_back({std::move(name), std::move(material), parts.numbers[i], parts.numbers[i + 1],
                              parts.numbers[i + 2]});
    }
    for (std::vector<std::string>* texts : {&mesh.notes, &mesh.losses, &mesh.boneNames}) {
        Names names{child.get<char>(), child.get<int>()};
        for (int i = 0;
             !names.numbers.empty() && i < names.numbers.front() && names.offset < names.text.size(); ++i)
            texts->push_back(names.next());
    }
    mesh.materials = child.get<SurfaceMaterial>();
    for (const glm::ivec2& size : child.get<glm::ivec2>())
        mesh.images.push_back({size.x, size.y, 4, {}});
    for (Image& image : mesh.images)
        image.pixels = child.get<uint8_t>();
    checkWhole(mesh, location);
    return mesh;
}

// Makes opaque what is to be blended and hides all that is behind it: opacity 1 and no texel that is less.
void dropIdleBlends(Mesh& mesh) {
    const auto hasHoles = [](const Image& image) {
        for (size_t i = 3; image.channels == 4 && i < image.pixels.size(); i += 4)
            if (image.pixels[i] < 255) return true;
        return false;
    };
    for (SurfaceMaterial& look : mesh.materials) {
        const bool blends = look.alpha == SurfaceMaterial::Alpha::blend && look.refraction <= 1;
        if (!blends || look.color.a < 1) continue;
        if (look.colorImage >= 0 && hasHoles(mesh.images[size_t(look.colorImage)])) continue;
        look.alpha = SurfaceMaterial::Alpha::opaque;
    }
}

}  // namespace

void tellOfRounding(Mesh& mesh) {
    if (mesh.positions.empty()) return;
    glm::dvec3 low = mesh.positions.front(), high = low;
    for (const glm::dvec3& p : mesh.positions)
        low = glm::min(low, p), high = glm::max(high, p);
    const glm::dvec3 reach = glm::max(glm::abs(low), glm::abs(high));
    const double farthestAway = std::max({reach.x, reach.y, reach.z}), size = glm::distance(low, high);
    const double rounding = std::ldexp(farthestAway, -24);  // half the way to the next number, at most
    constexpr double told = 1e-6, lost = 1e-4;              // of the size; vertices within `told` are one
    if (!(rounding > told * size)) return;
    (rounding > lost * size ? mesh.losses : mesh.notes)
        .push_back(
            concat("its coordinates reach ", farthestAway,
                   " m, too far for the single precision in which this format is read: they are rounded "
                   "by up to ",
                   rounding, " m, of a size of ", size,
                   " m; move it to the origin, or save it as OBJ, which is read in double precision"));
}

Mesh loadMesh(const std::string& file, bool lenient) {
    const FileReader readable(file);  // says what is no file, or cannot be opened
    const bool trusted = !environment("SHOAL_TRUST_MODELS").empty();
    const Activity reading(concat("reading ", file));
    Mesh mesh = trusted ? readModel({file, [](uint64_t) {}}) : readConfined(file);
    if (!lenient && !mesh.losses.empty())
        throw Error(Location{file}, mesh.losses.front(), " (--lenient reads it all the same)");
    mesh.notes.insert(mesh.notes.begin(), mesh.losses.begin(), mesh.losses.end());
    mesh.losses.clear();
    completeMesh(mesh);
    dropIdleBlends(mesh);
    return mesh;
}

}  // namespace shoal
