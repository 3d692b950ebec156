#include "measure/ensemble.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compile/surface_pair.h"
#include "measure/accuracy_reference.h"
#include "measure/quantities.h"
#include "scene/collider_kinds.h"

namespace shoal::measure {

namespace {

constexpr double visible = 0.01;  // of a molecule's size
constexpr size_t leastPile = 10;  // molecules that have a slope

// J/kg, kinetic, of springs and of gravity, which is 0 at the origin. Of molecules whose muscles bend as they
// steer, and of those that are born, springs are left out: their rest lengths are not known here.
std::vector<double> energies(const Scene& scene, const GroupPlan& plan, const Snapshot& end,
                             const std::vector<int>& molecules) {
    const bool bare = plan.needs.life || scene.groups[plan.index].school;
    std::vector<double> out;
    for (const int m : molecules) {
        const size_t taken = bare ? 0 : size_t(m);
        const reference::Problem problem =
            springsOf(scene, scene.groups[plan.index], double(plan.constants.scales[taken]),
                      double(plan.constants.phases[taken]));
        const reference::State state = ExactEnds::stateOf(end, m);
        const double springs = bare ? reference::springEnergy(problem, state) : 0;
        out.push_back((reference::energy(problem, state) - springs) / problem.molecule->mass());
    }
    return out;
}

// A ball of packing reaches over neighbours: twice the diameter of a molecule with its spheres.
std::vector<double> packingsOf(const Group& group, const GroupPlan& plan, const Snapshot& end,
                               const Centers& centers, double size) {
    std::vector<glm::dvec3> spheres;
    std::vector<double> radii;
    for (const int m : centers.molecules) {
        for (int v = 0; v < end.vertexCount; ++v) {
            spheres.push_back(end.positions[size_t(m) * size_t(end.vertexCount) + size_t(v)]);
            radii.push_back(group.contact->radius * plan.constants.scales[size_t(m)]);
        }
    }
    return packings(centers, spheres, radii, 2 * size + 4 * radii.front());
}

// A pile lies on level ground, between no walls.
bool piles(const Scene& scene, const Group& group, const glm::dvec3& up) {
    const std::vector<Collider> colliders = collidersOf(scene, group);
    return group.contact && scene.gravity != glm::dvec3(0) && !colliders.empty() &&
           std::all_of(colliders.begin(), colliders.end(), [&](const Collider& collider) {
               const auto* plane = std::get_if<PlaneCollider>(&*collider.shape);
               return plane && glm::dot(glm::normalize(plane->normal), up) > 0.999;
           });
}

bool isPoint(const Group& group) {
    return group.molecule.vertices.size() == 1;
}

// m, the mean; of a point the diameter of its contact sphere, or 1.
double sizeOf(const Group& group, const GroupPlan& plan) {
    double scale = 0;
    for (const float own : plan.constants.scales)
        scale += double(own) / double(plan.constants.scales.size());
    if (!isPoint(group)) return scale * group.molecule.size();
    return group.contact ? 2 * scale * group.contact->radius : 1;
}

}  // namespace

std::vector<Quantity> quantitiesOf(const Scene& scene, const GroupPlan& plan, const Snapshot& end) {
    using Summary = Quantity::Summary;
    const Group& group = scene.groups[plan.index];
    std::vector<double> masses;
    for (const Vertex& vertex : group.molecule.vertices)
        masses.push_back(vertex.mass);
    const Centers centers = centersOf(end, masses);
    if (centers.size() == 0) return {};
    const double pull = glm::length(scene.gravity), size = sizeOf(group, plan);
    const glm::dvec3 up = pull > 0 ? -scene.gravity / pull : glm::dvec3(0, 1, 0);
    const double length = visible * size, slow = length / std::max(end.time, 1e-9);
    std::vector<Quantity> out = {
        {"height", "m", heights(centers, up), length},
        {"speed", "m/s", speeds(centers), slow},
        {"energy", "J/kg", energies(scene, plan, end, centers.molecules), slow * slow / 2 + pull * length}};
    if (centers.size() < 2) return out;
    out.push_back({"spread", "m", spreads(centers), length});
    out.push_back({"nearest neighbour", "m", nearestDistances(centers), length});
    if (group.contact) {
        const double extent = isPoint(group) ? 0 : size;
        out.push_back({"packing", "", packingsOf(group, plan, end, centers, extent), visible});
    }
    out.push_back({"polarisation", "", alignments(centers, slow), visible, Summary::mean});
    if (centers.size() >= leastPile && piles(scene, group, up))
        out.push_back({"angle of repose",
                       "degrees",
                       {reposeAngle(centers, up) * 180 / std::numbers::pi},
                       0,
                       Summary::value});
    if (plan.needs.life) out.push_back({"living", "molecules", {double(centers.size())}, 0, Summary::value});
    return out;
}

void Ensemble::add(const std::string& group, const Quantity& quantity, const char* statistic, double value) {
    const auto same = std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) {
        return row.group == group && row.quantity == quantity.name && row.statistic == statistic;
    });
    const bool isNew = same == rows_.end();
    Row& row = isNew ? rows_.emplace_back() : *same;
    if (isNew) {
        row.group = group;
        row.quantity = quantity.name;
        row.unit = quantity.unit;
        row.statistic = statistic;
        row.least = quantity.least;
    }
    row.values.push_back(value);
    if (quantity.summary == Quantity::Summary::value) return;
    for (const double each : quantity.values) {
        ++row.count;
        const double away = each - row.mean;
        row.mean += away / row.count;
        row.squares += away * (each - row.mean);
    }
}

