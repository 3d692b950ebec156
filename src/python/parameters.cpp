#include "python/parameters.h"

#include <algorithm>
#include <functional>

#include "core/error.h"
#include "python/arguments.h"

namespace shoal::python {

// Factors on the fields' weights or the forces' strengths, by name or number.
class PyFactors {
  public:
    enum class Kind { fields, forces };

    PyFactors(PySimulation& simulation, Kind kind) : simulation_(&simulation), kind_(kind) {}

    size_t size() const { return names().size(); }
    std::vector<std::string> names() const {
        std::vector<std::string> out;
        const Scene& scene = simulation_->scene();
        if (kind_ == Kind::fields)
            for (const Field& field : scene.fields)
                out.push_back(field.name);
        else
            for (const Force& force : scene.forces)
                out.push_back(force.name);
        return out;
    }
    double get(const py::object& key) const { return valueOf(indexOf(key)); }
    std::vector<double> values() const {
        std::vector<double> out;
        for (size_t i = 0; i < size(); ++i)
            out.push_back(valueOf(i));
        return out;
    }
    py::list items() const {
        py::list out;
        for (const std::string& name : names())
            out.append(py::make_tuple(name, valueOf(out.size())));
        return out;
    }
    void set(const py::object& key, double factor) { setValue(indexOf(key), finite(what(), factor)); }
    // A mapping changes those that it names, a list all.
    void setAll(const py::object& factors) {
        if (py::hasattr(factors, "keys")) {
            std::vector<std::pair<size_t, double>> all;  // nothing changes where one of them is wrong
            for (const py::handle key : factors.attr("keys")()) {
                const double value = number(what(), factors.attr("__getitem__")(key));
                all.emplace_back(indexOf(py::reinterpret_borrow<py::object>(key)), finite(what(), value));
            }
            for (const auto& [index, value] : all)
                setValue(index, value);
            return;
        }
        if (!py::isinstance<py::sequence>(factors) || py::isinstance<py::str>(factors))
            throw py::type_error(concat(what(), ": expected a list or a mapping of factors, found ",
                                        std::string(py::repr(factors))));
        std::vector<double> list;
        for (const py::handle factor : factors)
            list.push_back(number(what(), factor));
        if (list.size() != size())
            throw Error(what(), ": expected ", size(), " factors, found ", list.size());
        for (const double value : list)
            finite(what(), value);
        for (size_t i = 0; i < list.size(); ++i)
            setValue(i, list[i]);
    }
    std::string text() const { return concat("Factors(", std::string(py::str(py::dict(items()))), ")"); }

  private:
    const char* what() const { return kind_ == Kind::fields ? "fields" : "forces"; }
    size_t indexOf(const py::object& key) const {
        const std::vector<std::string> all = names();
        if (PyIndex_Check(key.ptr())) {
            const py::ssize_t index = python::indexOf(key);
            if (index >= 0 && size_t(index) < all.size()) return size_t(index);
            throw Error(what(), ": there is no number ", index, ": the scene has ", all.size());
        }
        if (!py::isinstance<py::str>(key))
            throw Error(what(), ": expected a name or a number, found ", std::string(py::repr(key)));
        const auto word = std::string(py::str(key));
        const auto found = std::find(all.begin(), all.end(), word);
        if (found == all.end()) throw Error(what(), ": there is no \"", word, "\"", suggestion(word, all));
        return size_t(found - all.begin());
    }
    double valueOf(size_t index) const {
        const Parameters& parameters = simulation_->use().parameters;
        if (kind_ == Kind::forces) return parameters.forces[index].factor;
        return index < parameters.fields.size() ? parameters.fields[index] : 1;
    }
    void setValue(size_t index, double value) {
        if (valueOf(index) == value) return;
        Parameters& parameters = simulation_->use().parameters;
        if (kind_ == Kind::forces) {
            parameters.forces[index].factor = value;
            return;
        }
        if (parameters.fields.size() < size()) parameters.fields.resize(size(), 1);
        parameters.fields[index] = value;
    }

