#include "measure/calibrate.h"

#include <algorithm>
#include <filesystem>

#include "core/cache_folder.h"
#include "core/contract.h"
#include "core/file.h"
#include "core/json_build.h"

namespace shoal::measure {

namespace fs = std::filesystem;

namespace {

constexpr int layoutVersion = 7;

// The bytes of all that is added, by their number where that may differ.
class Content {
  public:
    template <typename... Values>
    void add(const Values&... values) {
        (addOne(values), ...);
    }
    std::string key() const { return contentKey(bytes_); }

  private:
    void addOne(double number) { bytes_.append(reinterpret_cast<const char*>(&number), sizeof number); }
    void addOne(const std::string& text) {
        addOne(double(text.size()));
        bytes_ += text;
    }
    template <typename T>
    void addOne(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        addOne(double(values.size()));
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }

    std::string bytes_;
};

// The shaders that a kernel is made of.
void addShaders(Content& content, const std::string& root) {
    for (const char* folder : {"contact", "fused", "passes", "physics", "solver", "state", "step"}) {
        EXPECTS(fs::is_directory(fs::path(root) / folder));
        std::vector<fs::path> files;
        std::error_code none;
        for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(root) / folder, none))
            if (entry.is_regular_file(none)) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files)
            content.add(readFile(file));
    }
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

std::optional<double> numberOrNull(JsonReader& reader, const char* key) {
    const JsonValue* value = reader.raw(key);
    if (value == nullptr || value->kind != JsonValue::Kind::number) return std::nullopt;
    return value->number;
}

Candidate candidateOf(JsonReader& reader) {
    Candidate out;
    out.method = methodOf(reader);
    reader.need("substeps", out.substeps);
    out.error = numberOrNull(reader, "error");
    out.worst = numberOrNull(reader, "worst");
    out.cost = numberOrNull(reader, "secondsPerVertexAndSecond").value_or(0);
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
    Content content;
    content.add(layoutVersion, plan.frameRate, plan.gravity.x, plan.gravity.y, plan.gravity.z, plan.topology,
                plan.fields.source, plan.colliders.source, plan.fields.parameters, plan.samples);
    for (const GroupPlan& group : plan.groups)
        content.add(group.count, group.vertexCount, group.drag.normal, group.drag.tangent, group.stiffness,
                    group.damping, group.needs.pins, group.needs.collide, group.start.positions,
                    group.start.velocities, group.start.anchors, group.constants.scales,
                    group.constants.phases, group.kernel.molecule, group.kernel.forces, group.kernel.sweeps,
                    group.kernel.load, group.colliderParameters);
    const ContactPlan& contact = plan.contact;
    for (const ContactGroup& group : contact.groups)
        content.add(group.radius, group.spheresOf, group.self, group.growth.x, group.growth.y);
    content.add(contact.spheres, contact.steps, contact.settings.iterations, int(contact.settings.search),
                int(contact.settings.response), contact.settings.neighbors, contact.settings.tolerance,
                contact.settings.fastest.value_or(0), contact.cell, contact.pairs);
    content.add(options.error, options.duration, options.molecules, options.substeps.value_or(0),
                options.solvers, options.samplings, options.version, options.processor);
    const gpu::ContextInfo& info = device.context->info();
    content.add(info.renderer, info.vendor, info.version, int(info.kind), int(device.path), int(device.lanes),
                device.inPlace);
    addShaders(content, device.context->shaders());
    return content.key();
}

static JsonValue asJson(const ContactPoint& point) {
    return object(key("iterations", point.iterations), key("overlap", point.errors.overlap),
                  key("largestOverlap", point.errors.largestOverlap),
                  key("energyGiven", point.errors.energyGiven), key("momentum", point.errors.momentum),
                  key("contacts", point.contacts), key("steps", point.steps),
                  key("secondsPerFrame", point.time.min));
}

static ContactPoint contactPointOf(JsonReader& reader) {
    ContactPoint out;
    reader.need("iterations", out.iterations, Range::between(1, ContactSettings::mostIterations));
    reader.need("overlap", out.errors.overlap);
    reader.need("largestOverlap", out.errors.largestOverlap);
    out.errors.energyGiven = numberOrNull(reader, "energyGiven");
    out.errors.momentum = numberOrNull(reader, "momentum");
    reader.need("contacts", out.contacts);
    reader.need("steps", out.steps);
    reader.need("secondsPerFrame", out.time.min);
    return out;
}

JsonValue asJson(const Calibration& calibration) {
    if (calibration.contact)
        return object(key("target", calibration.target), key("substeps", calibration.substeps),
                      key("contact", asJson(*calibration.contact)), key("duration", calibration.duration),
                      key("why", calibration.why), key("seconds", calibration.seconds));
    return object(key("target", calibration.target), key("solver", name(calibration.method.solver)),
                  key("fieldSampling", name(calibration.method.sampling)),
                  key("substeps", calibration.substeps), key("error", calibration.error),
                  key("worst", calibration.sample.worst), key("molecules", calibration.sample.molecules),
                  key("above", calibration.sample.above), key("unknown", calibration.sample.unknown),
                  key("how", calibration.how), key("secondsPerVertexAndSecond", calibration.cost),
                  key("duration", calibration.duration), key("why", calibration.why),
                  key("seconds", calibration.seconds),
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
        out.kept = true;
        reader.need("target", out.target);
        reader.need("substeps", out.substeps, Range::between(1, maxSubsteps));
        reader.need("duration", out.duration);
        reader.need("why", out.why);
        reader.need("seconds", out.seconds);
        if (std::optional<JsonReader> contact = reader.object("contact")) {
            out.contact = contactPointOf(*contact);
            out.error = out.contact->errors.overlap;
            return out;
        }
        out.method = methodOf(reader);
        reader.need("error", out.error);
        out.sample.rms = out.error;
        reader.need("worst", out.sample.worst);
        reader.need("molecules", out.sample.molecules);
        reader.need("above", out.sample.above);
        reader.need("unknown", out.sample.unknown);
        reader.need("how", out.how);
        reader.need("secondsPerVertexAndSecond", out.cost);
        for (JsonReader& candidate : reader.objects("candidates"))
            out.candidates.push_back(candidateOf(candidate));
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
