#include <algorithm>
#include <sstream>

#include "compile/call_writer.h"
#include "compile/generate.h"
#include "core/printable.h"
#include "scene/field_kinds.h"

namespace shoal {

GeneratedFields generateFields(const std::vector<Field>& fields, std::vector<glm::vec4>& samples,
                               const glm::dvec3& near) {
    GeneratedFields out;
    CallWriter writer("fieldParameters[#]", 0, &samples);
    for (const Field& field : fields) {
        const GlslCalls calls = std::visit([&](const auto& kind) { return kind.calls(near); }, *field.shape);
        const std::string velocity = writer.text(calls);
        out.weights.push_back(writer.parameters.size());
        const std::string weight = writer.slot({}, field.weight) + ".w";
        std::string guard;
        if (field.box) {
            const std::string low = writer.fromPoint(field.box->low),
                              high = writer.fromPoint(field.box->high);
            guard = concat("if (insideBox((", low, "), (", high, "), position)) ");
        }
        out.source += concat("    ", guard, "u += ", weight, " * ", velocity, ";\n");
    }
    out.parameters = std::move(writer.parameters);
    out.clocks = std::move(writer.clocks);
    setClocks(out.parameters, out.clocks, 0);
    out.noiseTiles = std::move(writer.tiles);
    std::string tiles = out.noiseTiles.empty() ? "" : "#include \"state/noise_tile.glsl\"\n";
    for (const NoiseTile& tile : out.noiseTiles)
        tiles += concat("uniform sampler3D ", tile.sampler(), ";\n");
    out.source =
        concat("#include \"physics/field.glsl\"\n#include \"state/samples.glsl\"\n", tiles,
               parameterArray("fieldParameters", out.parameters.size()),
               "vec3 fluidVelocity(vec3 anchor, vec3 position, float time)\n{\n    vec3 u = vec3(0.0);\n",
               out.source, "    return u;\n}\n");
    return out;
}

std::vector<std::string> describeGrids(const std::vector<Field>& fields,
                                       const std::vector<NoiseTile>& noiseTiles) {
    std::vector<std::string> out;
    for (const Field& field : fields) {
        const GridField* grid = std::get_if<GridField>(&*field.shape);
        if (!grid) continue;
        std::ostringstream line;
        line << "grid " << (field.name.empty() ? "" : "\"" + printable(field.name) + "\" ") << "of "
             << grid->resolution.x << " x " << grid->resolution.y << " x " << grid->resolution.z << " cells";
        if (!grid->times.empty())
            line << ", " << grid->times.size() << " frames from " << grid->times.front() << " to "
                 << grid->times.back() << " s" << (grid->repeats ? ", again and again" : "");
        line << ": " << mebibytes(grid->values.size() * sizeof(glm::vec4));
        out.push_back(line.str());
    }
    for (const NoiseTile& tile : noiseTiles)
        out.push_back(concat("tile of ", tile.octaves > 0 ? "curl noise" : "gusts",
                             tile.octaves > 1 ? concat(" of ", tile.octaves, " octaves") : "", ", ",
                             tile.texels.x, " x ", tile.texels.y, " x ", tile.texels.z, ": ",
                             mebibytes(tile.bytes())));
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

}  // namespace shoal
