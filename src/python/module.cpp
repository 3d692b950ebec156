// The Python module `shoal`: scenes, simulations and molecules, with state as NumPy arrays (docs/python.md).
//
// All simulations on one device share a context of OpenGL, which lives as long as the process and belongs to
// the thread that made it. The interpreter's lock is released while a simulation steps, draws or compiles.
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/cache_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json.h"
#include "core/parallel.h"
#include "gpu/context.h"
#include "gpu/program_cache.h"
#include "measure/accuracy.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "render/renderer.h"
#include "run/data_paths.h"
#include "run/scene_list.h"
#include "scene/json/scene_file.h"
#include "simulate/checkpoint.h"
#include "simulate/simulation.h"

namespace py = pybind11;

namespace shoal::python {

namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Unlocked = py::call_guard<py::gil_scoped_release>;

// ---- Contexts

struct Device {
    gpu::Context context;
    gpu::ProgramCache cache;
    std::thread::id thread = std::this_thread::get_id();

    explicit Device(const gpu::ContextOptions& options) : context(options), cache(context, cacheFolder()) {}
};

// Never destroyed: drivers do not outlive the interpreter's end.
Device& deviceOf(std::optional<int> number) {
    static auto& devices = *new std::map<std::optional<int>, Device*>;
    Device*& device = devices[number];
    if (!device) {
        gpu::ContextOptions options;
        options.visible = false;
        options.device = number;
        if (number) options.kind = gpu::ContextKind::egl;
        device = new Device(options);
    }
    return *device;
}

void enter(Device& device) {
    if (device.thread != std::this_thread::get_id())
        throw Error("a simulation is used in another thread than the one that made the first on its device");
    device.context.makeCurrent();
}

// ---- Python's values

// JSON's text of a dict or list.
std::string jsonOf(const py::object& value) {
    return py::str(py::module_::import("json").attr("dumps")(value));
}

glm::dvec3 vectorOf(const std::array<double, 3>& v) {
    return {v[0], v[1], v[2]};
}

// ---- Molecules

struct PyMolecule {
    Molecule molecule;
};

PyMolecule moleculeFrom(const py::object& source) {
    if (py::isinstance<py::dict>(source)) {
        py::dict whole = source.attr("copy")();
        if (!whole.contains("format")) whole["format"] = "shoal-molecule-1";
        return {parseMolecule(jsonOf(whole), "<molecule>")};
    }
    return {readMolecule(py::cast<std::filesystem::path>(source).string())};
}

py::array_t<double> restPositions(const PyMolecule& self) {
    py::array_t<double> out({py::ssize_t(self.molecule.vertices.size()), py::ssize_t(3)});
    auto values = out.mutable_unchecked<2>();
    for (size_t i = 0; i < self.molecule.vertices.size(); ++i)
        for (int k = 0; k < 3; ++k)
            values(py::ssize_t(i), k) = self.molecule.vertices[i].position[k];
    return out;
}

// ---- Scenes

// Molecules that a scene names as objects become files for as long as it is read.
class MoleculeFiles {
  public:
    MoleculeFiles() = default;
    MoleculeFiles(const MoleculeFiles&) = delete;
    MoleculeFiles& operator=(const MoleculeFiles&) = delete;
    ~MoleculeFiles() {
        std::error_code code;
        if (!folder_.empty()) std::filesystem::remove_all(folder_, code);
    }
    std::string add(const Molecule& molecule) {
        if (folder_.empty()) {
            std::string name = (std::filesystem::temp_directory_path() / "shoal-XXXXXX").string();
            if (!::mkdtemp(name.data()))
                throw Error("no folder can be made in ", std::filesystem::temp_directory_path());
            folder_ = name;
        }
        const std::filesystem::path file = folder_ / (std::to_string(count_++) + ".json");
        writeFile(file, writeMolecule(molecule));
        return file.string();
    }

