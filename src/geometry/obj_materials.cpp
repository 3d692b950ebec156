#include "geometry/obj_materials.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>

#include "core/file.h"
#include "geometry/classic_material.h"
#include "geometry/obj_text.h"
#include "geometry/tiny_obj.h"

namespace shoal {

namespace {

namespace fs = std::filesystem;
using Placement = ObjMaterials::Placement;

// The library tells neither a key that is left out from one that is 0 nor, in one of its versions, a name
// with blanks: so names and keys are listed here.
struct Listed {
    std::string name;
    std::set<std::string> keys;
};

// The materials of a file, in their order.
std::vector<Listed> listed(const std::string& text) {
    std::vector<Listed> out;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key, value;
        words >> key >> value;
        if (key == "newmtl" && !value.empty()) {
            out.push_back(
                {std::string(trimmed(std::string_view(line).substr(line.find(key) + key.size()))), {}});
        } else if (!key.empty() && key[0] != '#' && !out.empty()) {
            const bool number = key[0] == 'K' || key == "d" || key == "Tr" || key[0] == 'N' || key[0] == 'P';
            std::vector<double> values;
            if (number && !(readNumbers(value, values) && values.size() == 1)) key = "!" + key;
            out.back().keys.insert(key);
        }
    }
    return out;
}

class MaterialReader {
  public:
    MaterialReader(const tinyobj::material_t& from, const Listed& listed, ModelImages& images, Mesh& mesh)
        : from_(from), name_(listed.name), keys_(listed.keys), images_(images), mesh_(mesh) {}

    SurfaceMaterial read() {
        SurfaceMaterial out;
        out.colorImage = imageOf("colour", "map_Kd", from_.diffuse_texname, from_.diffuse_texopt);
        readColor(out);
        readSurface(out);
        const int mask = imageOf("opacity", "map_d", from_.alpha_texname, from_.alpha_texopt);
        const double opacity = given("d") || given("Tr") ? share(from_.dissolve).value_or(1) : 1;
        setOpacity(out, opacity, mask, images_, mesh_.images, [&](const std::string& what) { note(what); });
        setRefraction(out, from_.ior);
        tellDropped();
        return out;
    }

    Placement placement() const { return placement_.value_or(Placement{}); }

  private:
    void note(const std::string& what) { mesh_.notes.push_back(concat("material \"", name_, "\": ", what)); }
    bool given(const char* key) const { return keys_.count(key) > 0; }

    static std::optional<double> share(double value) {
        if (!std::isfinite(value)) return std::nullopt;
        return std::clamp(value, 0.0, 1.0);
    }
    std::optional<glm::dvec3> color(const char* key, const double* c) const {
        if (!given(key) || !std::isfinite(c[0] + c[1] + c[2])) return std::nullopt;
        return glm::max(glm::dvec3(c[0], c[1], c[2]), 0.0);
    }

    void readColor(SurfaceMaterial& out) {
        std::optional<glm::dvec3> base = color("Kd", from_.diffuse);
        if (base == glm::dvec3(0) && out.colorImage >= 0) base.reset();  // as exporters leave it
        out.color = glm::dvec4(glm::min(base.value_or(glm::dvec3(1)), 1.0), 1);
        out.emissive = color("Ke", from_.emission).value_or(glm::dvec3(0));
        out.emissiveImage = imageOf("emissive", "map_Ke", from_.emissive_texname, from_.emissive_texopt);
        if (out.emissive == glm::dvec3(0) && out.emissiveImage >= 0) out.emissive = glm::dvec3(1);
    }

    void readSurface(SurfaceMaterial& out) {
        const int roughness = imageOf("roughness", "map_Pr", from_.roughness_texname, from_.roughness_texopt);
        const int metallic = imageOf("metallic", "map_Pm", from_.metallic_texname, from_.metallic_texopt);
        out.metallic = share(given("Pm") ? from_.metallic : metallic >= 0 ? 1 : 0).value_or(0);
        if (given("Pr"))
            out.roughness = share(from_.roughness).value_or(out.roughness);
        else if (roughness >= 0)
            out.roughness = 1;
        else if (given("Ns") && from_.shininess > 0)
            out.roughness = roughnessOfExponent(from_.shininess);
        out.roughnessImage = images_.roughAndMetallic(roughness, metallic);
        out.normalImage = imageOf("normal", "norm", from_.normal_texname, from_.normal_texopt);
        if (out.normalImage >= 0 && std::isfinite(from_.normal_texopt.bump_multiplier))
            out.normalScale = from_.normal_texopt.bump_multiplier;
    }

