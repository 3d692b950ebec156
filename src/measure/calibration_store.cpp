#include "measure/calibrate.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/contract.h"
#include "core/file.h"

namespace shoal::measure {

namespace fs = std::filesystem;

namespace {

constexpr int layoutVersion = 3;

// FNV-1a over the bytes of what it is given.
class Hash {
  public:
    void bytes(const void* data, size_t size) {
        const auto* at = static_cast<const unsigned char*>(data);
        for (size_t i = 0; i < size; ++i)
            value_ = (value_ ^ at[i]) * 1099511628211ull;
    }
    void add(const std::string& text) {
        add(double(text.size()));
        bytes(text.data(), text.size());
    }
    void add(double number) { bytes(&number, sizeof number); }
    template <typename T>
    void add(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(double(values.size()));
        if (!values.empty()) bytes(values.data(), values.size() * sizeof(T));
    }
    std::string digits() const {
        char text[20];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value_));
        return text;
    }

  private:
    uint64_t value_ = 14695981039346656037ull;
};

void addGroup(Hash& hash, const GroupPlan& group) {
    for (const double number :
         {double(group.count), double(group.vertexCount), group.drag.normal, group.drag.tangent,
          group.stiffness, group.damping, double(group.needs.pins), double(group.needs.collide)})
        hash.add(number);
    hash.add(group.start.positions);
    hash.add(group.start.velocities);
    hash.add(group.start.anchors);
    hash.add(group.constants.scales);
    hash.add(group.constants.phases);
    for (const std::string* text :
         {&group.kernel.molecule, &group.kernel.forces, &group.kernel.sweeps, &group.kernel.packing})
        hash.add(*text);
}

// The shaders that a kernel is made of.
void addShaders(Hash& hash, const std::string& root) {
    for (const char* folder : {"fused", "passes", "physics", "solver", "state", "step"}) {
        EXPECTS(fs::is_directory(fs::path(root) / folder));
        std::vector<fs::path> files;
        std::error_code none;
        for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(root) / folder, none))
            if (entry.is_regular_file(none)) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files)
            hash.add(readFile(file));
    }
}

void addDevice(Hash& hash, const AccuracyDevice& device) {
    const gpu::ContextInfo& info = device.context->info();
    for (const std::string& text : {info.renderer, info.vendor, info.version})
        hash.add(text);
    for (const double number :
         {double(info.kind), double(device.path), double(device.lanes), double(device.inPlace)})
        hash.add(number);
}

JsonValue asJson(const Candidate& one) {
    JsonValue out = JsonValue::makeObject();
    out.add("solver", JsonValue::makeString(name(one.method.solver)))
        .add("fieldSampling", JsonValue::makeString(name(one.method.sampling)))
        .add("substeps", JsonValue::makeNumber(one.substeps))
        .add("error", one.error ? JsonValue::makeNumber(*one.error) : JsonValue())
        .add("worst", one.worst ? JsonValue::makeNumber(*one.worst) : JsonValue())
        .add("secondsPerVertexAndSecond", one.cost > 0 ? JsonValue::makeNumber(one.cost) : JsonValue())
        .add("reached", JsonValue::makeBoolean(one.reached))
        .add("why", JsonValue::makeString(one.why));
    return out;
}

Method methodOf(JsonReader& reader) {
    std::string solver, sampling;
    reader.need("solver", solver);
    reader.need("fieldSampling", sampling);
    Method out;
    out.solver = solverOf(solver).value_or(SolverKind::leapfrog);
    for (const FieldSampling one :
         {FieldSampling::vertexSubstep, FieldSampling::vertexFrame, FieldSampling::moleculeFrame})
        if (sampling == name(one)) out.sampling = one;
    return out;
}

Candidate candidateOf(JsonReader& reader) {
    Candidate out;
    out.method = methodOf(reader);
    reader.need("substeps", out.substeps);
    const JsonValue* error = reader.raw("error");
    if (error != nullptr && error->kind == JsonValue::Kind::number) out.error = error->number;
    const JsonValue* worst = reader.raw("worst");
    if (worst != nullptr && worst->kind == JsonValue::Kind::number) out.worst = worst->number;
    const JsonValue* cost = reader.raw("secondsPerVertexAndSecond");
    if (cost != nullptr && cost->kind == JsonValue::Kind::number) out.cost = cost->number;
    reader.need("reached", out.reached);
    reader.need("why", out.why);
    return out;
}

