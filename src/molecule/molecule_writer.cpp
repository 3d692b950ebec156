// From a Molecule to the text of a molecule file.
#include <map>

#include "molecule/molecule_json.h"

#include "molecule/molecule_file.h"
#include "molecule/skin_file.h"

namespace shoal {

namespace {

// The value that most elements share, when at least two do.
class Common {
  public:
    void count(double value) { ++counts_[value]; }
    std::optional<double> value() const {
        std::optional<double> best;
        int most = 1;
        for (const auto& [value, count] : counts_) {
            if (count <= most) continue;
            best = value;
            most = count;
        }
        return best;
    }

  private:
    std::map<double, int> counts_;
};

struct Defaults {
    std::optional<double> mass, stiffness, damping;
    bool spelled = false;  // every element says its own

    Defaults(const Molecule& molecule, bool all) : spelled(all) {
        if (all) return;
        Common masses, stiffnesses, dampings;
        for (const Vertex& vertex : molecule.vertices)
            masses.count(vertex.mass);
        for (const Spring& spring : molecule.springs) {
            stiffnesses.count(spring.stiffness);
            dampings.count(spring.damping);
        }
        mass = masses.value();
        stiffness = stiffnesses.value();
        damping = dampings.value();
    }
};

JsonValue write(const Defaults& defaults) {
    JsonValue out = JsonValue::makeObject();
    if (defaults.mass) out.add("mass", JsonValue::makeNumber(*defaults.mass));
    if (defaults.stiffness) out.add("stiffness", JsonValue::makeNumber(*defaults.stiffness));
    if (defaults.damping) out.add("damping", JsonValue::makeNumber(*defaults.damping));
    return out;
}

JsonValue write(const Vertex& vertex, const Defaults& defaults) {
    JsonValue out = JsonValue::makeObject();
    out.add("position", JsonValue::makeVector(vertex.position));
    if (vertex.uv != glm::dvec2(0)) out.add("uv", JsonValue::makeVector(vertex.uv));
    if (vertex.mass != defaults.mass) out.add("mass", JsonValue::makeNumber(vertex.mass));
    if (vertex.pinned) out.add("pinned", JsonValue::makeBoolean(true));
    return out;
}

JsonValue write(const Spring& spring, const Defaults& defaults) {
    JsonValue out = JsonValue::makeObject();
    out.add("a", JsonValue::makeNumber(spring.a)).add("b", JsonValue::makeNumber(spring.b));
    if (spring.stiffness != defaults.stiffness) out.add("stiffness", JsonValue::makeNumber(spring.stiffness));
    if (defaults.spelled || spring.damping != defaults.damping.value_or(0))
        out.add("damping", JsonValue::makeNumber(spring.damping));
    if (spring.restLength) out.add("restLength", JsonValue::makeNumber(*spring.restLength));
    if (spring.actuation) {
        JsonValue actuation = JsonValue::makeObject();
        actuation.add("amplitude", JsonValue::makeNumber(spring.actuation->amplitude));
        actuation.add("frequency", JsonValue::makeNumber(spring.actuation->frequency));
        if (spring.actuation->phase != 0)
            actuation.add("phase", JsonValue::makeNumber(spring.actuation->phase));
        out.add("actuation", std::move(actuation));
    }
    return out;
}

JsonValue write(const Material& material) {
    JsonValue out = JsonValue::makeObject();
    const Material usual;
    const auto addNumber = [&out](const char* key, double value, double unless) {
        if (value != unless) out.add(key, JsonValue::makeNumber(value));
    };
    out.add("color", JsonValue::makeVector(material.color));
    if (material.secondColor) out.add("secondColor", JsonValue::makeVector(*material.secondColor));
    if (!material.texture.empty()) out.add("texture", JsonValue::makeString(material.texture));
    addNumber("alphaCut", material.alphaCut, usual.alphaCut);
    addNumber("translucency", material.translucency, usual.translucency);
    addNumber("roughness", material.roughness, usual.roughness);
    addNumber("metallic", material.metallic, usual.metallic);
    addNumber("pointSize", material.pointSize, usual.pointSize);
    if (material.blend == Blend::none) return out;
    out.add("blend", JsonValue::makeString(name(material.blend)));
    addNumber("opacity", material.opacity, usual.opacity);
    if (material.blend != Blend::alpha || material.sort == usual.sort) return out;
    out.add("sort", JsonValue::makeString(name(material.sort)));
    if (material.sort == DrawSort::spread)
        addNumber("spreadFrames", material.spreadFrames, usual.spreadFrames);
    return out;
}

}  // namespace

JsonValue toJson(const Molecule& molecule, bool spelled) {
    const Defaults defaults(molecule, spelled);
    JsonValue root = JsonValue::makeObject();
    root.add("format", JsonValue::makeString("shoal-molecule-1"));
    if (!molecule.name.empty()) root.add("name", JsonValue::makeString(molecule.name));
    if (!molecule.comment.empty()) root.add("comment", JsonValue::makeString(molecule.comment));
    JsonValue shared = write(defaults);
    if (!shared.members.empty()) root.add("defaults", std::move(shared));

    JsonValue vertices = JsonValue::makeArray(), springs = vertices, triangles = vertices;
    for (const Vertex& vertex : molecule.vertices)
        vertices.items.push_back(write(vertex, defaults));
    for (const Spring& spring : molecule.springs)
        springs.items.push_back(write(spring, defaults));
    for (const Triangle& t : molecule.triangles)
        triangles.items.push_back(JsonValue::makeVector(glm::dvec3(t.a, t.b, t.c)));
    root.add("vertices", std::move(vertices));
    if (!molecule.springs.empty()) root.add("springs", std::move(springs));
    if (!molecule.triangles.empty()) root.add("triangles", std::move(triangles));
    if (!molecule.skin.vertices.empty()) root.add("skin", skinJson(molecule.skin));
    root.add("material", write(molecule.material));
    return root;
}

std::string writeMolecule(const Molecule& molecule, const std::string& originalText) {
    JsonValue root = toJson(molecule, false);
    if (originalText.empty()) return writeJson(root);
    return writeJson(inOrderOf(parseJson(originalText, molecule.file), std::move(root)));
}

}  // namespace shoal
