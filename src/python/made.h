// Python makes objects without their constructor (X.__new__(X), copies, subclasses whose constructor failed):
// these hold nothing, and pybind11 would hand out memory that nobody wrote to.
#pragma once

#include <pybind11/pybind11.h>

#include "core/error.h"

namespace shoal::python {

// The caster of a class, to be derived from as pybind11::detail::type_caster<T>.
// Error: the object was made without its constructor.
template <typename T>
class MadeCaster : public pybind11::detail::type_caster_base<T> {
  public:
    bool load(pybind11::handle source, bool convert) {
        if (source && pybind11::isinstance<T>(source)) {
            auto* object = reinterpret_cast<pybind11::detail::instance*>(source.ptr());
            const auto* type = pybind11::detail::get_type_info(typeid(T));
            if (!object->get_value_and_holder(type).holder_constructed())
                throw Error("this ", type->type->tp_name,
                            " was made without its constructor: it holds nothing");
        }
        return pybind11::detail::type_caster_base<T>::load(source, convert);
    }
};

}  // namespace shoal::python
