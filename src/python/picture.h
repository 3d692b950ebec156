// Pictures: NumPy arrays that can be written, and that notebooks show.
#pragma once

#include "core/image.h"
#include "python/scene.h"

namespace shoal::python {

// Makes the class Picture, a subclass of NumPy's array.
void bindPicture(py::module_& m);
// A Picture of shape (height, width, channels).
py::array pictureOf(const Image& image);

}  // namespace shoal::python