fs::path fileOf(const std::string& folder, const std::string& key) {
    return fs::path(folder) / "calibrations" / (key + ".json");
}

}  // namespace

std::string calibrationKey(const Plan& plan, const CalibrationOptions& options,
                           const AccuracyDevice& device) {
    Hash hash;
    hash.add(double(layoutVersion));
    for (const GroupPlan& group : plan.groups)
        addGroup(hash, group);
    for (const double number :
         {plan.frameRate, plan.gravity.x, plan.gravity.y, plan.gravity.z, options.error, options.duration,
          double(options.molecules), double(options.substeps.value_or(0))})
        hash.add(number);
    hash.add(plan.topology);
    hash.add(plan.fieldSource);
    hash.add(plan.collideSource);
    hash.add(plan.fieldParameters);
    for (const GroupPlan& group : plan.groups)
        hash.add(group.colliderParameters);
    hash.add(plan.samples);
    hash.add(options.solvers);
    hash.add(options.samplings);
    hash.add(options.version);
    hash.add(options.processor);
    addDevice(hash, device);
    addShaders(hash, device.shaderRoot);
    return hash.digits();
}

JsonValue asJson(const Calibration& one) {
    JsonValue candidates = JsonValue::makeArray();
    for (const Candidate& candidate : one.candidates)
        candidates.items.push_back(asJson(candidate));
    JsonValue out = JsonValue::makeObject();
    out.add("target", JsonValue::makeNumber(one.target))
        .add("solver", JsonValue::makeString(name(one.method.solver)))
        .add("fieldSampling", JsonValue::makeString(name(one.method.sampling)))
        .add("substeps", JsonValue::makeNumber(one.substeps))
        .add("error", JsonValue::makeNumber(one.error))
        .add("worst", JsonValue::makeNumber(one.sample.worst))
        .add("measured", JsonValue::makeNumber(one.sample.measured))
        .add("above", JsonValue::makeNumber(one.sample.above))
        .add("compared", JsonValue::makeNumber(one.sample.compared))
        .add("untold", JsonValue::makeNumber(one.sample.untold))
        .add("how", JsonValue::makeString(one.how))
        .add("secondsPerVertexAndSecond", JsonValue::makeNumber(one.cost))
        .add("duration", JsonValue::makeNumber(one.duration))
        .add("why", JsonValue::makeString(one.why))
        .add("seconds", JsonValue::makeNumber(one.seconds))
        .add("candidates", std::move(candidates));
    return out;
}

std::optional<Calibration> loadCalibration(const std::string& folder, const std::string& key) {
    std::error_code none;
    const fs::path file = fileOf(folder, key);
    if (folder.empty() || !fs::exists(file, none)) return std::nullopt;
    try {
        const JsonValue value = readJson(file.string());
        JsonReader reader(value, file.string());
        Calibration out;
        out.method = methodOf(reader);
        reader.need("target", out.target);
        reader.need("substeps", out.substeps, Range::between(1, maxSubsteps));
        reader.need("error", out.error);
        out.sample.rms = out.error;
        reader.need("worst", out.sample.worst);
        reader.need("measured", out.sample.measured);
        reader.need("above", out.sample.above);
        reader.need("compared", out.sample.compared);
        reader.need("untold", out.sample.untold);
        reader.need("how", out.how);
        reader.need("secondsPerVertexAndSecond", out.cost);
        reader.need("duration", out.duration);
        reader.need("why", out.why);
        reader.need("seconds", out.seconds);
        for (JsonReader& candidate : reader.objects("candidates"))
            out.candidates.push_back(candidateOf(candidate));
        out.kept = true;
        return out;
    } catch (const Error&) {
        return std::nullopt;
    }
}

void keepCalibration(const std::string& folder, const std::string& key, const Calibration& calibration) {
    if (folder.empty()) return;
    try {
        writeFile(fileOf(folder, key), writeJson(asJson(calibration)));
    } catch (const Error&) {
    }
}

}  // namespace shoal::measure
