#include "python/simulation.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include <unistd.h>

#include "core/data_paths.h"
#include "gpu/current.h"
#include "python/arguments.h"
#include "python/picture.h"
#include "scene/json/scene_file.h"
#include "simulate/checkpoint.h"

namespace shoal::python {

namespace {

std::mutex devicesGuard;

// Never destroyed: drivers do not outlive the interpreter's end.
std::map<std::optional<int>, Device*>& devices() {
    static auto& all = *new std::map<std::optional<int>, Device*>;
    return all;
}

thread_local bool endIsWatched = false;

// The devices that this thread used are there for the next one.
void leaveDevices() {
    const std::lock_guard lock(devicesGuard);
    for (const auto& [number, device] : devices()) {
        if (!device || device->thread != std::this_thread::get_id()) continue;
        if (device->context.isCurrent()) gpu::leaveCurrent();
        device->thread = {};
    }
    endIsWatched = false;
}

// Leaves the devices when Python clears what it keeps of this thread. A destructor of the thread itself may
// run after join() has returned in another thread.
void watchEndOfThread() {
    if (endIsWatched) return;
    const py::gil_scoped_acquire locked;
    const py::capsule end(reinterpret_cast<void*>(intptr_t(::getpid())), [](void* process) {
        if (intptr_t(process) == ::getpid()) leaveDevices();  // the driver's threads are not in a child
    });
    py::reinterpret_borrow<py::dict>(PyThreadState_GetDict())["shoal.devices"] = end;
    endIsWatched = true;
}

}  // namespace

Device& deviceOf(std::optional<int> number) {
    const std::lock_guard lock(devicesGuard);
    Device*& device = devices()[number];
    if (!device) {
        gpu::ContextOptions options = gpu::contextOptions();
        options.device = number;
        if (number) options.kind = gpu::ContextKind::egl;
        device = new Device(options);
        device->thread = std::this_thread::get_id();
    }
    return *device;
}

void enter(Device& device) {
    if (device.process != ::getpid())
        throw Error(
            "a simulation does not go on in a process that was forked after it was made: start "
            "processes with multiprocessing's \"spawn\", and make it there");
    {
        const std::lock_guard lock(devicesGuard);
        if (device.thread == std::thread::id()) device.thread = std::this_thread::get_id();
    }
    if (device.thread != std::this_thread::get_id())
        throw Error(
            "a simulation is used in another thread than the one that made the first on its device, "
            "which has not ended");
    watchEndOfThread();
    device.context.makeCurrent();
}

double finite(const char* what, double value) {
    if (!std::isfinite(value)) throw Error(what, " is not finite");
    if (!std::isfinite(float(value))) throw Error(what, " is beyond what a float holds: ", value);
    return value;
}

glm::dvec3 finite(const char* what, const Vector3& value) {
    return {finite(what, value[0]), finite(what, value[1]), finite(what, value[2])};
}

static std::vector<glm::dvec3> given(const char* what, const Array& array, const GroupPlan& plan) {
    const py::ssize_t shape[] = {plan.count, plan.vertexCount, 3};
    std::string found;
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
        found += concat(i ? ", " : "", array.shape(i));
    if (array.ndim() != 3 || !std::equal(shape, shape + 3, array.shape()))
        throw Error(what, ": expected an array of shape (", shape[0], ", ", shape[1], ", 3), found (", found,
                    ")");
    std::vector<glm::dvec3> out(size_t(plan.count) * size_t(plan.vertexCount));
    std::copy_n(array.data(), 3 * out.size(), &out.data()->x);
    for (const glm::dvec3& value : out)
        finite(what, {value.x, value.y, value.z});
    return out;
}

static void warn(const std::string& words) {
    if (PyErr_WarnEx(PyExc_RuntimeWarning, words.c_str(), 1) != 0) throw py::error_already_set();
}

PySimulation::PySimulation(const PyScene& scene, const std::optional<std::string>& solver,
                           std::optional<int> substeps, std::optional<int> device, const std::string& path,
                           bool diagnostics)
    : scene_(scene.scene) {
    if (solver) scene_.solver.kind = solverOf(*solver);
    if (substeps) scene_.solver.substeps = *substeps;
    checkScene(scene_);
    const Path wanted = shoal::path(path);
    {
        const py::gil_scoped_release release;
        device_ = &deviceOf(device);
        enter(*device_);
        SimulationOptions options;
        options.path = wanted;
        simulation_ = std::make_unique<Simulation>(device_->context, compile(scene_), options);
        if (diagnostics) diagnostics_ = std::make_unique<measure::Diagnostics>(scene_, *simulation_);
    }
    substeps_ = simulation_->parameters.substeps;
    for (const Warning& warning : simulation_->warnings())
        warn(text(warning));
}

PySimulation::~PySimulation() {
    try {
        close();
    } catch (const Error&) {
        // Collected in another thread, where its context cannot be current: what it holds there stays.
        (void)diagnostics_.release();
        (void)renderer_.release();
        (void)simulation_.release();
    }
}

void SignalWatch::look() {
    const auto time = std::chrono::steady_clock::now();
    if (time - last_ < std::chrono::milliseconds(100)) return;
    last_ = time;
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void PySimulation::step(int frames) {
    if (frames < 0) throw Error("step() takes 0 frames or more, not ", frames);
    Simulation& simulation = use();
    SignalWatch watch;
    if (diagnostics_) diagnostics_->follow();
    for (int i = 0; i < frames; ++i) {
        simulation.frame();
        if (diagnostics_) diagnostics_->follow();
        watch.look();
    }
    simulation.check();
}

void PySimulation::restart() {
    use().restart();
    if (diagnostics_) diagnostics_->forget();
}

void PySimulation::close() {
    if (simulation_) enter(*device_);
    diagnostics_.reset();
    renderer_.reset();
    simulation_.reset();
}

std::vector<std::string> PySimulation::groups() {
    std::vector<std::string> out;
    for (const GroupPlan& group : use().plan().groups)
        out.push_back(group.name);
    return out;
}

py::array PySimulation::alive(const py::object& group) {
    const Snapshot state = use().snapshot(groupOf(group));
    py::array_t<bool> out(py::ssize_t(state.count));
    for (py::ssize_t m = 0; m < state.count; ++m)
        out.mutable_at(m) = state.alive.empty() || state.alive[size_t(m)];
    return out;
}

void PySimulation::setState(const py::object& group, const std::optional<Array>& positions,
                            const std::optional<Array>& velocities) {
    const size_t index = groupOf(group);
    Simulation& simulation = use();
    SavedState saved = simulation.save();
    GroupState& state = saved.groups[index];
    const GroupPlan& plan = simulation.plan().groups[index];
    if (positions) {
        const std::vector<glm::dvec3> places = given("positions", *positions, plan);
        for (size_t i = 0; i < places.size(); ++i)
            state.positions[i] =
                glm::vec3(places[i] - glm::dvec3(state.anchors[i / size_t(plan.vertexCount)]));
    }
    if (velocities) {
        const std::vector<glm::dvec3> speeds = given("velocities", *velocities, plan);
        for (size_t i = 0; i < speeds.size(); ++i)
            state.velocities[i] = glm::vec3(speeds[i]);
    }
    saved.step = 0;  // solvers with history start anew
    simulation.load(saved);
    if (diagnostics_) diagnostics_->forget();
}

py::dict PySimulation::energy(const py::object& group) {
    const size_t index = groupOf(group);
    Simulation& simulation = use();
    const Snapshot state = simulation.snapshot(index);
    const GroupPlan& plan = simulation.plan().groups[index];
    const Molecule& molecule = scene_.groups[plan.index].molecule;
    const auto each = size_t(plan.vertexCount);
    double kinetic = 0, elastic = 0, gravity = 0;
    for (size_t m = 0; m < size_t(state.count); ++m) {
        if (!state.alive.empty() && !state.alive[m]) continue;
        for (size_t v = 0; v < each; ++v) {
            const size_t i = m * each + v;
            const double mass = molecule.vertices[v].mass;
            kinetic += 0.5 * mass * glm::dot(state.velocities[i], state.velocities[i]);
            gravity -= mass * glm::dot(simulation.parameters.gravity, state.positions[i]);
        }
        const double scale = plan.constants.scales.empty() ? 1 : double(plan.constants.scales[m]);
        for (const Spring& spring : molecule.springs) {
            const double length = glm::distance(state.positions[m * each + size_t(spring.a)],
                                                state.positions[m * each + size_t(spring.b)]);
            const double off = length - scale * molecule.restLength(spring);
            elastic += 0.5 * plan.stiffness * spring.stiffness * off * off;
        }
    }
    py::dict out;
    out["kinetic"] = kinetic;
    out["elastic"] = elastic;
    out["gravity"] = gravity;
    return out;
}

// "rmsStrain" becomes "rms_strain".
static std::string pythonName(const std::string& name) {
    std::string out;
    for (const char c : name) {
        if (c >= 'A' && c <= 'Z') out += '_';
        out += char(std::tolower(c));
    }
    return out;
}

py::dict PySimulation::diagnostics() {
    use();
    if (!diagnostics_) throw Error("the simulation was made with diagnostics=False");
    constexpr double seconds = 0.1;
    {
        const py::gil_scoped_release release;
        diagnostics_->finish(seconds);
    }
    py::dict out;
    for (const JsonMember& each : asJson(*diagnostics_->reading()).members) {
        const JsonValue& value = each.second;
        const bool known = value.kind == JsonValue::Kind::number;
        out[pythonName(each.first).c_str()] = value.kind == JsonValue::Kind::string
                                                  ? py::object(py::str(value.text))
                                              : known ? py::object(py::float_(value.number))
                                                      : py::none();
    }
    return out;
}

py::array PySimulation::picture(int width, int height, const std::optional<std::array<double, 3>>& eye,
                                const std::optional<std::array<double, 3>>& target,
                                std::optional<double> fieldOfView) {
    constexpr int largest = 16384;
    if (width < 1 || height < 1 || width > largest || height > largest)
        throw Error("a picture has 1 to ", largest, " pixels a side, not ", width, " x ", height);
    if (fieldOfView && !(*fieldOfView > 0 && *fieldOfView < std::numbers::pi))
        throw Error("field_of_view is between 0 and pi, not ", *fieldOfView);
    Image image;
    {
        const py::gil_scoped_release release;
        Simulation& simulation = use();
        RenderOptions options;
        options.width = width;
        options.height = height;
        if (!renderer_)
            renderer_ = std::make_unique<Renderer>(device_->context, scene_, simulation.plan(), options);
        renderer_->resize(width, height);
        View view = View::fromCamera(scene_.camera, simulation.time());
        if (eye) view.eye = finite("eye", *eye);
        if (target) view.target = finite("target", *target);
        if (fieldOfView) view.fieldOfView = *fieldOfView;
        renderer_->draw(simulation.state(), view);
        image = renderer_->capture();
    }
    return pictureOf(image);
}

py::object PySimulation::shown() {
    constexpr int width = 640, height = 360;
    if (!simulation_) return py::none();
    return picture(width, height, {}, {}, {}).attr("_repr_png_")();
}

void PySimulation::save(const std::filesystem::path& file) {
    Simulation& simulation = use();
    simulation.check();  // what has run away is not saved
    writeCheckpoint(file, simulation.plan(), {simulation.save(), simulation.parameters});
}

void PySimulation::load(const std::filesystem::path& file) {
    Simulation& simulation = use();
    const Checkpoint read = readCheckpoint(file, simulation.plan());
    simulation.load(read.state);
    if (diagnostics_) diagnostics_->forget();
    simulation.parameters = read.parameters;
    substeps_ = read.parameters.substeps;
}

void PySimulation::setParameters(const char* name, Parameters changed, std::optional<int> substeps) {
    Simulation& simulation = use();
    const int wanted = substeps.value_or(substeps_);
    const int needed = substepsNeeded(simulation.plan(), changed.frameTime, changed.stiffness,
                                      changed.damping, changed.drag, wanted);
    if (needed > maxSubsteps)
        throw Error(name, ": a frame would need ", needed, " substeps and has at most ", maxSubsteps);
    if (needed > wanted && (substeps || needed > simulation.parameters.substeps))
        warn(concat(name, ": a frame takes ", needed,
                    " substeps, because its springs or its drag need more than ", wanted));
    changed.substeps = needed;
    simulation.parameters = std::move(changed);
    substeps_ = wanted;
}

Simulation& PySimulation::use() {
    if (!simulation_) throw Error("the simulation was closed");
    enter(*device_);
    return *simulation_;
}

size_t PySimulation::groupOf(const py::object& group) {
    const std::vector<GroupPlan>& groups = use().plan().groups;
    if (group.is_none()) {
        if (groups.size() == 1) return 0;
        throw Error("the scene has ", groups.size(), " groups: say which, by name or number");
    }
    if (PyIndex_Check(group.ptr())) {
        const py::ssize_t index = indexOf(group);
        if (index >= 0 && size_t(index) < groups.size()) return size_t(index);
        throw Error("there is no group ", index, ": the scene has ", groups.size());
    }
    if (!py::isinstance<py::str>(group))
        throw Error("a group is a name, a number or None, found ", std::string(py::repr(group)));
    const auto word = std::string(py::str(group));
    std::vector<std::string> names;
    for (size_t i = 0; i < groups.size(); ++i) {
        if (groups[i].name == word) return i;
        names.push_back(groups[i].name);
    }
    throw Error("the scene has no group \"", word, "\"", suggestion(word, names));
}

// The array takes the vector's memory.
template <typename Vector>
py::array PySimulation::vectors(const py::object& group, std::vector<Vector> Snapshot::*values) {
    using Number = typename Vector::value_type;
    static_assert(sizeof(Vector) == 3 * sizeof(Number));
    const size_t index = groupOf(group);
    auto state = std::make_unique<Snapshot>();
    {
        const py::gil_scoped_release release;
        *state = use().snapshot(index);
    }
    auto* kept = new std::vector<Vector>(std::move((*state).*values));
    const py::capsule owner(kept, [](void* memory) { delete static_cast<std::vector<Vector>*>(memory); });
    return py::array_t<Number>({py::ssize_t(state->count), py::ssize_t(state->vertexCount), py::ssize_t(3)},
                               &kept->data()->x, owner);
}

py::array PySimulation::positions(const py::object& group) {
    return vectors(group, &Snapshot::positions);
}
py::array PySimulation::velocities(const py::object& group) {
    return vectors(group, &Snapshot::velocities);
}
py::array PySimulation::normals(const py::object& group) {
    return vectors(group, &Snapshot::normals);
}

std::string PySimulation::hash() {
    return formatted("%016llx", static_cast<unsigned long long>(use().hash()));
}

}  // namespace shoal::python