    // The number of an image; -1: there is none, or it cannot be read.
    int imageOf(const char* what, const char* key, const std::string& name,
                const tinyobj::texture_option_t& options) {
        if (name.empty()) {
            if (given(key)) note(concat("its ", what, " image is left out: its line names no file"));
            return -1;
        }
        const Placement lies{{options.scale[0], options.scale[1]},
                             {options.origin_offset[0], options.origin_offset[1]}};
        if (!placement_) placement_ = lies;
        if (!(*placement_ == lies))
            note(concat("its ", what, " image lies where its first image does, not by its own -s and -o"));
        const bool plainly = options.brightness == 0 && options.contrast == 1 && !options.clamp &&
                             options.turbulence[0] == 0 && options.turbulence[1] == 0;
        if (!plainly) note(concat("its ", what, " image is drawn without its -mm, -clamp and -t"));
        return images_.fromFile(
            name, [&](const std::string& why) { note(concat("its ", what, " image is left out: ", why)); });
    }

    void tellDropped() {
        DroppedImages dropped;
        const std::pair<const std::string&, const char*> kinds[] = {
            {from_.bump_texname, "bumps"},
            {from_.displacement_texname, "displacement"},
            {from_.specular_texname, "specular"},
            {from_.specular_highlight_texname, "shininess"},
            {from_.reflection_texname, "reflection"},
            {from_.sheen_texname, "sheen"}};
        for (const auto& [name, kind] : kinds)
            if (!name.empty()) dropped.add(kind);
        for (const auto& [key, value] : from_.unknown_parameter)
            if (key.starts_with("map_") || key == "decal") dropped.add(concat("\"", key, "\""));
        if (!dropped.kinds.empty()) note(dropped.note());
        for (const std::string& key : keys_)
            if (key[0] == '!') note(concat("its \"", key.substr(1), "\" is no number, and left out"));
    }

    const tinyobj::material_t& from_;
    const std::string& name_;
    const std::set<std::string>& keys_;
    ModelImages& images_;
    Mesh& mesh_;
    std::optional<Placement> placement_;
};

}  // namespace

ObjMaterials::ObjMaterials(const ModelFile& model, Mesh& mesh)
    : model_(model), mesh_(mesh), images_(model, mesh.images) {}

void ObjMaterials::readLibraries(const std::string& names) {
    named_ = true;
    const fs::path folder = fs::path(model_.name).parent_path();
    std::error_code code;
    const auto found = [&](const std::string& name) -> fs::path {
        std::string plain = name;
        std::replace(plain.begin(), plain.end(), '\\', '/');
        for (const fs::path& file : {folder / plain, folder / fs::path(plain).filename()})
            if (mayOpen(file) && fs::is_regular_file(file, code)) return file;
        return {};
    };
    std::vector<std::string> files;
    if (!found(names).empty()) {
        files.push_back(names);
    } else {
        std::istringstream words(names);
        for (std::string name; words >> name;)
            files.push_back(name);
    }
    // Models are renamed together with their materials.
    const std::string renamed = fs::path(model_.name).stem().string() + ".mtl";
    if (files.size() == 1 && found(files[0]).empty() && !found(renamed).empty()) files[0] = renamed;
    for (const std::string& name : files) {
        if (const fs::path file = found(name); !file.empty())
            readLibrary(file.string());
        else
            mesh_.notes.push_back(
                concat("its materials are left out: there is no file \"", name, "\" beside the model"));
    }
}

void ObjMaterials::readLibrary(const std::string& name) {
    const std::string text = readFile(name);
    model_.opened(text.size());
    std::istringstream stream(text);
    std::map<std::string, int> names;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    tinyobj::LoadMtl(&names, &materials, &stream, &warning, &error);
    const std::vector<Listed> all = listed(text);
    for (size_t i = 0; i < materials.size() && i < all.size(); ++i) {
        if (!numbers_.try_emplace(all[i].name, int(mesh_.materials.size())).second) continue;
        MaterialReader reader(materials[i], all[i], images_, mesh_);
        mesh_.materials.push_back(reader.read());
        placements_.push_back(reader.placement());
    }
}

int ObjMaterials::numberOf(const std::string& name) {
    const auto known = numbers_.find(name);
    if (known != numbers_.end()) return known->second;
    if (named_ && !name.empty())
        mesh_.notes.push_back(concat("its files of materials hold no \"", name, "\""));
    numbers_[name] = -1;
    return -1;
}

ObjMaterials::Placement ObjMaterials::placementOf(int number) const {
    return number < 0 ? Placement{} : placements_[size_t(number)];
}

}  // namespace shoal