void Ensemble::add(const std::string& group, const std::vector<Quantity>& quantities) {
    for (const Quantity& quantity : quantities) {
        using Summary = Quantity::Summary;
        const char* mean = quantity.summary == Summary::value ? "value" : "mean";
        add(group, quantity, mean, estimateOf(quantity.values).mean);
        if (quantity.summary != Summary::meanAndQuantiles) continue;
        for (const auto& [words, share] : {std::pair{"5 %", 0.05}, {"50 %", 0.5}, {"95 %", 0.95}})
            add(group, quantity, words, quantileOf(quantity.values, share));
    }
}

std::vector<Statistic> Ensemble::statistics(int runs) const {
    std::vector<Statistic> out;
    for (const Row& row : rows_) {
        if (int(row.values.size()) != runs) continue;
        out.push_back(row);
        if (row.count > 1) out.back().scale = std::max(row.least, std::sqrt(row.squares / (row.count - 1)));
    }
    return out;
}

const char* name(Verdict verdict) {
    static constexpr const char* names[] = {"no", "perhaps", "yes"};
    return names[size_t(verdict)];
}

std::optional<double> Difference::relative() const {
    if (!scale) return std::nullopt;
    return std::abs(difference.mean) / *scale;
}

std::vector<Difference> compare(const Ensemble& reference, const Ensemble& method, int runs) {
    std::vector<Difference> out;
    std::vector<std::vector<double>> apart;
    const std::vector<Statistic> others = method.statistics(runs);
    for (const Statistic& statistic : reference.statistics(runs)) {
        const auto other = std::find_if(others.begin(), others.end(), [&](const Statistic& candidate) {
            return candidate.group == statistic.group && candidate.quantity == statistic.quantity &&
                   candidate.statistic == statistic.statistic;
        });
        if (other == others.end()) continue;
        Difference& difference = out.emplace_back();
        difference.group = statistic.group;
        difference.quantity = statistic.quantity;
        difference.unit = statistic.unit;
        difference.statistic = statistic.statistic;
        std::vector<double>& pairs = apart.emplace_back();
        for (int i = 0; i < runs; ++i)
            pairs.push_back(other->values[size_t(i)] - statistic.values[size_t(i)]);
        difference.reference = estimateOf(statistic.values);
        difference.value = estimateOf(other->values);
        difference.difference = estimateOf(pairs);
        if (statistic.scale > 0) difference.scale = statistic.scale;
    }
    const double all = 1 - (1 - usualConfidence) / std::max(1.0, double(out.size()));
    for (size_t i = 0; i < out.size(); ++i)
        out[i].verdict = !out[i].difference.excludesZero()           ? Verdict::none
                         : !estimateOf(apart[i], all).excludesZero() ? Verdict::perhaps
                                                                     : Verdict::differs;
    return out;
}

std::optional<size_t> worstOf(const std::vector<Difference>& differences) {
    std::optional<size_t> out;
    for (size_t i = 0; i < differences.size(); ++i)
        if (differences[i].scale && (!out || differences[i].relative() > differences[*out].relative()))
            out = i;
    return out;
}

double withinOf(const std::vector<Difference>& differences) {
    double out = 0;
    for (const Difference& difference : differences)
        if (difference.scale)
            out = std::max(out, *difference.relative() + difference.difference.half / *difference.scale);
    return out;
}

}  // namespace shoal::measure
