#include "compile/block_pattern.h"

#include <algorithm>
#include <set>

namespace shoal {

namespace {

// The springs' graph of what is not eliminated yet.
class Graph {
  public:
    Graph(const Molecule& molecule, bool held) : neighbours_(molecule.vertices.size()) {
        const auto pinned = [&](int v) { return held && molecule.vertices[size_t(v)].pinned; };
        for (const Spring& spring : molecule.springs) {
            if (pinned(spring.a) || pinned(spring.b)) continue;
            neighbours_[size_t(spring.a)].insert(spring.b);
            neighbours_[size_t(spring.b)].insert(spring.a);
        }
        for (int v = 0; v < int(neighbours_.size()); ++v)
            if (!pinned(v)) open_.insert(v);
    }

    size_t degree(int v) const { return neighbours_[size_t(v)].size(); }

    // Takes the next round out, and calls visit(vertex, its neighbours) for each.
    template <typename Visit>
    void takeRound(Elimination elimination, const Visit& visit) {
        const bool several = elimination == Elimination::fewestRounds;
        const auto fewer = [&](int a, int b) { return degree(a) < degree(b); };
        std::vector<int> round(open_.begin(), open_.end());
        if (several)
            std::stable_sort(round.begin(), round.end(), fewer);
        else
            std::iter_swap(round.begin(), std::min_element(round.begin(), round.end(), fewer));
        const size_t most = several ? degree(round.front()) * 5 / 4 + 1 : degree(round.front());
        std::set<int> joined;  // to one of this round
        for (const int v : round) {
            if (degree(v) > most) break;
            if (joined.contains(v)) continue;
            const std::set<int> rest = eliminate(v);
            joined.insert(rest.begin(), rest.end());
            visit(v, rest);
            if (!several) break;
        }
    }

    bool isEmpty() const { return open_.empty(); }

  private:
    // Its neighbours, which it joins to one another.
    std::set<int> eliminate(int v) {
        open_.erase(v);
        const std::set<int> rest = neighbours_[size_t(v)];
        for (const int a : rest) {
            neighbours_[size_t(a)].erase(v);
            for (const int b : rest)
                if (a != b) neighbours_[size_t(a)].insert(b);
        }
        return rest;
    }

    std::vector<std::set<int>> neighbours_;
    std::set<int> open_;
};

}  // namespace

BlockPattern blockPattern(const Molecule& molecule, bool held, Elimination elimination) {
    Graph graph(molecule, held);
    BlockPattern out;
    std::vector<std::set<int>> joined(molecule.vertices.size());  // later vertices, for each
    std::vector<int> round(joined.size(), 0);  // before which all that it waits for are done
    while (!graph.isEmpty()) {
        graph.takeRound(elimination, [&](int vertex, const std::set<int>& rest) {
            out.order.push_back(vertex);
            for (const int later : rest)
                round[size_t(later)] = std::max(round[size_t(later)], round[size_t(vertex)] + 1);
            joined[size_t(vertex)] = rest;
        });
    }
    if (elimination == Elimination::fewestRounds)
        std::stable_sort(out.order.begin(), out.order.end(),
                         [&](int a, int b) { return round[size_t(a)] < round[size_t(b)]; });
    std::vector<int> place(molecule.vertices.size(), -1);
    for (size_t p = 0; p < out.order.size(); ++p) {
        place[size_t(out.order[p])] = int(p);
        if (p == 0 || round[size_t(out.order[p])] != round[size_t(out.order[p - 1])])
            out.rounds.push_back(int(p));
    }
    for (const int vertex : out.order) {
        const std::set<int>& vertices = joined[size_t(vertex)];
        out.diagonal.push_back(out.blocks++);
        std::vector<int> below, numbers;
        for (const int v : vertices)
            below.push_back(place[size_t(v)]);
        std::sort(below.begin(), below.end());
        for (size_t i = 0; i < below.size(); ++i)
            numbers.push_back(out.blocks++);
        out.below.push_back(std::move(below));
        out.block.push_back(std::move(numbers));
    }
    return out;
}

}  // namespace shoal
