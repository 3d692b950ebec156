// Adding a field: its struct in scene/scene.h, its formula in shaders/physics/field.glsl, one overload of
// `emit` here, its reader in scene/, its double-precision twin in reference/fields.cpp, one test.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/generate.h"

namespace shoal {

namespace {

// Writes the call of one field: reads `x` (relative to the field's origin), `time`; parameters go to slots.
class FieldWriter {
  public:
    explicit FieldWriter(std::vector<glm::vec4>& samples) : samples_(&samples) {}

    GeneratedFields result;

    // Appends a 4-vector and returns the text that reads it.
    std::string slot(const glm::dvec3& v, double w = 0) {
        result.parameters.push_back(glm::vec4(glm::vec3(v), float(w)));
        return concat("fieldParameters[", result.parameters.size() - 1, "]");
    }
    std::string origin(const glm::dvec3& v) { return "(anchor - " + slot(v) + ".xyz) + position"; }

    void field(const Field& field) {
        result.source += concat("    // ", kindName(field.shape), " ", inComment(field.name), "\n");
        const std::string call = std::visit([this](const auto& shape) { return emit(shape); }, field.shape);
        result.weights.push_back(result.parameters.size());
        const std::string weight = slot({}, field.weight) + ".w";
        std::string guard;
        if (field.box) {
            const std::string low = slot(field.box->low), high = slot(field.box->high);
            guard = concat("if (insideBox(anchor, position, ", low, ".xyz, ", high, ".xyz)) ");
        }
        result.source += concat("    ", guard, "u += ", weight, " * ", call, ";\n");
    }

  private:
    std::string emit(const UniformField& f) { return slot(f.velocity) + ".xyz"; }

    std::string emit(const OscillatingField& f) {
        const std::string v = slot(f.velocity, 2 * std::numbers::pi * f.frequency);
        const std::string p = slot({f.phase, 0, 0});
        return concat("oscillatingVelocity(time, ", v, ".xyz, ", v, ".w, ", p, ".x)");
    }

    std::string emit(const GustField& f) {
        const glm::dvec3 along = glm::normalize(f.direction);
        // an axis across: horizontal unless the wind blows vertically
        const glm::dvec3 up = std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const std::string a = slot(along, f.speed),
                          b = slot(glm::normalize(glm::cross(up, along)), f.strength);
        const std::string c = slot({f.length, f.width, 0}, f.frontSpeed);
        return concat("gustVelocity(anchor + position, time, ", a, ".xyz, ", b, ".xyz, ", a, ".w, ", b,
                      ".w, ", c, ".w, ", c, ".xy, ", f.seed, "u)");
    }

    std::string emit(const ShearField& f) {
        const glm::dmat3 rows = glm::transpose(f.gradient);
        const std::string o = origin(f.origin), v = slot(f.velocity);
        const std::string x = slot(rows[0]), y = slot(rows[1]), z = slot(rows[2]);
        return concat("shearVelocity(", o, ", ", v, ".xyz, ", x, ".xyz, ", y, ".xyz, ", z, ".xyz)");
    }

    std::string emit(const VortexField& f) {
        const std::string o = origin(f.origin), a = slot(glm::normalize(f.axis), f.speed);
        const std::string r = slot({f.radius, f.lift, 0});
        return concat("vortexVelocity(", o, ", ", a, ".xyz, ", a, ".w, ", r, ".x, ", r, ".y)");
    }

    std::string emit(const AbcField& f) {
        const std::string o = origin(f.origin),
                          a = slot({f.a, f.b, f.c}, 2 * std::numbers::pi / f.wavelength);
        return concat("abcVelocity(", o, ", ", a, ".x, ", a, ".y, ", a, ".z, ", a, ".w)");
    }

    std::string emit(const TaylorGreenField& f) {
        const std::string o = origin(f.origin),
                          a = slot({f.speed, 0, 0}, 2 * std::numbers::pi / f.wavelength);
        return concat("taylorGreenVelocity(", o, ", ", a, ".x, ", a, ".w)");
    }

    std::string emit(const CurlNoiseField& f) {
        const std::string a = slot({f.speed, f.length, f.period});
        return concat("curlNoiseVelocity(anchor + position, time, ", a, ".x, ", a, ".y, ", a, ".z, ",
                      f.octaves, ", ", f.seed, "u)");
    }

    std::string emit(const GridField& f) {
        const size_t base = samples_->size();
        samples_->reserve(base + f.values.size());
        for (const glm::vec3& value : f.values)
            samples_->emplace_back(value, 0.0f);
        const glm::dvec3 perMetre = glm::dvec3(f.resolution) / (f.high - f.low);
        const std::string o = origin(f.low), scale = slot(perMetre);
        return concat("gridVelocity(", o, ", ", scale, ".xyz, ivec3(", f.resolution.x, ", ", f.resolution.y,
                      ", ", f.resolution.z, "), ", base, ", ", f.wrap ? "true" : "false", ")");
    }

    std::vector<glm::vec4>* samples_;
};

}  // namespace

GeneratedFields generateFields(const std::vector<Field>& fields, std::vector<glm::vec4>& samples) {
    FieldWriter writer(samples);
    for (const Field& field : fields)
        writer.field(field);
    GeneratedFields out = std::move(writer.result);
    out.source =
        concat("#include \"physics/field.glsl\"\n#include \"lib/samples.glsl\"\n",
               parameterArray("fieldParameters", out.parameters.size()),
               "vec3 fluidVelocity(vec3 anchor, vec3 position, float time)\n{\n    vec3 u = vec3(0.0);\n",
               out.source, "    return u;\n}\n");
    return out;
}

std::string parameterArray(const std::string& name, size_t count) {
    const std::string capital = concat(char(name[0] - 'a' + 'A'), name.substr(1));
    std::string load;
    for (size_t i = 0; i < count; ++i)
        load += concat("    ", name, "[", i, "] = inRegister(given", capital, "[", i, "]);\n");
    return concat("#ifdef FUSED\nuniform vec4 given", capital, "[", count, "];\nvec4 ", name, "[", count,
                  "];\n\nvoid load", capital, "()\n{\n", load, "}\n#else\nuniform vec4 ", name, "[", count,
                  "];\n#endif\n\n");
}

std::string inComment(const std::string& name) {
    std::string out = name;
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c < ' ' || c > '~' || c == '\\'; }, '?');
    return out;
}

const char* kindName(const FieldShape& shape) {
    static constexpr const char* names[] = {"uniform", "oscillating", "gust",      "shear", "vortex",
                                            "abc",     "taylorGreen", "curlNoise", "grid"};
    return names[shape.index()];
}

}  // namespace shoal
