#include "exchange/usda.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <set>

#include "core/error.h"
#include "exchange/usda_materials.h"
#include "exchange/usda_text.h"

namespace shoal::exchange {

namespace fs = std::filesystem;
using usda::list, usda::text;

namespace {

// A name as USD takes it.
std::string identifier(const std::string& name) {
    std::string out;
    for (const char c : name)
        out += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    if (out.empty() || std::isdigit(static_cast<unsigned char>(out[0]))) out = "_" + out;
    return out;
}

// Text that may be too long for memory: appended to a file without a name, and copied in the end.
class Spool {
  public:
    // The file without a name lies in the folder of `target`, the file that it becomes a part of.
    explicit Spool(const fs::path& target) : file_(unnamedFile(target)) {}
    void add(const std::string& piece) {
        if (std::fwrite(piece.data(), 1, piece.size(), file_.get()) != piece.size())
            throw Error("a temporary file cannot be written: is the disk full?");
        empty_ = false;
    }
    bool empty() const { return empty_; }
    void copyTo(FileWriter& out) {
        std::rewind(file_.get());
        std::array<char, 65536> block;
        for (size_t count; (count = std::fread(block.data(), 1, block.size(), file_.get())) > 0;)
            out.write(block.data(), count);
    }

  private:
    FilePointer file_;
    bool empty_ = true;
};

constexpr const char* countsOf = "int[] faceVertexCounts";

// An attribute whose values are sampled.
struct Sampled {
    const char* declaration;    // its type and name
    const char* interpolation;  // of a primvar or normals; empty: none
};
constexpr Sampled attributes[] = {
    {"point3f[] points", ""},
    {"normal3f[] normals", "vertex"},
    {"vector3f[] velocities", ""},
    {"float3[] extent", ""},
    {"int[] faceVertexIndices", ""},
    {countsOf, ""},
    {"color3f[] primvars:displayColor", "vertex"},
    {"point3f[] positions", ""},
    {"quath[] orientations", ""},
    {"texCoord2f[] primvars:st", "vertex"},
    {"float[] primvars:displayOpacity", "vertex"},
    {"float[] widths", "vertex"},
};
constexpr size_t attributeCount = std::size(attributes);

std::string interpolated(const char* how) {
    return *how != 0 ? concat(" (\n            interpolation = \"", how, "\"\n        )") : std::string();
}

}  // namespace

struct UsdStage::Parts {
    struct Moving {
        std::string name, head;  // all that is not sampled, to the closing brace
        const char* kind = "";
        glm::dvec3 origin{0};  // m
        std::array<std::unique_ptr<Spool>, attributeCount> samples;
        std::string frame;  // of clips: this frame's samples
        std::set<size_t> used;
    };

    fs::path file;    // the stage's own
    fs::path frames;  // folder of clips; empty: none
    double rate;
    std::string body;
    UsdMaterials materials{{}};
    std::deque<Moving> moving;
    std::set<std::string> names;
    std::vector<std::string> written;
    int first = 0, last = -1;
    bool finished = false;

    std::string uniqueName(const std::string& wanted) {
        const std::string base = identifier(wanted);
        std::string out = base;
        for (int i = 2; !names.insert(out).second; ++i)
            out = concat(base, "_", i);
        return out;
    }

    void note(const fs::path& path) { written.push_back(path.string()); }

    static std::string line(const std::string& words) { return "        " + words + "\n"; }
    static std::string counts(size_t corners) {
        std::string out = "[";
        for (size_t i = 0; i < corners; i += 3)
            out += i > 0 ? ",3" : "3";
        return out + "]";
    }

