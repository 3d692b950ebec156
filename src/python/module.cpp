// The Python module `shoal`: scenes, simulations and molecules, with state as NumPy arrays (docs/python.md).
// The interpreter's lock is released while a simulation steps, draws or compiles.
#include "core/file.h"
#include "core/json.h"
#include "core/parallel.h"
#include "measure/accuracy.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "python/arguments.h"
#include "python/parameters.h"
#include "python/picture.h"
#include "python/scene.h"
#include "python/simulation.h"
#include "run/scene_list.h"
#include "scene/json/scene_file.h"

namespace shoal::python {

using Unlocked = py::call_guard<py::gil_scoped_release>;

// ---- Checks and measurements

struct FileFinding {
    std::string file, path, message;
    int line = 0;
    bool error = false;
};

}  // namespace shoal::python

template <>
class pybind11::detail::type_caster<shoal::python::FileFinding>
    : public shoal::python::MadeCaster<shoal::python::FileFinding> {};

namespace shoal::python {

namespace {

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

std::vector<SolverKind> solversOf(const std::vector<std::string>& words) {
    std::vector<SolverKind> out;
    for (const std::string& word : words) {
        const std::optional<SolverKind> kind = solverOf(word);
        if (!kind) throw Error("solvers: expected the names of solvers; auto is the choice among them");
        out.push_back(*kind);
    }
    return out;
}

py::list measureScene(const PyScene& scene, double duration, const std::vector<std::string>& solvers,
                      std::optional<double> seconds, std::optional<int> device) {
    if (!(finite("duration", duration) > 0)) throw Error("duration is above 0, not ", duration);
    if (seconds && !(finite("seconds", *seconds) > 0)) throw Error("seconds is above 0, not ", *seconds);
    measure::AccuracyOptions options;
    options.duration = duration;
    options.solvers = solversOf(solvers);
    options.seconds = seconds;
    measure::AccuracyReport report;
    {
        const py::gil_scoped_release release;
        Device& on = deviceOf(device);
        enter(on);
        SignalWatch watch;
        report = measure::measureAccuracy(
            scene.scene, options, {&on.context, allThreads()},
            {.stage = [&](const char*) { watch.look(); }, .tell = [&](double) { watch.look(); }});
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

void bindSimulation(py::module_& m) {
    const auto group = py::arg("group") = py::none();
    py::class_<PySimulation>(m, "Simulation", "A scene that moves, on the GPU.")
        .def(py::init<const PyScene&, const std::optional<std::string>&, std::optional<int>,
                      std::optional<int>, const std::string&, bool>(),
             py::arg("scene"), py::kw_only(), py::arg("solver") = py::none(),
             py::arg("substeps") = py::none(), py::arg("device") = py::none(), py::arg("path") = "auto",
             py::arg("diagnostics") = true,
             "`solver`: by its name, and `substeps` of a frame: None: as the scene says; `device`: of those "
             "that `shoal info` lists, None: the best; `path`: auto, fused, fragments or ping-pong; "
             "`diagnostics`: step() reads for "
             "diagnostics() now and then.")
        .def("step", &PySimulation::step, py::arg("frames") = 1, Unlocked(),
             "Goes on by so many frames, each of parameters.frame_time (s).")
        .def("restart", &PySimulation::restart, Unlocked(),
             "Goes back to the start state, with the parameters as they are.")
        .def("close", &PySimulation::close, "Frees what it holds on the device.")
        .def(
            "__enter__", [](PySimulation& self) -> PySimulation& { return self; },
            py::return_value_policy::reference)
        .def("__exit__", [](PySimulation& self, const py::args&) { self.close(); })
        .def_property_readonly("time", &PySimulation::time, "Simulated time since the start, in s.")
        .def_property_readonly("frames", &PySimulation::frames, "How many were taken since the start.")
        .def_property_readonly("groups", &PySimulation::groups, "The names of the groups.")
        .def_property_readonly(
            "parameters",
            py::cpp_function([](PySimulation& self) { return PyParameters{&self}; }, py::keep_alive<0, 1>()),
            "What may change between frames: see Parameters.")
        .def("solver", &PySimulation::solver, group, "The name of the method that a group takes.")
        .def("positions", &PySimulation::positions, group,
             "Positions in m, float64 of shape (molecules, vertices, 3): a copy.")
        .def("velocities", &PySimulation::velocities, group,
             "Velocities in m/s, float64 of shape (molecules, vertices, 3): a copy.")
        .def("normals", &PySimulation::normals, group,
             "Unit normals, float32 of shape (molecules, vertices, 3): a copy; zero where there are no "
             "triangles.")
        .def("alive", &PySimulation::alive, group,
             "Whether each place holds a living molecule, bool of shape (molecules,).")
        .def("set_state", &PySimulation::setState, group, py::kw_only(), py::arg("positions") = py::none(),
             py::arg("velocities") = py::none(),
             "Writes `positions` in m, `velocities` in m/s, or both: arrays of shape (molecules, vertices, "
             "3).")
        .def("energy", &PySimulation::energy, group,
             "Energies in J of all that live: kinetic, elastic (of the springs), gravity.")
        .def("diagnostics", &PySimulation::diagnostics,
             "What the run tells of itself, as a dict: strain, contacts, and an estimate of its error, with "
             "None for what is not known.")
        .def("picture", &PySimulation::picture, py::arg("width") = 640, py::arg("height") = 360,
             py::kw_only(), py::arg("eye") = py::none(), py::arg("target") = py::none(),
             py::arg("field_of_view") = py::none(),
             "Draws a Picture of `width` times `height` pixels, from the scene's camera or from `eye` to "
             "`target` (x, y, z in m) with a vertical `field_of_view` in rad.")
        .def("_repr_png_", &PySimulation::shown, "What a notebook shows: the picture as it is now.")
        .def("hash", &PySimulation::hash, "A hash of the state's bits: equal states have equal ones.")
        .def("save", &PySimulation::save, py::arg("file"), "Writes a checkpoint, as `shoal run --save` does.")
        .def("load", &PySimulation::load, py::arg("file"), "Goes on from a checkpoint of this scene.");
}

void bindChecks(py::module_& m) {
    py::class_<FileFinding>(m, "Finding", "Something wrong in a file, or probably not meant.")
        .def_readonly("file", &FileFinding::file, "Where it is.")
        .def_readonly("line", &FileFinding::line, "From 1; 0: of the whole file.")
        .def_readonly("path", &FileFinding::path, "Of the value in the file, such as $.groups[0].count.")
        .def_readonly("message", &FileFinding::message, "What is wrong.")
        .def_readonly("error", &FileFinding::error, "Whether the file cannot be used.")
        .def("__repr__", [](const FileFinding& self) {
            return concat(self.file, ":", self.line, ": ",
                          self.error ? "error: " : "warning: ", self.message);
        });
    m.def("check", &checkFile, py::arg("file"), Unlocked(), "The findings in a molecule's or scene's file.");
    m.def("measure", &measureScene, py::arg("scene"), py::kw_only(), py::arg("duration") = 1.0,
          py::arg("solvers") = std::vector<std::string>(), py::arg("seconds") = py::none(),
          py::arg("device") = py::none(),
          "Error against cost of every method, as a list of dicts: relative error; s per vertex and "
          "simulated second. `duration`: s of simulated time; `solvers`: only these, or all where none is "
          "named; `seconds`: about how long all of it may take, None: as long as it does.");
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
        .def_property_readonly(
            "name", [](const PyMolecule& self) { return self.molecule.name; }, "The name in its file.")
        .def_property_readonly("vertices", &restPositions,
                               "Rest positions in m, float64 of shape (vertices, 3).")
        .def_property_readonly(
            "springs", [](const PyMolecule& self) { return self.molecule.springs.size(); },
            "How many springs it has.")
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
        .def_property_readonly(
            "name", [](const PyScene& self) { return self.scene.name; }, "The name in its file.")
        .def_property_readonly(
            "groups",
            [](const PyScene& self) {
                std::vector<std::string> out;
                for (const Group& group : self.scene.groups)
                    out.push_back(group.name);
                return out;
            },
            "The names of the groups.");

    bindPicture(m);
    bindParameters(m);
    bindSimulation(m);
    bindChecks(m);
    tellArguments(m);
}
