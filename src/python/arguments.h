// Replaces pybind11's message about arguments that do not fit by one of ours.
#pragma once

#include <pybind11/pybind11.h>

namespace shoal::python {

// Wraps all functions, methods and properties that the module has by now. TypeError: which was called, what
// it takes, what it was given.
void tellArguments(pybind11::module_& m);

// TypeError: `value` is no number; tells `what` it is.
double number(const char* what, pybind11::handle value);
// Returns a number that counts from 0; what is too large for any index is cut to the largest.
pybind11::ssize_t indexOf(const pybind11::object& value);

}  // namespace shoal::python
