// Molecules and scenes from files and from Python's dicts.
#pragma once

#include <array>
#include <filesystem>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/made.h"
#include "scene/scene.h"

namespace shoal::python {

namespace py = pybind11;

struct PyMolecule {
    Molecule molecule;
};
struct PyScene {
    Scene scene;
};

// From a file, or a dict with the keys of one.
PyMolecule moleculeFrom(const py::object& source);
// m, of shape (vertices, 3).
py::array_t<double> restPositions(const PyMolecule& self);
// From a file, the name of a scene that ships, or a dict whose file names are relative to `folder`.
PyScene sceneFrom(const py::object& source, const std::filesystem::path& folder);

}  // namespace shoal::python

template <>
class pybind11::detail::type_caster<shoal::python::PyMolecule>
    : public shoal::python::MadeCaster<shoal::python::PyMolecule> {};
template <>
class pybind11::detail::type_caster<shoal::python::PyScene>
    : public shoal::python::MadeCaster<shoal::python::PyScene> {};
