#include "molecule/check.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/error.h"
#include "molecule/analysis.h"

namespace shoal {

namespace {

constexpr double mostMassRatio = 1e4;
constexpr double mostPrestrain = 0.1;    // of the drawn distance
constexpr double leastAreaShare = 1e-6;  // of the longest edge squared

using Mend = std::function<void(Draft&)>;

// Springs from a vertex to those nearest to it that it has none to yet.
Mend tie(int vertex, std::set<int> among) {
    return [vertex, among = std::move(among)](Draft& draft) {
        const std::vector<Vertex>& vertices = draft.molecule.vertices;
        std::vector<int> others(among.begin(), among.end());
        std::erase(others, vertex);
        const auto nearer = [&](int a, int b) {
            const glm::dvec3& from = vertices[size_t(vertex)].position;
            return glm::distance(from, vertices[size_t(a)].position) <
                   glm::distance(from, vertices[size_t(b)].position);
        };
        std::sort(others.begin(), others.end(), nearer);
        int ties = 0;
        for (const int other : others)
            if (ties < 3 && springBetween(draft.molecule, vertex, other) < 0) {
                addSpring(draft, vertex, other);
                ++ties;
            }
    };
}

// Looks at one molecule.
class Checker {
  public:
    explicit Checker(const Molecule& molecule) : m_(molecule) {}

    std::vector<Finding> run() {
        looseVertices();
        const bool whole = connected();
        prestress();
        triangles();
        pins();
        masses();
        if (whole) shape();
        return std::move(findings_);
    }

  private:
    using Places = std::vector<Location>;

    // Returns the location of an element that came from a file, else that of the file.
    Location place(const Places& places, size_t index) const {
        return index < places.size() ? places[index] : Location{m_.file};
    }
    Finding& find(Finding::Kind kind, Location location, std::string message) {
        Finding& out = findings_.emplace_back();
        out.kind = kind;
        out.warning = {std::move(location), std::move(message)};
        return out;
    }
    Finding& findVertex(Finding::Kind kind, size_t vertex, std::string message) {
        Finding& out = find(kind, place(m_.places.vertices, vertex), std::move(message));
        out.vertices = {int(vertex)};
        return out;
    }
    std::set<int> allVertices() const {
        std::set<int> out;
        for (size_t i = 0; i < m_.vertices.size(); ++i)
            out.insert(int(i));
        return out;
    }

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
            const char* what = m_.vertices[i].pinned ? "pinned but holds nothing" : "loose";
            if (!sprung[i] && !still)
                findVertex(Kind::loose, i, concat("vertex ", i, " is ", what, ": no spring ends at it"))
                    .mendBy("Tie it to its neighbours", tie(int(i), allVertices()));
            // a skin is drawn instead of the triangles
            if (!drawn[i] && !m_.triangles.empty() && m_.skin.empty())
                findVertex(Kind::unseen, i, concat("vertex ", i, " is in no triangle and will not be seen"));
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
        if (parts > 1) {
            std::set<int> others;
            for (size_t i = 0; i < m_.vertices.size(); ++i)
                if (sprung[i] && root(i) != root(stray)) others.insert(int(i));
            findVertex(Kind::apart, stray,
                       concat("the springs form ", parts,
                              " separate parts that will drift apart: no spring joins vertex ", stray,
                              " to vertex ", first))
                .mendBy("Join them here", tie(int(stray), others));
        }
        return parts == 1 && loose == 0;
    }

    void prestress() {
        for (size_t i = 0; i < m_.springs.size(); ++i) {
            const Spring& spring = m_.springs[i];
            if (!spring.restLength) continue;
            const double drawn =
                glm::length(m_.vertices[size_t(spring.a)].position - m_.vertices[size_t(spring.b)].position);
            if (std::abs(*spring.restLength - drawn) > mostPrestrain * drawn)
                findTension(
                    i, concat("restLength ", *spring.restLength, " is far from the drawn distance ", drawn,
                              ": the molecule starts under tension and will change its shape"));
        }
    }

    void findTension(size_t spring, std::string message) {
        Finding& out = find(Kind::tension, place(m_.places.springs, spring), std::move(message));
        out.springs = {int(spring)};
        out.mendBy("Rest as drawn",
                   [spring](Draft& draft) { draft.molecule.springs[spring].restLength.reset(); });
    }

