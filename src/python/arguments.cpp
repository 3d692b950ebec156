#include "python/arguments.h"

#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "core/error.h"

namespace shoal::python {

namespace py = pybind11;

namespace {

// Types as people write them; pybind11's names differ from version to version.
std::string inOurWords(const std::string& signature) {
    static const std::pair<std::regex, const char*> words[] = {
        {std::regex(R"(typing\.|collections\.abc\.|shoal\.)"), ""},
        {std::regex(R"(SupportsInt \| SupportsIndex)"), "int"},
        {std::regex(R"(SupportsFloat \| SupportsIndex)"), "float"},
        {std::regex(R"(Annotated\[[Ll]ist\[float\], FixedSize\(3\)\]|[Ll]ist\[float\[3\]\])"),
         "three floats"},
        {std::regex(R"(numpy\.ndarray\[numpy\.float64[^\]]*\])"), "array of floats"},
        {std::regex(R"(Union\[os\.PathLike, str, bytes\]|os\.PathLike)"), "file"},
        {std::regex(R"(PosixPath\(('[^']*')\))"), "$1"},
        {std::regex(R"(\barg\d+: )"), ""},
    };
    std::string out = signature;
    for (const auto& [foreign, ours] : words)
        out = std::regex_replace(out, foreign, ours);
    return out;
}

// Returns "step(self, frames=1)" of "step(self: Simulation, frames: int = 1) -> None": inspect and help()
// read that from the first line of a builtin's doc. Nothing: the text begins otherwise.
std::string plainSignature(const std::string& text) {
    const std::string line = text.substr(0, text.find('\n'));
    const size_t begin = line.find('('), end = line.rfind(") -> ");
    if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
    std::string out = line.substr(0, begin);
    int depth = 0;
    bool isType = false;  // between a parameter's name and its default
    for (size_t i = begin; i <= end; ++i) {
        const char c = line[i];
        depth += (c == '(' || c == '[') - (c == ')' || c == ']');
        if (depth == 1 && c == ':') isType = true;
        const bool isDefault = depth == 1 && line.compare(i, 3, " = ") == 0;
        if (isDefault || (depth == 1 && c == ',') || depth == 0) isType = false;
        if (isType) continue;
        if (isDefault) i += 2;
        out += isDefault ? '=' : c;
    }
    return out;
}

// Returns the parameters, without that of the object itself: of "    1. (self: X, frames: int = 1) -> None"
// in pybind11's message "frames: int = 1". Nothing: the message is another.
std::optional<std::string> parametersIn(const std::string& message, bool method) {
    if (message.find("): incompatible ") == std::string::npos) return {};
    const std::string first = "\n    1. ";
    size_t begin = message.find(first);
    const size_t end = message.find('\n', begin + 1);
    if (begin == std::string::npos || end == std::string::npos) return {};
    begin = message.find('(', begin) + 1;
    // that of a constructor is "    1. shoal.X(frames: int = 1)"
    const std::string line = message.substr(begin, end - begin);
    const size_t arrow = line.rfind(") -> ");
    const std::string inside = line.substr(0, arrow != std::string::npos ? arrow : line.rfind(')'));
    if (inside.empty() || !method || arrow == std::string::npos) return inOurWords(inside);
    const size_t comma = inside.find(", ");
    return comma == std::string::npos ? "" : inOurWords(inside.substr(comma + 2));
}

std::string shown(py::handle value) {
    constexpr size_t longest = 60;
    std::string out;
    try {
        out = std::string(py::repr(value));
    } catch (py::error_already_set&) {
        out = Py_TYPE(value.ptr())->tp_name;
    }
    return out.size() > longest ? concat("a ", Py_TYPE(value.ptr())->tp_name) : out;
}

std::string shown(const py::args& given, const py::kwargs& named, bool method) {
    std::vector<std::string> all;
    for (size_t i = method ? 1 : 0; i < given.size(); ++i)
        all.push_back(shown(given[i]));
    for (const auto& [key, value] : named)
        all.push_back(concat(std::string(py::str(key)), "=", shown(value)));
    std::string out;
    for (const std::string& name : all)
        out += (out.empty() ? "" : ", ") + name;
    return out;
}

// `owner`: the class, or nothing in the module itself.
py::object told(const py::object& function, const std::string& name, const std::optional<py::type>& owner) {
    const bool method = owner.has_value();
    const std::string whole =
        method ? concat(std::string(py::str(owner->attr("__name__"))), ".", name) : name;
    const auto call = [=](const py::args& given, const py::kwargs& named) -> py::object {
        try {
            return function(*given, **named);
        } catch (py::error_already_set& error) {
            if (!error.matches(PyExc_TypeError)) throw;
            const std::optional<std::string> takes =
                parametersIn(std::string(py::str(error.value())), method);
            if (!takes) throw;
            throw py::type_error(
                concat(whole, ": expected (", *takes, "), found (", shown(given, named, method), ")"));
        }
    };
    const py::object doc = py::getattr(function, "__doc__", py::none());
    std::string text = doc.is_none() ? "" : inOurWords(std::string(py::str(doc)));
    if (const std::string signature = plainSignature(text); !signature.empty())
        text = concat(signature, "\n--\n\n", text);
    if (!method) return py::cpp_function(call, py::name(name.c_str()), py::doc(text.c_str()));
    return py::cpp_function(call, py::name(name.c_str()), py::doc(text.c_str()), py::is_method(*owner));
}

void tellMembers(const py::type& type) {
    const auto property = py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyProperty_Type));
    const py::dict members(type.attr("__dict__"));
    for (const std::pair<py::handle, py::handle> item : members) {
        const py::handle member = item.second;
        const auto name = std::string(py::str(item.first));
        if (PyInstanceMethod_Check(member.ptr())) {
            type.attr(name.c_str()) = told(py::reinterpret_borrow<py::object>(member), name, type);
        } else if (py::isinstance(member, property)) {
            const auto side = [&](const char* which) -> py::object {
                const py::object function = member.attr(which);
                return function.is_none() ? function : told(function, name, type);
            };
            type.attr(name.c_str()) =
                property(side("fget"), side("fset"), py::none(), member.attr("__doc__"));
        }
    }
}

}  // namespace

void tellArguments(py::module_& m) {
    py::options options;
    options.disable_function_signatures();
    const py::dict members(m.attr("__dict__").attr("copy")());
    for (const auto& [key, member] : members) {
        const auto name = std::string(py::str(key));
        if (PyCFunction_Check(member.ptr()))
            m.attr(name.c_str()) = told(py::reinterpret_borrow<py::object>(member), name, {});
        else if (PyType_Check(member.ptr()) && !PyExceptionClass_Check(member.ptr()))
            tellMembers(py::reinterpret_borrow<py::type>(member));
    }
}

double number(const char* what, py::handle value) {
    const double out = PyFloat_AsDouble(value.ptr());
    if (!(out == -1 && PyErr_Occurred())) return out;
    PyErr_Clear();
    throw py::type_error(concat(what, ": expected a number, found ", shown(value)));
}

py::ssize_t indexOf(const py::object& value) {
    const py::ssize_t out = PyNumber_AsSsize_t(value.ptr(), nullptr);
    if (out == -1 && PyErr_Occurred()) throw py::error_already_set();
    return out;
}

}  // namespace shoal::python