  private:
    std::filesystem::path folder_;
    int count_ = 0;
};

struct PyScene {
    Scene scene;
};

PyScene sceneFrom(const py::object& source, const std::filesystem::path& folder) {
    if (!py::isinstance<py::dict>(source)) {
        const std::string word = py::cast<std::filesystem::path>(source).string();
        const py::gil_scoped_release release;
        return {readScene(needScene(word))};
    }
    MoleculeFiles files;
    py::dict whole = source.attr("copy")();
    if (!whole.contains("format")) whole["format"] = "shoal-scene-1";
    if (whole.contains("groups") && py::isinstance<py::list>(whole["groups"])) {
        py::list groups;
        for (const py::handle& entry : whole["groups"]) {
            if (!py::isinstance<py::dict>(entry)) {
                groups.append(entry);
                continue;
            }
            py::dict group = entry.attr("copy")();
            const py::object molecule = group.attr("get")("molecule");
            if (py::isinstance<PyMolecule>(molecule))
                group["molecule"] = files.add(molecule.cast<const PyMolecule&>().molecule);
            else if (py::isinstance<py::dict>(molecule))
                group["molecule"] = files.add(moleculeFrom(molecule).molecule);
            groups.append(group);
        }
        whole["groups"] = groups;
    }
    const std::string text = jsonOf(whole), file = (folder / "<scene>").string();
    const py::gil_scoped_release release;
    return {parseScene(text, file)};
}

// ---- Simulations

class PySimulation {
  public:
    PySimulation(const PyScene& scene, const std::optional<std::string>& solver, std::optional<int> substeps,
                 std::optional<int> device, const std::string& path)
        : scene_(scene.scene) {
        if (solver) scene_.solver.kind = solverOf(*solver);
        if (substeps) scene_.solver.substeps = *substeps;
        checkScene(scene_);
        const Path wanted = shoal::path(path);
        const py::gil_scoped_release release;
        device_ = &deviceOf(device);
        enter(*device_);
        SimulationOptions options;
        options.path = wanted;
        options.cache = &device_->cache;
        simulation_ = std::make_unique<Simulation>(device_->context, shaderRoot(), compile(scene_), options);
    }

    void step(int frames) {
        if (frames < 0) throw Error("step() takes 0 frames or more, not ", frames);
        Simulation& simulation = use();
        for (int i = 0; i < frames; ++i)
            simulation.frame();
        simulation.check();
    }
    void restart() { use().restart(); }
    void close() {
        if (simulation_) enter(*device_);
        renderer_.reset();
        simulation_.reset();
    }

    double time() { return use().time(); }
    int frames() { return use().frames(); }
    std::string hash() { return formatted("%016llx", static_cast<unsigned long long>(use().hash())); }
    std::string solver(const py::object& group) { return name(use().plan().groups[groupOf(group)].solver); }
    std::vector<std::string> groups() {
        std::vector<std::string> out;
        for (const GroupPlan& group : use().plan().groups)
            out.push_back(group.name);
        return out;
    }

    py::array positions(const py::object& group) { return vectors(group, &Snapshot::positions); }
    py::array velocities(const py::object& group) { return vectors(group, &Snapshot::velocities); }
    py::array normals(const py::object& group) { return vectors(group, &Snapshot::normals); }
    py::array alive(const py::object& group) {
        const Snapshot state = use().snapshot(groupOf(group));
        py::array_t<bool> out(py::ssize_t(state.count));
        for (py::ssize_t m = 0; m < state.count; ++m)
            out.mutable_at(m) = state.alive.empty() || state.alive[size_t(m)];
        return out;
    }

    void setState(const py::object& group, const std::optional<Array>& positions,
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
    }