    // All of a mesh that is not where it is.
    std::string topology(const DrawnMesh& mesh, bool changes, bool colors) {
        std::string out;
        if (mesh.corners.empty()) return out;
        if (!changes) {
            out += line(concat(countsOf, " = ", counts(mesh.corners.size())));
            out += line("int[] faceVertexIndices = " + list(mesh.corners));
        }
        out += line("uniform token subdivisionScheme = \"none\"");
        out += line("uniform bool doubleSided = 1");
        if (!mesh.uvs.empty() && !changes)
            out += line("texCoord2f[] primvars:st = " + list(mesh.uvs) + interpolated("vertex"));
        if (!mesh.colors.empty() && colors)
            out += line("color3f[] primvars:displayColor = " + list(mesh.colors) + interpolated("vertex"));
        if (mesh.pieces.size() == 1) {
            out += line("rel material:binding = <" + materials.add(mesh, mesh.pieces[0].material) + ">");
            return out;
        }
        for (size_t i = 0; i < mesh.pieces.size(); ++i) {
            const DrawnMesh::Piece& piece = mesh.pieces[i];
            std::vector<uint32_t> faces;
            for (size_t f = piece.first / 3; f < (piece.first + piece.count) / 3; ++f)
                faces.push_back(uint32_t(f));
            out += concat(
                "        def GeomSubset \"piece", i,
                "\" (\n            prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
                "        )\n        {\n            uniform token elementType = \"face\"\n"
                "            uniform token familyName = \"materialBind\"\n            int[] indices = ",
                list(faces), "\n            rel material:binding = <", materials.add(mesh, piece.material),
                ">\n        }\n");
        }
        return out;
    }

    // Where a prim's own places begin.
    static std::string moved(const glm::dvec3& origin) {
        if (origin == glm::dvec3(0)) return {};
        return line(concat("double3 xformOp:translate = (", text(origin.x), ", ", text(origin.y), ", ",
                           text(origin.z), ")")) +
               line("uniform token[] xformOpOrder = [\"xformOp:translate\"]");
    }

    static std::string prim(const char* kind, const std::string& name) {
        return concat("    def ", kind, " \"", name,
                      "\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {\n");
    }

    void sampleOf(Moving& prim, size_t attribute, int frame, const std::string& values) {
        prim.used.insert(attribute);
        if (!frames.empty()) {
            prim.frame += concat("        ", attributes[attribute].declaration,
                                 ".timeSamples = {\n            ", frame, ": ", values, ",\n        }\n");
            return;
        }
        std::unique_ptr<Spool>& spool = prim.samples[attribute];
        if (!spool) spool = std::make_unique<Spool>(file);
        spool->add(concat("            ", frame, ": ", values, ",\n"));
    }

    std::string head() const {
        return concat(
            "#usda 1.0\n(\n    defaultPrim = \"scene\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n    "
            "startTimeCode = ",
            first, "\n    endTimeCode = ", std::max(first, last), "\n    timeCodesPerSecond = ", rate,
            "\n    framesPerSecond = ", rate, "\n)\n\n");
    }

    std::string frameName(int frame) const {
        char digits[32];
        std::snprintf(digits, sizeof digits, "-%05d.usda", frame);
        return file.stem().string() + digits;
    }

