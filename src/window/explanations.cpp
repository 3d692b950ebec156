#include "window/explanations.h"

#include <algorithm>
#include <cmath>

#include "reference/fields.h"
#include "scene/force_kinds.h"

namespace shoal::window {

namespace {

constexpr int arrowsHalf = 10;  // of a row, to either side of the middle

bool holds(const std::optional<Box>& box, const glm::dvec3& place) {
    return !box || (glm::all(glm::greaterThanEqual(place, box->low)) &&
                    glm::all(glm::lessThanEqual(place, box->high)));
}

// Slow is blue, fast is orange: both show on bright ground and on dark.
glm::vec3 colorOf(double share) {
    const glm::vec3 slow(0.02, 0.06, 0.5), middle(0.45, 0.06, 0.5), fast(2.4, 0.45, 0.02);
    return share < 0.5 ? glm::mix(slow, middle, 2 * float(share))
                       : glm::mix(middle, fast, 2 * float(share) - 1);
}

void addArrow(std::vector<Line>& lines, const glm::dvec3& from, const glm::dvec3& along,
              const glm::dvec3& eye, const glm::vec3& color) {
    const glm::dvec3 tip = from + along;
    glm::dvec3 side = glm::cross(along, from - eye);
    const double length = glm::length(side);
    if (!(length > 0)) return;
    side *= 0.18 * glm::length(along) / length;
    lines.push_back({from, tip, color});
    lines.push_back({tip, tip - 0.3 * along + side, color});
    lines.push_back({tip, tip - 0.3 * along - side, color});
}

}  // namespace

// m/s, with the sliders' factors: fields, and winds among the forces.
static glm::dvec3 fluidVelocity(const Scene& scene, const Parameters& parameters, const glm::dvec3& place,
                                double time) {
    glm::dvec3 out(0);
    for (size_t i = 0; i < scene.fields.size(); ++i) {
        const Field& field = scene.fields[i];
        const double factor = i < parameters.fields.size() ? parameters.fields[i] : 1;
        if (holds(field.box, place))
            out +=
                parameters.wind * factor * field.weight * reference::fieldVelocity(*field.shape, place, time);
    }
    for (size_t i = 0; i < scene.forces.size(); ++i) {
        const auto* wind = std::get_if<WindForce>(&*scene.forces[i].shape);
        if (!wind || i >= parameters.forces.size() || !parameters.forces[i].on) continue;
        out += parameters.forces[i].factor * momentOf(scene.forces[i].path, time).factor * wind->velocity;
    }
    return out;
}

Explanations::Explanations(gpu::Context& context, const Scene& scene, const Plan& plan)
    : springs_(context, scene, plan), lines_(context) {}

// A square of arrows about what the camera looks at, on a lattice that stands still while the camera moves.
void Explanations::prepare(const Scene& scene, const Simulation& simulation, const View& view) {
    arrows_.clear();
    if (!settings.field) return;
    const double spacing = std::exp2(std::round(std::log2(0.07 * glm::distance(view.eye, view.target))));
    const int across = settings.across, u = (across + 1) % 3, v = (across + 2) % 3;
    glm::dvec3 middle = glm::round(view.target / spacing) * spacing;
    middle[across] = view.target[across] + settings.sliceShift;
    struct Sample {
        glm::dvec3 place, velocity;
    };
    std::vector<Sample> samples;
    double fastest = 0;
    for (int i = -arrowsHalf; i <= arrowsHalf; ++i) {
        for (int j = -arrowsHalf; j <= arrowsHalf; ++j) {
            glm::dvec3 place = middle;
            place[u] += i * spacing;
            place[v] += j * spacing;
            const glm::dvec3 velocity = fluidVelocity(scene, simulation.parameters, place, simulation.time());
            fastest = std::max(fastest, glm::length(velocity));
            samples.push_back({place, velocity});
        }
    }
    // the scale follows slowly, so that arrows do not pulse
    fastest_ = fastest_ > 0 ? fastest_ + 0.1 * (fastest - fastest_) : fastest;
    if (!(fastest_ > 0)) return;
    for (const Sample& sample : samples) {
        const double share = std::min(1.0, glm::length(sample.velocity) / fastest_);
        addArrow(arrows_, sample.place, sample.velocity * (0.9 * spacing / fastest_), view.eye,
                 colorOf(share));
    }
}

void Explanations::draw(const StateView& state, const DrawInputs& inputs) {
    if (settings.springs) springs_.draw(state, inputs, settings.strainShown, 0.8 * settings.lineWidth);
    if (picked && !settings.springs)
        springs_.drawOne(state, inputs, settings.strainShown, 1.5 * settings.lineWidth, picked->group,
                         picked->molecule);
    lines_.draw(arrows_, settings.lineWidth, inputs);
}

}  // namespace shoal::window