    Finding& findTriangle(Finding::Kind kind, size_t triangle, std::string message) {
        Finding& out = find(kind, place(m_.places.triangles, triangle), std::move(message));
        out.triangles = {int(triangle)};
        return out;
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
                findTriangle(Kind::flat, i,
                             concat("triangle ", i, " has no area: vertices ", t.a, ", ", t.b, " and ", t.c,
                                    " stand in line"))
                    .mendBy("Remove it", [i](Draft& draft) { removeTriangles(draft, {int(i)}); });
            for (const auto& [a, b] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
                Edge& edge = edges[std::minmax(a, b)];
                (a < b ? edge.forward : edge.backward).push_back(i);
            }
        }
        std::vector<Disagreement> disagreements;
        std::vector<int> times(m_.triangles.size());
        for (const auto& [ends, edge] : edges) {
            const std::vector<size_t>& same = edge.forward.empty() ? edge.backward : edge.forward;
            if (edge.forward.size() + edge.backward.size() != 2 || same.size() != 2) continue;
            disagreements.push_back({same[0], same[1], ends});
            ++times[same[0]];
            ++times[same[1]];
        }
        findFlipped(disagreements, times);
    }

    // Two triangles that face different ways, and the edge between them.
    struct Disagreement {
        size_t a, b;
        std::pair<int, int> ends;
    };

    // Of two triangles that disagree, the one that disagrees with more neighbours is wrong. With three and
    // more triangles at an edge, as in a cross, none is.
    void findFlipped(const std::vector<Disagreement>& disagreements, const std::vector<int>& times) {
        std::set<size_t> told;
        for (const Disagreement& disagreement : disagreements) {
            const bool first = times[disagreement.a] > times[disagreement.b];
            const size_t turned = first ? disagreement.a : disagreement.b;
            if (!told.insert(turned).second) continue;
            findTriangle(
                Kind::flipped, turned,
                concat("triangle ", turned, " faces the other way than its neighbour ",
                       first ? disagreement.b : disagreement.a, " across the edge ", disagreement.ends.first,
                       "-", disagreement.ends.second, ": swap two of its vertices"))
                .mendBy("Turn it round", [turned](Draft& draft) {
                    Triangle& t = draft.molecule.triangles[turned];
                    std::swap(t.b, t.c);
                });
        }
    }

    void pins() {
        std::vector<size_t> pinned;
        for (size_t i = 0; i < m_.vertices.size(); ++i)
            if (m_.vertices[i].pinned) pinned.push_back(i);
        if (pinned.empty()) return;
        if (pinned.size() == m_.vertices.size())
            findVertex(Kind::pins, 0,
                       m_.vertices.size() == 1 ? "the only vertex is pinned: nothing can move"
                                               : "every vertex is pinned: nothing can move");
        else if (pinned.size() == 1)
            findVertex(Kind::pins, pinned[0],
                       concat("vertex ", pinned[0],
                              " is the only one pinned: the molecule can spin about it in every "
                              "direction (pin a second vertex for a hinge, or a third to hold it)"));
    }

    void masses() {
        const auto lighter = [](const Vertex& a, const Vertex& b) { return a.mass < b.mass; };
        const auto [least, most] = std::minmax_element(m_.vertices.begin(), m_.vertices.end(), lighter);
        if (most->mass <= mostMassRatio * least->mass) return;
        const auto index = size_t(most - m_.vertices.begin());
        findVertex(Kind::masses, index,
                   concat("vertex ", index, " is ", most->mass / least->mass, " times as heavy as vertex ",
                          least - m_.vertices.begin(), ": above ", mostMassRatio, " solvers lose accuracy"));
    }

    // The springs join all vertices: do they hold the shape too?
    void shape() {
        const Analysis free = analyse(m_, false);
        if (!free.modesKnown || free.zeroModes == 0) return;
        const size_t count = size_t(free.zeroModes);
        find(Kind::soft, {m_.file},
             concat("the springs leave ", many(int64_t(count), "motion", "motions"),
                    " without any stiffness beyond moving as a whole: brace it with springs across, give "
                    "its edges bends, or fold what is flat (by about 0.12 of its size)"));
    }

    using Kind = Finding::Kind;

    const Molecule& m_;
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> findingsOf(const Molecule& molecule) {
    return Checker(molecule).run();
}

std::vector<Warning> check(const Molecule& molecule) {
    std::vector<Warning> out;
    for (Finding& finding : findingsOf(molecule))
        out.push_back(std::move(finding.warning));
    return out;
}

}  // namespace shoal