    PySimulation* simulation_;
    Kind kind_;
};

}  // namespace shoal::python

template <>
class pybind11::detail::type_caster<shoal::python::PyFactors>
    : public shoal::python::MadeCaster<shoal::python::PyFactors> {};

namespace shoal::python {

static Parameters& parametersOf(const PyParameters& self) {
    return self.simulation->use().parameters;
}

void bindParameters(py::module_& m) {
    py::class_<PyFactors>(m, "Factors", "Factors by name or number, in the scene's order.")
        .def("__len__", &PyFactors::size)
        .def("__getitem__", &PyFactors::get, py::arg("key"))
        .def("__setitem__", &PyFactors::set, py::arg("key"), py::arg("factor"))
        .def("__iter__", [](const PyFactors& self) { return py::iter(py::cast(self.names())); })
        .def("keys", &PyFactors::names, "Their names.")
        .def("values", &PyFactors::values, "The factors.")
        .def("items", &PyFactors::items, "Pairs of name and factor.")
        .def("__repr__", &PyFactors::text);

    py::class_<PyParameters> out(m, "Parameters", "What may change between frames.");
    // Of a number; `set` refuses what it cannot be.
    const auto number = [&](const char* name, double Parameters::*member, const char* expected,
                            const std::function<bool(double)>& holds, const char* doc) {
        out.def_property(
            name, [member](const PyParameters& self) { return parametersOf(self).*member; },
            [name, member, expected, holds](PyParameters& self, double value) {
                if (!holds(finite(name, value))) throw Error(name, " is ", expected, ", not ", value);
                Parameters changed = parametersOf(self);
                changed.*member = value;
                self.simulation->setParameters(name, changed);
            },
            doc);
    };
    const auto positive = [](double value) { return value >= 0; };
    number(
        "wind", &Parameters::wind, "", [](double) { return true; },
        "Factor on every field; 1 as in the scene.");
    number("drag", &Parameters::drag, "at least 0", positive,
           "Factor on every drag rate, at least 0; 1 as in the scene.");
    number("stiffness", &Parameters::stiffness, "at least 0", positive,
           "Factor on every spring's stiffness, at least 0; 1 as in the molecule.");
    number("damping", &Parameters::damping, "at least 0", positive,
           "Factor on every spring's damping, at least 0; 1 as in the molecule.");
    number(
        "frame_time", &Parameters::frameTime, "from 1e-5 to 1 s",
        [](double value) { return value >= 1e-5 && value <= 1; }, "Of a frame, in s.");
    out.def_property(
        "substeps", [](const PyParameters& self) { return parametersOf(self).substeps; },
        [](PyParameters& self, int value) {
            if (value < 1 || value > maxSubsteps)
                throw Error("a frame has 1 to ", maxSubsteps, " substeps, not ", value);
            self.simulation->setParameters("substeps", parametersOf(self), value);
        },
        "Of a frame, 1 to 1000. Where stiffness, damping, drag or frame_time need more than were asked for, "
        "a "
        "frame takes these, and a RuntimeWarning says how many.");
    out.def_property(
        "gravity",
        [](const PyParameters& self) {
            const glm::dvec3& g = parametersOf(self).gravity;
            return Vector3{g.x, g.y, g.z};
        },
        [](PyParameters& self, const Vector3& value) {
            parametersOf(self).gravity = finite("gravity", value);
        },
        "x, y, z in m/s^2; what it returns is a copy.");
    const auto factors = [&](const char* name, PyFactors::Kind kind, const char* doc) {
        out.def_property(
            name,
            py::cpp_function([kind](PyParameters& self) { return PyFactors(*self.simulation, kind); },
                             py::keep_alive<0, 1>()),
            py::cpp_function([kind](PyParameters& self, const py::object& value) {
                PyFactors(*self.simulation, kind).setAll(value);
            }),
            doc);
    };
    factors("fields", PyFactors::Kind::fields, "Factors on the fields' weights; set by a list or a dict.");
    factors("forces", PyFactors::Kind::forces, "Factors on the forces' strengths; set by a list or a dict.");
}

}  // namespace shoal::python