    // The dictionary by which a prim takes its samples from the frames' files.
    std::string clips(const std::string& name) const {
        std::string paths, active, times;
        for (int frame = first; frame <= last; ++frame) {
            const char* between = frame > first ? ", " : "";
            paths += concat(between, "@./", frames.filename().string(), "/", frameName(frame), "@");
            active += concat(between, "(", frame, ", ", frame - first, ")");
            times += concat(between, "(", frame, ", ", frame, ")");
        }
        return concat(
            "        clips = {\n            dictionary default = {\n                double2[] active = [",
            active, "]\n                asset[] assetPaths = [", paths,
            "]\n                asset manifestAssetPath = @./", frames.filename().string(),
            "/manifest.usda@\n                string primPath = \"/scene/", name,
            "\"\n                double2[] times = [", times, "]\n            }\n        }\n");
    }
};

UsdStage::UsdStage(const fs::path& target, double frameRate) : parts_(std::make_unique<Parts>()) {
    parts_->rate = frameRate;
    if (lowerExtension(target) == ".usda") {
        parts_->file = target;
    } else {
        const std::string name = fs::absolute(target).lexically_normal().filename().string();
        parts_->file = target / (name.empty() ? "scene.usda" : name + ".usda");
        parts_->frames = target / "frames";
    }
    parts_->names = {"materials"};
    checkWritable(parts_->file);
    parts_->materials = UsdMaterials(parts_->file);
}

UsdStage::~UsdStage() {
    if (parts_->finished) return;
    std::error_code ignored;
    for (const std::string& file : parts_->written)
        fs::remove(file, ignored);
    for (const std::string& file : parts_->materials.images())
        fs::remove(file, ignored);
    if (!parts_->frames.empty()) {  // the folders as well, where they are empty
        fs::remove(parts_->frames, ignored);
        fs::remove(parts_->frames.parent_path(), ignored);
    }
}

const std::vector<std::string>& UsdStage::written() const {
    return parts_->written;
}

void UsdStage::add(const DrawnMesh& mesh) {
    Parts& p = *parts_;
    p.body += Parts::prim("Mesh", p.uniqueName(mesh.name)) + p.topology(mesh, false, true) +
              Parts::line("point3f[] points = " + list(mesh.positions));
    if (!mesh.normals.empty())
        p.body += Parts::line("normal3f[] normals = " + list(mesh.normals) + interpolated("vertex"));
    p.body += Parts::moved(mesh.origin);
    p.body += "    }\n";
}

void UsdStage::add(const Camera& camera) {
    const glm::dmat3 directions = directionsOf(camera);
    std::string matrix = "(";
    for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 3; ++i)
            matrix += (i == 0 ? " (" : ", ") + text(directions[row][i]);
        matrix += ", 0),";
    }
    matrix += " (" + text(camera.eye.x) + ", " + text(camera.eye.y) + ", " + text(camera.eye.z) + ", 1) )";
    constexpr double aperture = 24;  // mm, of a film's height
    parts_->body += concat(
        "    def Camera \"", parts_->uniqueName("camera"),
        "\"\n    {\n        float verticalAperture = ", aperture,
        "\n        float horizontalAperture = ", aperture * 16 / 9,
        "\n        float focalLength = ", aperture / 2 / std::tan(camera.fieldOfView / 2),
        "\n        float2 clippingRange = (0.01, 10000)\n        matrix4d xformOp:transform = ", matrix,
        "\n        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }\n");
}

// The looks of points that do not change; dots of so many pixels have a width that no one sees.
static std::string pointLooks(const DrawnMesh& mesh, bool change) {
    std::string out;
    if (mesh.sizes.empty())
        out += "        float[] widths = [0.01]" + interpolated("constant") + "\n";
    else if (!change)
        out += "        float[] widths = " + list(mesh.sizes) + interpolated("vertex") + "\n";
    if (change) return out;
    out += "        color3f[] primvars:displayColor = " + list(mesh.colors) + interpolated("vertex") + "\n";
    if (!mesh.opacities.empty())
        out += "        float[] primvars:displayOpacity = " + list(mesh.opacities) + interpolated("vertex") +
               "\n";
    return out;
}

size_t UsdStage::addMoving(const DrawnMesh& mesh, const UsdMoving& how) {
    Parts& p = *parts_;
    Parts::Moving& prim = p.moving.emplace_back();
    prim.name = p.uniqueName(mesh.name);
    prim.kind = !how.instances.empty() ? "PointInstancer" : mesh.corners.empty() ? "Points" : "Mesh";
    if (!how.instances.empty()) {
        const std::vector<uint32_t> zeros(how.instances.size(), 0);
        std::vector<glm::vec3> scales;
        for (const float scale : how.instances)
            scales.emplace_back(scale);
        prim.head = Parts::line("int[] protoIndices = " + list(zeros)) +
                    Parts::line("float3[] scales = " + list(scales)) +
                    Parts::line("rel prototypes = </scene/" + prim.name + "/molecule>") +
                    (how.looksChange ? std::string()
                                     : Parts::line("color3f[] primvars:displayColor = " + list(how.colors) +
                                                   interpolated("vertex"))) +
                    Parts::prim("Mesh", "molecule") + p.topology(mesh, false, false) +
                    Parts::line("point3f[] points = " + list(mesh.positions)) +
                    Parts::line("normal3f[] normals = " + list(mesh.normals) + interpolated("vertex")) +
                    "    }\n";
    } else if (mesh.corners.empty()) {
        prim.head =
            pointLooks(mesh, how.looksChange) +
            Parts::line("rel material:binding = <" + p.materials.add(mesh, mesh.pieces[0].material) + ">");
    } else {
        prim.head = p.topology(mesh, how.changes, !how.looksChange);
    }
    prim.origin = how.origin;
    prim.head += Parts::moved(how.origin);
    return p.moving.size() - 1;
}

