#include "compile/newton.h"

#include <algorithm>
#include <map>

#include "compile/glsl_text.h"
#include "compile/lanes.h"
#include "compile/plan.h"

namespace shoal {

namespace {

class Table {
  public:
    Table(const Molecule& molecule, const BlockPattern& pattern, std::vector<glm::vec4>& out)
        : molecule_(molecule),
          pattern_(pattern),
          out_(out),
          base_(out.size()),
          place_(molecule.vertices.size(), -1) {
        for (size_t p = 0; p < pattern.order.size(); ++p)
            place_[size_t(pattern.order[p])] = int(p);
        for (size_t p = 0; p < pattern.order.size(); ++p) {
            number_[{int(p), int(p)}] = pattern.diagonal[p];
            for (size_t n = 0; n < pattern.below[p].size(); ++n)
                number_[{pattern.below[p][n], int(p)}] = pattern.block[p][n];
        }
    }

    void add() {
        const size_t vertices = molecule_.vertices.size(), places = pattern_.order.size();
        out_.resize(base_ + 1 + vertices);
        addRounds();
        const int firstPlace = next();
        for (size_t p = 0; p < places; ++p)
            out_.emplace_back(pattern_.diagonal[p], endOf(p), pattern_.order[p], 0);
        const int firstBlock = next();
        out_[base_] = glm::vec4(pattern_.rounds.size(), firstPlace, firstBlock, newtonSteps);
        out_.resize(out_.size() + size_t(pattern_.blocks));
        addTerms(base_ + size_t(firstBlock));
        for (size_t v = 0; v < vertices; ++v) {
            const int place = place_[v];
            out_[base_ + 1 + v] = glm::vec4(place < 0 ? -1 : pattern_.diagonal[size_t(place)], next(), 0, 0);
            for (const Spring& spring : molecule_.springs)
                if (spring.a == int(v) || spring.b == int(v))
                    out_.emplace_back(blockOf(place, spring.a == int(v) ? spring.b : spring.a), 0, 0, 0);
        }
    }

  private:
    int next() const { return int(out_.size() - base_); }
    int endOf(size_t place) const { return pattern_.diagonal[place] + int(pattern_.below[place].size()) + 1; }

    void addRounds() {
        const std::vector<int>& rounds = pattern_.rounds;
        for (size_t r = 0; r < rounds.size(); ++r) {
            const size_t first = size_t(rounds[r]),
                         end = r + 1 < rounds.size() ? size_t(rounds[r + 1]) : pattern_.order.size();
            out_.emplace_back(first, end, pattern_.diagonal[first], endOf(end - 1));
        }
    }

    void addTerms(size_t blocks) {
        std::vector<std::vector<int>> before(pattern_.order.size());  // places that each is below
        for (size_t p = 0; p < before.size(); ++p)
            for (const int i : pattern_.below[p])
                before[size_t(i)].push_back(int(p));
        for (const auto& [where, number] : number_) {
            const auto [row, column] = where;
            const int first = next();
            for (const int p : before[size_t(column)])
                if (const auto other = number_.find({row, p}); other != number_.end())
                    out_.emplace_back(other->second, number_.at({column, p}), pattern_.order[size_t(p)], 0);
            out_[blocks + size_t(number)] =
                glm::vec4(pattern_.order[size_t(row)], pattern_.diagonal[size_t(column)], first, next());
        }
    }

    // The later end of a spring adds it.
    int blockOf(int place, int other) const {
        const int earlier = place_[size_t(other)];
        return earlier < 0 || place < earlier ? -1 : number_.at({place, earlier});
    }

    const Molecule& molecule_;
    const BlockPattern& pattern_;
    std::vector<glm::vec4>& out_;
    size_t base_;
    std::vector<int> place_;                     // of each vertex, or -1
    std::map<std::pair<int, int>, int> number_;  // of the block at a row and a column
};

}  // namespace

BlockPattern newtonPattern(const Molecule& molecule, const GroupPlan& group) {
    return blockPattern(molecule, group.needs.pins && !group.needs.release, Elimination::fewestRounds);
}

void addNewtonTable(const Molecule& molecule, const BlockPattern& pattern, std::vector<glm::vec4>& topology) {
    Table(molecule, pattern, topology).add();
}

int newtonNumbers(const GroupPlan& group) {
    return 6 * group.vertexCount + 9 * group.matrix.blocks;
}

int newtonTurns(const GroupPlan& group, const WorkgroupShape& shape) {
    const BlockPattern& pattern = group.matrix;
    const int rows = shape.rows;
    const auto turns = [rows](int count) { return (count + rows - 1) / rows + 1; };
    std::vector<int> before(pattern.order.size());  // the most terms of a block in each column
    for (const std::vector<int>& below : pattern.below)
        for (const int i : below)
            ++before[size_t(i)];
    int out = turns(pattern.blocks) + shape.vertices * (2 + 2 * group.springCount / group.vertexCount * 2);
    for (size_t r = 0; r < pattern.rounds.size(); ++r) {
        const size_t first = size_t(pattern.rounds[r]),
                     end = r + 1 < pattern.rounds.size() ? size_t(pattern.rounds[r + 1]) : before.size();
        int terms = 0, blocks = 0, longest = 0;
        for (size_t p = first; p < end; ++p) {
            terms = std::max(terms, before[p]);
            longest = std::max(longest, int(pattern.below[p].size()) + 1);
            blocks += int(pattern.below[p].size()) + 1;
        }
        out += turns(blocks) * (terms + 3) + turns(int(end - first)) * (longest + 2);
    }
    return newtonSteps * out;
}

std::vector<std::string> newtonDefines(const GroupPlan& group) {
    if (!solver(group.solver).spread) return {};
    const double least = newtonSettles * group.size;
    return {concat("MATRIX_BLOCKS ", group.matrix.blocks), concat("SETTLED ", glslLiteral(least * least))};
}

}  // namespace shoal
