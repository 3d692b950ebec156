#include "molecule/check.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "molecule/analysis.h"

namespace shoal {

namespace {

constexpr double mostMassRatio = 1e4;
constexpr double mostPrestrain = 0.1;    // of the drawn distance
constexpr double leastAreaShare = 1e-6;  // of the longest edge squared

const char* plural(size_t count, const char* one, const char* many) {
    return count == 1 ? one : many;
}

// Collects warnings about one molecule.
class Checker {
  public:
    explicit Checker(const Molecule& molecule) : m_(molecule) {}

    std::vector<Warning> run() {
        looseVertices();
        const bool whole = connected();
        prestress();
        triangles();
        pins();
        masses();
        if (whole) shape();
        return std::move(warnings_);
    }

  private:
    using Places = std::vector<Location>;

    // Of an element when it came from a file, else of the file.
    Location place(const Places& places, size_t index) const {
        return index < places.size() ? places[index] : Location{m_.file, 0, 0, {}};
    }
    void warn(Location location, std::string message) {
        warnings_.push_back({std::move(location), std::move(message)});
    }
    void warnMolecule(std::string message) { warn({m_.file, 0, 0, {}}, std::move(message)); }

    void looseVertices() {
        if (m_.vertices.size() < 2) return;
        std::vector<bool> sprung(m_.vertices.size()), drawn(m_.vertices.size());
        for (const Spring& spring : m_.springs)
            sprung[size_t(spring.a)] = sprung[size_t(spring.b)] = true;
        for (const Triangle& t : m_.triangles)
            for (const int corner : {t.a, t.b, t.c})
                drawn[size_t(corner)] = true;
        // Drawn and nothing else: pins() says it once.
        const bool still = m_.springs.empty() && std::all_of(m_.vertices.begin(), m_.vertices.end(),
                                                             [](const Vertex& v) { return v.pinned; });
        for (size_t i = 0; i < m_.vertices.size(); ++i) {
            if (!sprung[i] && m_.vertices[i].pinned && !still)
                warn(place(m_.places.vertices, i),
                     concat("vertex ", i, " is pinned but holds nothing: no spring ends at it"));
            else if (!sprung[i] && !still)
                warn(place(m_.places.vertices, i), concat("vertex ", i, " is loose: no spring ends at it"));
            if (!drawn[i] && !m_.triangles.empty())
                warn(place(m_.places.vertices, i),
                     concat("vertex ", i, " is in no triangle and will not be seen"));
        }
    }

    // Whether springs join all vertices that have any; warns otherwise.
    bool connected() {
        std::vector<size_t> parent(m_.vertices.size());
        std::iota(parent.begin(), parent.end(), size_t{0});
        const auto root = [&parent](size_t i) {
            while (parent[i] != i)
                i = parent[i] = parent[parent[i]];
            return i;
        };
        std::vector<bool> sprung(m_.vertices.size());
        for (const Spring& spring : m_.springs) {
            sprung[size_t(spring.a)] = sprung[size_t(spring.b)] = true;
            parent[root(size_t(spring.a))] = root(size_t(spring.b));
        }
        size_t parts = 0, loose = 0, stray = 0;
        size_t first = m_.vertices.size();
        for (size_t i = 0; i < m_.vertices.size(); ++i) {
            if (!sprung[i]) {
                ++loose;
                continue;
            }
            if (root(i) == i) ++parts;
            if (first == m_.vertices.size())
                first = i;
            else if (stray == 0 && root(i) != root(first))
                stray = i;
        }
        if (parts > 1)
            warn(place(m_.places.vertices, stray),
                 concat("the springs form ", parts,
                        " separate parts that will drift apart: no spring joins vertex ", stray,
                        " to vertex ", first));
        return parts == 1 && loose == 0;
    }

