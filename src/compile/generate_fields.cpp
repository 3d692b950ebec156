// Adding a field: its struct in scene/field.h, its formula in shaders/physics/field.glsl, one overload of
// `emit` here, its reader in scene/, its double-precision twin in reference/fields.cpp, one test.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "compile/generate.h"
#include "compile/pack.h"
#include "core/printable.h"

namespace shoal {

namespace {

// Writes the call of one field: reads `x` (relative to the field's origin), `time` (since the frame's start);
// parameters go to slots.
class FieldWriter {
  public:
    explicit FieldWriter(std::vector<glm::vec4>& samples) : samples_(&samples) {}

    GeneratedFields result;

    // Appends a 4-vector and returns the text that reads it.
    std::string slot(const glm::dvec3& v, double w = 0) {
        result.parameters.push_back(glm::vec4(glm::vec3(v), float(w)));
        return concat("fieldParameters[", result.parameters.size() - 1, "]");
    }
    // One that goes with the time.
    std::string clock(FieldClock clock) {
        clock.slot = result.parameters.size();
        result.clocks.push_back(std::move(clock));
        return slot({});
    }
    std::string cells(double rate) {
        const std::string c = clock({.kind = FieldClock::Kind::cells, .rate = rate});
        return concat(c, ".x, uint(", c, ".y) + 65536u * uint(", c, ".z)");
    }
    // The way from a point to the anchor.
    std::string fromPoint(const glm::dvec3& point) {
        const SplitPoint split = splitPoint(point);
        std::string from = "anchor";
        if (split.isFar()) from = concat("(anchor - ", slot(split.lattice), ".xyz)");
        return concat("(", from, " - ", slot(split.rest), ".xyz)");
    }
    std::string origin(const glm::dvec3& v) { return fromPoint(v) + " + position"; }

    void field(const Field& field) {
        result.source += concat("    // ", kindName(field.shape), " ", inComment(field.name), "\n");
        const std::string call = std::visit([this](const auto& shape) { return emit(shape); }, field.shape);
        result.weights.push_back(result.parameters.size());
        const std::string weight = slot({}, field.weight) + ".w";
        std::string guard;
        if (field.box) {
            const std::string low = fromPoint(field.box->low), high = fromPoint(field.box->high);
            guard = concat("if (insideBox(", low, ", ", high, ", position)) ");
        }
        result.source += concat("    ", guard, "u += ", weight, " * ", call, ";\n");
    }

  private:
    std::string emit(const UniformField& f) { return slot(f.velocity) + ".xyz"; }

    std::string emit(const OscillatingField& f) {
        const double rate = 2 * std::numbers::pi * f.frequency;
        const std::string v = slot(f.velocity, rate), p = clock({.rate = rate, .start = f.phase});
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
                      ".w, ", c, ".w, ", c, ".xy, ", cells(f.frontSpeed / f.length), ", ", f.seed, "u)");
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
                      f.octaves, ", ", cells(1 / f.period), ", ", f.seed, "u)");
    }

    std::string emit(const GridField& f) {
        const size_t base = samples_->size();
        samples_->reserve(base + f.values.size());
        for (const glm::vec3& value : f.values)
            samples_->emplace_back(value, 0.0f);
        const glm::dvec3 perMetre = glm::dvec3(f.resolution) / (f.high - f.low);
        const std::string o = origin(f.low), scale = slot(perMetre);
        const std::string grid =
            concat("Velocity(", o, ", ", scale, ".xyz, ivec3(", f.resolution.x, ", ", f.resolution.y, ", ",
                   f.resolution.z, "), ", base, ", ", f.wrap ? "true" : "false");
        if (f.times.empty()) return concat("grid", grid, ")");
        return concat("gridSequence", grid, ", ", place(f), ", ", f.times.size(), ", ",
                      f.repeats ? "true" : "false", ")");
    }

