// The statistics of a group over an ensemble of runs that differ in their seeds, and how those of a method
// differ from a reference's. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "measure/confidence.h"
#include "simulate/simulation.h"

namespace shoal::measure {

// One quantity of a group at the end of a run.
struct Quantity {
    std::string name, unit;
    std::vector<double> values;  // one a molecule
    // The least scale of its differences: what is less than a hundredth of a molecule's size, or a hundredth
    // of it on the way from the start to the end, shows to nobody.
    double least = 0;
    enum class Summary { meanAndQuantiles, mean, value } summary = Summary::meanAndQuantiles;
};

// Returns the quantities that the group has, of the molecules that live.
std::vector<Quantity> quantitiesOf(const Scene& scene, const GroupPlan& plan, const Snapshot& end);

// One statistic of a quantity.
struct Statistic {
    std::string group, quantity, unit;
    std::string statistic;       // "mean", "5 %", "50 %", "95 %", "value"
    std::vector<double> values;  // a run each
    double scale = 0;  // standard deviation of the quantity over all molecules of all runs, or `least`
};

class Ensemble {
  public:
    // The statistics of a group in one more run: the same groups in each.
    void add(const std::string& group, const std::vector<Quantity>& quantities);
    // Returns the statistics that every run has.
    std::vector<Statistic> statistics(int runs) const;

  private:
    struct Row : Statistic {
        double least = 0, count = 0, mean = 0, squares = 0;  // of all molecules: number, mean, sum of squares
    };
    void add(const std::string& group, const Quantity& quantity, const char* statistic, double value);
    std::vector<Row> rows_;
};

enum class Verdict {
    none,     // its interval holds 0
    perhaps,  // it does not, but of so many statistics one may be off by chance
    differs,  // nor does one so wide that of all statistics of a method 95 % of ensembles have none beyond
};
const char* name(Verdict verdict);  // "no", "perhaps", "yes"

// Runs are compared in pairs that have a seed in common [Student 1908].
struct Difference {
    std::string group, quantity, unit, statistic;
    Estimate reference, value, difference;  // 95 %
    std::optional<double> scale;            // of what it is a share; nothing: of no molecules, but of a shape
    Verdict verdict = Verdict::none;
    std::optional<double> relative() const;  // |difference| / scale
};
// Compares the statistics that both have in each run. The verdict divides 5 % by the number of statistics
// [Dunn 1961].
std::vector<Difference> compare(const Ensemble& reference, const Ensemble& method, int runs);
// Finds the difference that is the largest share of its scale; nothing: none has a scale.
std::optional<size_t> worstOf(const std::vector<Difference>& differences);
// Returns the largest share of a scale that an interval reaches.
double withinOf(const std::vector<Difference>& differences);

}  // namespace shoal::measure