    py::dict energy(const py::object& group) {
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

    py::array picture(int width, int height, const std::optional<std::array<double, 3>>& eye,
                      const std::optional<std::array<double, 3>>& target, std::optional<double> fieldOfView) {
        constexpr int largest = 16384;
        if (width < 1 || height < 1 || width > largest || height > largest)
            throw Error("a picture has 1 to ", largest, " pixels a side, not ", width, " x ", height);
        Image image;
        {
            const py::gil_scoped_release release;
            Simulation& simulation = use();
            RenderOptions options;
            options.width = width;
            options.height = height;
            if (!renderer_)
                renderer_ = std::make_unique<Renderer>(device_->context, shaderRoot(), scene_,
                                                       simulation.plan(), options);
            renderer_->resize(width, height);
            View view = View::of(scene_.camera, simulation.time());
            if (eye) view.eye = vectorOf(*eye);
            if (target) view.target = vectorOf(*target);
            if (fieldOfView) view.fieldOfView = *fieldOfView;
            renderer_->draw(simulation.state(), view);
            image = renderer_->capture();
        }
        py::array_t<uint8_t> out({py::ssize_t(height), py::ssize_t(width), py::ssize_t(4)});
        std::copy(image.pixels.begin(), image.pixels.end(), out.mutable_data());
        return out;
    }

    void save(const std::filesystem::path& file) {
        Simulation& simulation = use();
        writeCheckpoint(file, simulation.plan(), {simulation.save(), simulation.parameters});
    }
    void load(const std::filesystem::path& file) {
        Simulation& simulation = use();
        const Checkpoint read = readCheckpoint(file, simulation.plan());
        simulation.load(read.state);
        simulation.parameters = read.parameters;
    }

    Simulation& use() {
        if (!simulation_) throw Error("the simulation was closed");
        enter(*device_);
        return *simulation_;
    }

  private:
    // By name, number, or None where there is one.
    size_t groupOf(const py::object& group) {
        const std::vector<GroupPlan>& groups = use().plan().groups;
        if (group.is_none()) {
            if (groups.size() == 1) return 0;
            throw Error("the scene has ", groups.size(), " groups: say which, by name or number");
        }
        if (py::isinstance<py::int_>(group)) {
            const auto number = group.cast<py::ssize_t>();
            if (number >= 0 && size_t(number) < groups.size()) return size_t(number);
            throw Error("there is no group ", number, ": the scene has ", groups.size());
        }
        const auto word = group.cast<std::string>();
        std::vector<std::string> names;
        for (size_t i = 0; i < groups.size(); ++i) {
            if (groups[i].name == word) return i;
            names.push_back(groups[i].name);
        }
        throw Error("the scene has no group \"", word, "\"", suggestion(word, names));
    }

    // The array takes the vector's memory.
    template <typename Vector>
    py::array vectors(const py::object& group, std::vector<Vector> Snapshot::*values) {
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
        return py::array_t<Number>(
            {py::ssize_t(state->count), py::ssize_t(state->vertexCount), py::ssize_t(3)}, &kept->data()->x,
            owner);
    }

    static std::vector<glm::dvec3> given(const char* what, const Array& array, const GroupPlan& plan) {
        const py::ssize_t shape[] = {plan.count, plan.vertexCount, 3};
        std::string found;
        for (py::ssize_t i = 0; i < array.ndim(); ++i)
            found += concat(i ? ", " : "", array.shape(i));
        if (array.ndim() != 3 || !std::equal(shape, shape + 3, array.shape()))
            throw Error(what, ": expected an array of shape (", shape[0], ", ", shape[1], ", 3), found (",
                        found, ")");
        std::vector<glm::dvec3> out(size_t(plan.count) * size_t(plan.vertexCount));
        std::copy_n(array.data(), 3 * out.size(), &out.data()->x);
        for (const glm::dvec3& value : out)
            if (!std::isfinite(value.x + value.y + value.z)) throw Error(what, ": a number is not finite");
        return out;
    }

    Scene scene_;
    Device* device_ = nullptr;
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Renderer> renderer_;
};

// ---- Checks and measurements

struct FileFinding {
    std::string file, path, message;
    int line = 0;
    bool error = false;
};

FileFinding findingOf(const Location& where, const std::string& message, bool error) {
    return {where.file, where.path, message, where.line, error};
}

// Returns the mistakes in a file and, as warnings, what is probably not meant.
std::vector<FileFinding> checkFile(const std::filesystem::path& file) {
    std::vector<FileFinding> out;
    const auto tell = [&](const Molecule& molecule) {
        for (const Warning& warning : check(molecule))
            out.push_back(findingOf(warning.location, warning.message, false));
    };
    try {
        const std::string name = file.string();
        const std::string scene = sceneFile(name).value_or(name);
        const JsonValue json = readJson(scene);
        if (json.find("groups")) {
            const Scene read = readScene(scene);
            compile(read);
            for (const Group& group : read.groups)
                if (!group.particle) tell(group.molecule);
        } else {
            tell(readMolecule(name));
        }
    } catch (const Error& error) {
        out.push_back(findingOf(error.location(), error.message(), true));
    }
    return out;
}

py::list measureScene(const PyScene& scene, double duration, std::optional<double> seconds,
                      std::optional<int> device) {
    measure::AccuracyReport report;
    {
        const py::gil_scoped_release release;
        Device& on = deviceOf(device);
        enter(on);
        measure::AccuracyOptions options;
        options.duration = duration;
        options.seconds = seconds;
        report = measure::measureAccuracy(scene.scene, options,
                                          {&on.context, shaderRoot(), &on.cache, allThreads()});
    }
    py::list out;
    for (const measure::AccuracyPoint& point : report.points) {
        py::dict row;
        row["solver"] = name(point.method.solver);
        row["field_sampling"] = name(point.method.sampling);
        row["substeps"] = point.step.substeps;
        row["steps_per_second"] = point.stepsPerSecond;
        row["outcome"] = measure::name(point.outcome);
        row["error"] = point.error ? py::object(py::float_(point.error->total)) : py::none();
        row["seconds_per_vertex_second"] =
            point.time.samples > 0 ? py::object(py::float_(point.time.median)) : py::none();
        row["front"] = point.front;
        out.append(row);
    }
    return out;
}

}  // namespace

}  // namespace shoal::python