    void prestress() {
        for (size_t i = 0; i < m_.springs.size(); ++i) {
            const Spring& spring = m_.springs[i];
            if (!spring.restLength) continue;
            const double drawn =
                glm::length(m_.vertices[size_t(spring.a)].position - m_.vertices[size_t(spring.b)].position);
            if (std::abs(*spring.restLength - drawn) > mostPrestrain * drawn)
                warn(place(m_.places.springs, i),
                     concat("restLength ", *spring.restLength, " is far from the drawn distance ", drawn,
                            ": the molecule starts under tension and will change its shape"));
        }
    }

    void triangles() {
        // How often each edge is walked, in each direction, and by which triangle first.
        struct Edge {
            std::vector<size_t> forward, backward;
        };
        std::map<std::pair<int, int>, Edge> edges;
        for (size_t i = 0; i < m_.triangles.size(); ++i) {
            const Triangle& t = m_.triangles[i];
            const glm::dvec3 p = m_.vertices[size_t(t.a)].position, q = m_.vertices[size_t(t.b)].position,
                             r = m_.vertices[size_t(t.c)].position;
            const double longest = std::max({glm::length(q - p), glm::length(r - q), glm::length(p - r)});
            if (glm::length(glm::cross(q - p, r - p)) <= leastAreaShare * longest * longest)
                warn(place(m_.places.triangles, i), concat("triangle ", i, " has no area: vertices ", t.a,
                                                           ", ", t.b, " and ", t.c, " stand in line"));
            for (const auto& [a, b] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
                Edge& edge = edges[std::minmax(a, b)];
                (a < b ? edge.forward : edge.backward).push_back(i);
            }
        }
        // With three and more triangles at an edge, as in a cross, no facing is wrong.
        for (const auto& [ends, edge] : edges) {
            const std::vector<size_t>& same = edge.forward.empty() ? edge.backward : edge.forward;
            if (edge.forward.size() + edge.backward.size() != 2 || same.size() != 2) continue;
            warn(place(m_.places.triangles, same[1]),
                 concat("triangle ", same[1], " faces the other way than its neighbour ", same[0],
                        " across the edge ", ends.first, "-", ends.second, ": swap two of its vertices"));
        }
    }

    void pins() {
        std::vector<size_t> pinned;
        for (size_t i = 0; i < m_.vertices.size(); ++i)
            if (m_.vertices[i].pinned) pinned.push_back(i);
        if (pinned.empty()) return;
        if (pinned.size() == m_.vertices.size())
            warn(place(m_.places.vertices, 0), m_.vertices.size() == 1
                                                   ? "the only vertex is pinned: nothing can move"
                                                   : "every vertex is pinned: nothing can move");
        else if (pinned.size() == 1)
            warn(place(m_.places.vertices, pinned[0]),
                 concat("vertex ", pinned[0],
                        " is the only one pinned: the molecule can spin about it in every "
                        "direction (pin a second vertex for a hinge, or a third to hold it)"));
    }

    void masses() {
        const auto lighter = [](const Vertex& a, const Vertex& b) { return a.mass < b.mass; };
        const auto [least, most] = std::minmax_element(m_.vertices.begin(), m_.vertices.end(), lighter);
        if (most->mass <= mostMassRatio * least->mass) return;
        const auto index = size_t(most - m_.vertices.begin());
        warn(place(m_.places.vertices, index),
             concat("vertex ", index, " is ", most->mass / least->mass, " times as heavy as vertex ",
                    least - m_.vertices.begin(), ": above ", mostMassRatio, " solvers lose accuracy"));
    }

    // The springs join all vertices: do they hold the shape too?
    void shape() {
        const Analysis free = analyse(m_, false);
        if (!free.modesKnown || free.zeroModes == 0) return;
        const size_t count = size_t(free.zeroModes);
        warnMolecule(
            concat("the springs leave ", count, plural(count, " motion", " motions"),
                   " without any stiffness beyond moving as a whole: brace it with springs across, or fold "
                   "what is flat (by about 0.12 of its size)"));
    }

    const Molecule& m_;
    std::vector<Warning> warnings_;
};

}  // namespace

std::vector<Warning> check(const Molecule& molecule) {
    return Checker(molecule).run();
}

}  // namespace shoal
