#include "python/scene.h"

#include "core/cache_folder.h"
#include "core/file.h"
#include "molecule/molecule_file.h"
#include "python/simulation.h"
#include "run/scene_list.h"
#include "scene/json/scene_file.h"

namespace shoal::python {

namespace {

std::filesystem::path pathOf(const py::object& source, const char* expected) {
    if (!py::isinstance<py::str>(source) && !py::hasattr(source, "__fspath__"))
        throw Error(expected, ", found ", std::string(py::repr(source)));
    try {
        return py::cast<std::filesystem::path>(source);
    } catch (const py::cast_error&) {  // such as a name with a zero in it
        throw Error(expected, ", found ", std::string(py::repr(source)));
    }
}

// JSON's text of a dict or list, in which NumPy's arrays and numbers may stand for lists and numbers.
std::string jsonOf(const py::object& value) {
    const py::cpp_function plain = [](const py::object& other) -> py::object {
        if (!py::hasattr(other, "tolist"))
            throw Error("expected a dict, list, text, number or truth value, found ",
                        std::string(py::repr(other)));
        return other.attr("tolist")();
    };
    return py::str(py::module_::import("json").attr("dumps")(value, py::arg("default") = plain));
}

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

FieldBaking bakingThatEnds(SignalWatch& watch) {
    return {cacheFolder(), [&watch](double) { watch.look(); }};
}

}  // namespace

PyMolecule moleculeFrom(const py::object& source) {
    if (py::isinstance<py::dict>(source)) {
        py::dict whole = source.attr("copy")();
        if (!whole.contains("format")) whole["format"] = "shoal-molecule-1";
        return {parseMolecule(jsonOf(whole), "<molecule>")};
    }
    return {readMolecule(pathOf(source, "a molecule is a file or a dict").string())};
}

py::array_t<double> restPositions(const PyMolecule& self) {
    py::array_t<double> out({py::ssize_t(self.molecule.vertices.size()), py::ssize_t(3)});
    auto values = out.mutable_unchecked<2>();
    for (size_t i = 0; i < self.molecule.vertices.size(); ++i)
        for (int k = 0; k < 3; ++k)
            values(py::ssize_t(i), k) = self.molecule.vertices[i].position[k];
    return out;
}

PyScene sceneFrom(const py::object& source, const std::filesystem::path& folder) {
    if (!py::isinstance<py::dict>(source)) {
        const std::string word = pathOf(source, "a scene is a file, a name or a dict").string();
        SignalWatch watch;
        const py::gil_scoped_release release;
        return {readScene(needScene(word), {bakingThatEnds(watch)})};
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
    SignalWatch watch;
    const py::gil_scoped_release release;
    return {parseScene(text, file, {bakingThatEnds(watch)})};
}

}  // namespace shoal::python