PYBIND11_MODULE(shoal, m) {
    using namespace shoal;
    using namespace shoal::python;
    m.doc() =
        "Very many small mass-spring meshes, simulated and drawn on the GPU. SI units; arrays of shape "
        "(molecules, vertices, 3).";
    m.attr("__version__") = SHOAL_VERSION;

    // Kept for as long as the interpreter runs.
    static PyObject* failure = PyErr_NewExceptionWithDoc(
        "shoal.Error", "What went wrong: file, line and path say where, None where that is not in a file.",
        PyExc_RuntimeError, nullptr);
    m.attr("Error") = py::handle(failure);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Error& error) {
            const py::object value = py::reinterpret_borrow<py::object>(failure)(std::string(error.what()));
            const Location& where = error.location();
            const auto text = [](const std::string& s) {
                return s.empty() ? py::object(py::none()) : py::str(s);
            };
            value.attr("file") = text(where.file);
            value.attr("line") = where.line > 0 ? py::object(py::int_(where.line)) : py::none();
            value.attr("path") = text(where.path);
            value.attr("message") = error.message();
            PyErr_SetObject(failure, value.ptr());
        }
    });

    py::class_<PyMolecule>(m, "Molecule", "A small mesh of vertices, springs and triangles.")
        .def(py::init(&moleculeFrom), py::arg("source"), "From a file, or a dict with the keys of one.")
        .def_property_readonly("name", [](const PyMolecule& self) { return self.molecule.name; })
        .def_property_readonly("vertices", &restPositions, "Rest positions, m, of shape (vertices, 3).")
        .def_property_readonly("springs", [](const PyMolecule& self) { return self.molecule.springs.size(); })
        .def(
            "save",
            [](const PyMolecule& self, const std::filesystem::path& file) {
                writeFile(file, writeMolecule(self.molecule));
            },
            py::arg("file"), "Writes the molecule's file.");

    py::class_<PyScene>(m, "Scene", "Groups of molecules, and what acts on them.")
        .def(py::init(&sceneFrom), py::arg("source"), py::arg("folder") = std::filesystem::path("."),
             "From a file, the name of a scene that ships, or a dict with the keys of a scene file, whose "
             "file names "
             "are relative to `folder`. A group's \"molecule\" may also be a Molecule or a dict.")
        .def_property_readonly("name", [](const PyScene& self) { return self.scene.name; })
        .def_property_readonly("groups", [](const PyScene& self) {
            std::vector<std::string> out;
            for (const Group& group : self.scene.groups)
                out.push_back(group.name);
            return out;
        });

    py::class_<Parameters>(m, "Parameters", "What may change between frames.")
        .def_readwrite("wind", &Parameters::wind, "Factor on every field.")
        .def_readwrite("drag", &Parameters::drag, "Factor on every drag rate.")
        .def_readwrite("stiffness", &Parameters::stiffness, "Factor on every spring.")
        .def_readwrite("damping", &Parameters::damping, "Factor on every spring's damping.")
        .def_readwrite("substeps", &Parameters::substeps, "Of a frame.")
        .def_readwrite("frame_time", &Parameters::frameTime, "s, of a frame.")
        .def_readwrite("fields", &Parameters::fields,
                       "Factors on the fields' weights, in the scene's order; those left out: 1.")
        .def_property(
            "forces",
            [](const Parameters& self) {
                std::vector<double> out;
                for (const ForceControl& force : self.forces)
                    out.push_back(force.factor);
                return out;
            },
            [](Parameters& self, const std::vector<double>& factors) {
                if (factors.size() != self.forces.size())
                    throw Error("forces: expected ", self.forces.size(), " factors, found ", factors.size());
                for (size_t i = 0; i < factors.size(); ++i)
                    self.forces[i].factor = factors[i];
            },
            "Factors on the strengths of the forces, in the scene's order.")
        .def_property(
            "gravity",
            [](const Parameters& self) {
                return std::array{self.gravity.x, self.gravity.y, self.gravity.z};
            },
            [](Parameters& self, const std::array<double, 3>& value) { self.gravity = vectorOf(value); },
            "m/s^2.");

    const auto group = py::arg("group") = py::none();
    py::class_<PySimulation>(m, "Simulation", "A scene that moves, on the GPU.")
        .def(py::init<const PyScene&, const std::optional<std::string>&, std::optional<int>,
                      std::optional<int>, const std::string&>(),
             py::arg("scene"), py::kw_only(), py::arg("solver") = py::none(),
             py::arg("substeps") = py::none(), py::arg("device") = py::none(), py::arg("path") = "auto",
             "`device`: of those that `shoal info` lists; None: the best.")
        .def("step", &PySimulation::step, py::arg("frames") = 1, Unlocked(), "Goes on by so many frames.")
        .def("restart", &PySimulation::restart, Unlocked(), "Back to the start state.")
        .def("close", &PySimulation::close, "Frees what it holds on the device.")
        .def(
            "__enter__", [](PySimulation& self) -> PySimulation& { return self; },
            py::return_value_policy::reference)
        .def("__exit__", [](PySimulation& self, const py::args&) { self.close(); })
        .def_property_readonly("time", &PySimulation::time, "s.")
        .def_property_readonly("frames", &PySimulation::frames)
        .def_property_readonly("groups", &PySimulation::groups, "Their names.")
        .def_property_readonly(
            "parameters", [](PySimulation& self) -> Parameters& { return self.use().parameters; },
            py::return_value_policy::reference_internal)
        .def("solver", &PySimulation::solver, group, "The method of a group.")
        .def("positions", &PySimulation::positions, group,
             "m, float64 of shape (molecules, vertices, 3): a copy.")
        .def("velocities", &PySimulation::velocities, group, "m/s, likewise.")
        .def("normals", &PySimulation::normals, group,
             "Unit vectors, float32; zero where there are no triangles.")
        .def("alive", &PySimulation::alive, group, "Whether each place holds a living molecule.")
        .def("set_state", &PySimulation::setState, group, py::kw_only(), py::arg("positions") = py::none(),
             py::arg("velocities") = py::none(), "Arrays of the shape of positions(), m and m/s.")
        .def("energy", &PySimulation::energy, group, "J, of all living: kinetic, elastic (springs), gravity.")
        .def("picture", &PySimulation::picture, py::arg("width") = 640, py::arg("height") = 360,
             py::kw_only(), py::arg("eye") = py::none(), py::arg("target") = py::none(),
             py::arg("field_of_view") = py::none(),
             "RGBA, uint8 of shape (height, width, 4), from the scene's camera or from `eye` to `target` (m; "
             "rad).")
        .def("hash", &PySimulation::hash, "Of the state's bits: equal states, equal hashes.")
        .def("save", &PySimulation::save, py::arg("file"), "Writes a checkpoint.")
        .def("load", &PySimulation::load, py::arg("file"), "Goes on from a checkpoint of this scene.");

    py::class_<FileFinding>(m, "Finding", "Something wrong in a file, or probably not meant.")
        .def_readonly("file", &FileFinding::file)
        .def_readonly("line", &FileFinding::line)
        .def_readonly("path", &FileFinding::path)
        .def_readonly("message", &FileFinding::message)
        .def_readonly("error", &FileFinding::error, "Whether the file cannot be used.")
        .def("__repr__", [](const FileFinding& self) {
            return concat(self.file, ":", self.line, ": ",
                          self.error ? "error: " : "warning: ", self.message);
        });
    m.def("check", &checkFile, py::arg("file"), Unlocked(), "The findings in a molecule's or scene's file.");
    m.def("measure", &measureScene, py::arg("scene"), py::kw_only(), py::arg("duration") = 1.0,
          py::arg("seconds") = py::none(), py::arg("device") = py::none(),
          "Error against cost of every method, as a list of dicts: relative error; s per vertex and "
          "simulated second. "
          "`duration`: s of simulated time; `seconds`: of measuring, about.");
}
