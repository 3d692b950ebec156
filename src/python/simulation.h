// Simulations with state as NumPy arrays.
//
// All simulations on one device share a context of OpenGL, which lives as long as the process and belongs to
// the thread that made it until that ends, then to the next that uses it. A forked process cannot use it.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <thread>

#include <sys/types.h>
#include <unistd.h>

#include "measure/diagnostics.h"
#include "python/scene.h"
#include "render/renderer.h"
#include "simulate/simulation.h"

namespace shoal::python {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Vector3 = std::array<double, 3>;

struct Device {
    gpu::Context context;
    std::thread::id thread = {};       // that it belongs to; none: that has ended
    const pid_t process = ::getpid();  // that made it

    explicit Device(const gpu::ContextOptions& options) : context(options) {}
};
// By its number among those of EGL; nothing: the best. Made at the first call.
Device& deviceOf(std::optional<int> number);
// Makes its context current. Error: it belongs to another thread, or to the process that this was forked
// from.
void enter(Device& device);

// Error: a number is not finite; tells `what` it is.
double finite(const char* what, double value);
glm::dvec3 finite(const char* what, const Vector3& value);

// Lets Python answer signals, above all an interrupt, while a call runs without its lock: what a handler
// raises ends the call.
class SignalWatch {
  public:
    void look();  // asks ten times a second at the most

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

class PySimulation {
  public:
    PySimulation(const PyScene& scene, const std::optional<std::string>& solver, std::optional<int> substeps,
                 std::optional<int> device, const std::string& path, bool diagnostics);

    PySimulation(const PySimulation&) = delete;
    PySimulation& operator=(const PySimulation&) = delete;
    ~PySimulation();

    void step(int frames);
    void restart();
    void close();

    double time() { return use().time(); }
    int frames() { return use().frames(); }
    std::string hash();
    std::string solver(const py::object& group) { return name(use().plan().groups[groupOf(group)].solver); }
    std::vector<std::string> groups();

    py::array positions(const py::object& group);
    py::array velocities(const py::object& group);
    py::array normals(const py::object& group);
    py::array alive(const py::object& group);
    void setState(const py::object& group, const std::optional<Array>& positions,
                  const std::optional<Array>& velocities);
    py::dict energy(const py::object& group);
    // A measure::Reading, of now. Error: it was made without.
    py::dict diagnostics();

    py::array picture(int width, int height, const std::optional<Vector3>& eye,
                      const std::optional<Vector3>& target, std::optional<double> fieldOfView);

    // For notebooks: the bytes of a PNG file; None once it was closed.
    py::object shown();

    void save(const std::filesystem::path& file);
    void load(const std::filesystem::path& file);

    // Its device's context is current then. Error: it was closed.
    Simulation& use();
    // Takes them with as many substeps as they need, at least those that were asked for: `substeps`, or the
    // last ones. RuntimeWarning: these are more. Error: they are more than a frame has. `name`: of what
    // changed.
    void setParameters(const char* name, Parameters changed, std::optional<int> substeps = {});
    const Scene& scene() const { return scene_; }

  private:
    // By name, number, or None where there is one.
    size_t groupOf(const py::object& group);
    template <typename Vector>
    py::array vectors(const py::object& group, std::vector<Vector> Snapshot::*values);

    Scene scene_;
    Device* device_ = nullptr;
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Renderer> renderer_;
    std::unique_ptr<measure::Diagnostics> diagnostics_;  // null: none are wanted
    int substeps_ = 1;                                   // of a frame, as asked for
};

}  // namespace shoal::python

template <>
class pybind11::detail::type_caster<shoal::python::PySimulation>
    : public shoal::python::MadeCaster<shoal::python::PySimulation> {};