    // The time in frames of the sequence: on from the one that was last passed when the frame began.
    std::string place(const GridField& f) {
        const size_t frames = f.times.size();
        const double interval = (f.times.back() - f.times.front()) / double(frames - 1);
        bool even = true;
        for (size_t i = 0; i < frames; ++i)
            even = even && std::abs(f.times[i] - f.times.front() - double(i) * interval) < 1e-6 * interval;
        const double period = f.repeats ? f.period() : 0;
        const std::string c = clock({.kind = FieldClock::Kind::frames, .times = f.times, .period = period});
        const std::string s = slot({1 / interval, period, 0});
        if (even) return concat(c, ".x + (", c, ".y + time) * ", s, ".x");
        const size_t base = samples_->size();
        for (size_t i = 0; i < frames; ++i) {
            const double next = i + 1 < frames ? f.times[i + 1] : f.times.front() + f.period();
            samples_->emplace_back(float(next - f.times[i]), 0.0f, 0.0f, 0.0f);
        }
        return concat("placeAmong(", c, ".x, ", c, ".y + time, ", base, ", ", frames, ", ", s, ".y)");
    }

    std::string emit(const WavesField& f) {
        constexpr double deep = 1e9;  // m
        const std::string o = origin(f.origin);
        const double depth = f.depth.value_or(deep);
        double top = 0;
        for (const WaveTrain& train : f.trains)
            top += train.amplitude;
        const std::string water = slot({depth, top, 0});
        std::string sum;
        for (const WaveTrain& train : f.trains) {
            const double k = 2 * std::numbers::pi / train.wavelength;
            const double frequency = std::sqrt(f.gravity * k * std::tanh(k * depth));
            const glm::dvec2 along = glm::normalize(glm::dvec2(train.direction.x, train.direction.z));
            const std::string a = slot({along, k}, frequency),
                              b = slot({train.amplitude * frequency / -std::expm1(-2 * k * depth), 0, 0}),
                              phase = clock({.rate = -frequency, .start = train.phase});
            sum += concat(sum.empty() ? "(" : " + ", "waveVelocity(", o, ", time, ", a, ".xy, ", a, ".z, ", a,
                          ".w, ", phase, ".x, ", b, ".x, ", water, ".x, ", water, ".y)");
        }
        return sum + ")";
    }

    std::string emit(const HurricaneField& f) {
        const std::string o = origin(f.origin), a = slot({f.speed, f.radius, f.shape}, std::tan(f.inflow)),
                          b = slot({f.height, f.coriolis, 0});
        return concat("hurricaneVelocity(", o, ", ", a, ".x, ", a, ".y, ", a, ".z, ", a, ".w, ", b, ".x, ", b,
                      ".y)");
    }

    std::vector<glm::vec4>* samples_;
};

}  // namespace

GeneratedFields generateFields(const std::vector<Field>& fields, std::vector<glm::vec4>& samples) {
    FieldWriter writer(samples);
    for (const Field& field : fields)
        writer.field(field);
    GeneratedFields out = std::move(writer.result);
    setClocks(out.parameters, out.clocks, 0);
    out.source =
        concat("#include \"physics/field.glsl\"\n#include \"state/samples.glsl\"\n",
               parameterArray("fieldParameters", out.parameters.size()),
               "vec3 fluidVelocity(vec3 anchor, vec3 position, float time)\n{\n    vec3 u = vec3(0.0);\n",
               out.source, "    return u;\n}\n");
    return out;
}

std::vector<std::string> describeGrids(const std::vector<Field>& fields) {
    std::vector<std::string> out;
    for (const Field& field : fields) {
        const GridField* grid = std::get_if<GridField>(&field.shape);
        if (!grid) continue;
        std::ostringstream line;
        line << "grid " << (field.name.empty() ? "" : "\"" + printable(field.name) + "\" ") << "of "
             << grid->resolution.x << " x " << grid->resolution.y << " x " << grid->resolution.z << " cells";
        if (!grid->times.empty())
            line << ", " << grid->times.size() << " frames from " << grid->times.front() << " to "
                 << grid->times.back() << " s" << (grid->repeats ? ", again and again" : "");
        line << ": " << std::fixed << std::setprecision(2)
             << double(grid->values.size() * sizeof(glm::vec4)) / (1 << 20) << " MiB";
        out.push_back(line.str());
    }
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

}  // namespace shoal
