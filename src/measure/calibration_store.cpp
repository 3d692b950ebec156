#include "measure/calibrate.h"

#include <algorithm>
#include <filesystem>

#include "core/contract.h"
#include "core/file.h"
#include "core/json_build.h"

namespace shoal::measure {

namespace fs = std::filesystem;

namespace {

constexpr int layoutVersion = 3;

// FNV-1a over the bytes of what it is given.
class Hash {
  public:
    void bytes(const void* data, size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (size_t i = 0; i < size; ++i)
            value_ = (value_ ^ bytes[i]) * 1099511628211ull;
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
    std::string digits() const { return formatted("%016llx", static_cast<unsigned long long>(value_)); }

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
         {&group.kernel.molecule, &group.kernel.forces, &group.kernel.sweeps, &group.kernel.load})
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

JsonValue asJson(const Candidate& candidate) {
    const std::optional<double> cost = candidate.cost > 0 ? std::optional(candidate.cost) : std::nullopt;
    return object(
        key("solver", name(candidate.method.solver)), key("fieldSampling", name(candidate.method.sampling)),
        key("substeps", candidate.substeps), key("error", candidate.error), key("worst", candidate.worst),
        key("secondsPerVertexAndSecond", cost), key("reached", candidate.reached), key("why", candidate.why));
}

Method methodOf(JsonReader& reader) {
    std::string solver, sampling;
    reader.need("solver", solver);
    reader.need("fieldSampling", sampling);
    Method out;
    out.solver = solverOf(solver).value_or(SolverKind::leapfrog);
    for (const FieldSampling candidate : allSamplings)
        if (sampling == name(candidate)) out.sampling = candidate;
    return out;
}

Candidate candidateOf(JsonReader& reader) {
    Candidate out;
    out.method = methodOf(reader);
    reader.need("substeps", out.substeps);
    const auto known = [&](const char* key) -> std::optional<double> {
        const JsonValue* value = reader.raw(key);
        if (value == nullptr || value->kind != JsonValue::Kind::number) return std::nullopt;
        return value->number;
    };
    out.error = known("error");
    out.worst = known("worst");
    out.cost = known("secondsPerVertexAndSecond").value_or(0);
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
    hash.add(plan.fields.source);
    hash.add(plan.colliders.source);
    hash.add(plan.fields.parameters);
    for (const GroupPlan& group : plan.groups)
        hash.add(group.colliderParameters);
    hash.add(plan.samples);
    hash.add(options.solvers);
    hash.add(options.samplings);
    hash.add(options.version);
    hash.add(options.processor);
    addDevice(hash, device);
    addShaders(hash, device.context->shaders());
    return hash.digits();
}

JsonValue asJson(const Calibration& calibration) {
    return object(key("target", calibration.target), key("solver", name(calibration.method.solver)),
                  key("fieldSampling", name(calibration.method.sampling)),
                  key("substeps", calibration.substeps), key("error", calibration.error),
                  key("worst", calibration.sample.worst), key("measured", calibration.sample.measured),
                  key("above", calibration.sample.above), key("compared", calibration.sample.compared),
                  key("untold", calibration.sample.untold), key("how", calibration.how),
                  key("secondsPerVertexAndSecond", calibration.cost), key("duration", calibration.duration),
                  key("why", calibration.why), key("seconds", calibration.seconds),
                  key("candidates", arrayOf(calibration.candidates, asJson)));
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