void UsdStage::sample(size_t moving, int frame, const UsdSample& sample) {
    Parts& p = *parts_;
    Parts::Moving& prim = p.moving[moving];
    const auto put = [&](size_t attribute, const auto& values) {
        if (!values.empty()) p.sampleOf(prim, attribute, frame, list(values));
    };
    enum {
        points,
        normals,
        velocities,
        extent,
        indices,
        counts,
        colors,
        positions,
        orientations,
        uvs,
        opacities,
        widths
    };
    const bool instances = prim.kind == std::string_view("PointInstancer");
    std::vector<glm::dvec3> places = sample.points;
    for (glm::dvec3& place : places)
        place -= prim.origin;
    p.sampleOf(prim, instances ? positions : points, frame, list(places));
    put(normals, sample.normals);
    put(velocities, sample.velocities);
    put(orientations, sample.turns);
    put(indices, sample.corners);
    if (!sample.corners.empty()) p.sampleOf(prim, counts, frame, Parts::counts(sample.corners.size()));
    put(colors, sample.colors);
    put(uvs, sample.uvs);
    put(opacities, sample.opacities);
    put(widths, sample.widths);
    if (instances || places.empty()) return;
    glm::dvec3 low = places[0], high = low;
    for (const glm::dvec3& x : places)
        low = glm::min(low, x), high = glm::max(high, x);
    p.sampleOf(prim, extent, frame, list(std::array{low, high}));
}

void UsdStage::endFrame(int frame) {
    Parts& p = *parts_;
    if (p.last < p.first) p.first = frame;
    p.last = frame;
    if (p.frames.empty()) return;
    std::string out = "#usda 1.0\n(\n    defaultPrim = \"scene\"\n)\n\nover \"scene\"\n{\n";
    for (Parts::Moving& prim : p.moving) {
        out += concat("    over \"", prim.name, "\"\n    {\n", prim.frame, "    }\n");
        prim.frame.clear();
    }
    const fs::path file = p.frames / p.frameName(frame);
    writeFile(file, out + "}\n");
    p.note(file);
}

void UsdStage::finish() {
    Parts& p = *parts_;
    p.written.insert(p.written.end(), p.materials.images().begin(), p.materials.images().end());
    if (!p.frames.empty()) {
        std::string manifest = "#usda 1.0\n(\n    defaultPrim = \"scene\"\n)\n\nover \"scene\"\n{\n";
        for (const Parts::Moving& prim : p.moving) {
            manifest += concat("    over \"", prim.name, "\"\n    {\n");
            for (const size_t attribute : prim.used)
                manifest += Parts::line(attributes[attribute].declaration);
            manifest += "    }\n";
        }
        writeFile(p.frames / "manifest.usda", manifest + "}\n");
        p.note(p.frames / "manifest.usda");
    }
    FileWriter out(p.file);
    const auto write = [&](const std::string& piece) { out.write(piece.data(), piece.size()); };
    write(p.head() + "def Xform \"scene\"\n{\n" + p.body);
    for (Parts::Moving& prim : p.moving) {
        write(concat("    def ", prim.kind, " \"", prim.name,
                     "\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n",
                     p.frames.empty() ? "" : p.clips(prim.name), "    )\n    {\n", prim.head));
        for (size_t i = 0; i < attributeCount; ++i) {
            if (!prim.used.contains(i)) continue;
            const std::string how = interpolated(attributes[i].interpolation);
            if (!how.empty()) write(concat("        ", attributes[i].declaration, how, "\n"));
            if (!prim.samples[i]) continue;
            write(concat("        ", attributes[i].declaration, ".timeSamples = {\n"));
            prim.samples[i]->copyTo(out);
            write("        }\n");
        }
        write("    }\n");
    }
    if (!p.materials.text().empty())
        write("    def Scope \"materials\"\n    {\n" + p.materials.text() + "    }\n");
    write("}\n");
    out.finish();
    p.note(p.file);
    p.finished = true;
}

}  // namespace shoal::exchange
