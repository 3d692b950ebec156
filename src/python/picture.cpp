#include "python/picture.h"

#include <algorithm>

#include <pybind11/numpy.h>
#include <pybind11/stl/filesystem.h>

#include "core/error.h"
#include "core/file.h"

namespace shoal::python {

namespace {

PyObject* pictureClass = nullptr;  // lives as long as the interpreter

// Slices and results of arithmetic are of the class as well, and need not be pictures.
bool isPicture(const py::array& array) {
    return array.ndim() == 3 && array.shape(0) > 0 && array.shape(1) > 0 && array.shape(2) >= 1 &&
           array.shape(2) <= 4 && array.shape(0) <= maxImageSide && array.shape(1) <= maxImageSide &&
           py::isinstance<py::array_t<uint8_t>>(array);
}

std::vector<std::byte> pngOf(const py::array& array) {
    const auto packed = py::array_t<uint8_t, py::array::c_style | py::array::forcecast>::ensure(array);
    Image image{int(packed.shape(1)), int(packed.shape(0)), int(packed.shape(2)), {}};
    image.pixels.assign(packed.data(), packed.data() + packed.size());
    return encodePng(image);
}

void save(const py::array& self, const std::filesystem::path& file) {
    if (!isPicture(self))
        throw Error("only an array of shape (height, width, 1 to 4) of uint8 is written as a picture, found ",
                    std::string(py::str(self.attr("shape"))), " of ", std::string(py::str(self.dtype())));
    const std::vector<std::byte> png = pngOf(self);
    writeFile(file, {reinterpret_cast<const char*>(png.data()), png.size()});
}

py::object shown(const py::array& self) {
    if (!isPicture(self)) return py::none();
    const std::vector<std::byte> png = pngOf(self);
    return py::bytes(reinterpret_cast<const char*>(png.data()), png.size());
}

}  // namespace

py::array pictureOf(const Image& image) {
    py::array_t<uint8_t> out(
        {py::ssize_t(image.height), py::ssize_t(image.width), py::ssize_t(image.channels)});
    std::copy(image.pixels.begin(), image.pixels.end(), out.mutable_data());
    return out.attr("view")(py::handle(pictureClass));
}

void bindPicture(py::module_& m) {
    const auto type = py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyType_Type));
    py::dict members;
    members["__module__"] = "shoal";
    members["__doc__"] =
        "A picture: an array of uint8 of shape (height, width, 4), red, green, blue and alpha.";
    py::object made = type("Picture", py::make_tuple(py::module_::import("numpy").attr("ndarray")), members);
    made.attr("save") = py::cpp_function(save, py::name("save"), py::is_method(made), py::arg("file"),
                                         "Writes it as a PNG file.");
    made.attr("_repr_png_") = py::cpp_function(shown, py::name("_repr_png_"), py::is_method(made),
                                               "What a notebook shows: the bytes of a PNG file.");
    m.attr("Picture") = made;
    pictureClass = made.release().ptr();
}

}  // namespace shoal::python
