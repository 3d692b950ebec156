// The parameters of a simulation that may change between frames.
#pragma once

#include "python/simulation.h"

namespace shoal::python {

struct PyParameters {
    PySimulation* simulation;
};

// Makes the classes Parameters and Factors, whose objects keep the simulation.
void bindParameters(py::module_& m);

}  // namespace shoal::python

template <>
class pybind11::detail::type_caster<shoal::python::PyParameters>
    : public shoal::python::MadeCaster<shoal::python::PyParameters> {};
