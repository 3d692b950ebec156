#include "compile/strain.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/gtc/quaternion.hpp>

#include "compile/corotated.h"
#include "compile/kernel.h"
#include "compile/newton.h"

namespace shoal {

namespace {

using Vectors = std::vector<glm::dvec3>;

// The molecule, and the stage of its substep: find the displacements q that solve
//   m (q - start) / eta^2 = f(x + q, (q - z) / eta)
class StrainedMolecule {
  public:
    StrainedMolecule(const Molecule& molecule, const StrainRun& run)
        : molecule_(molecule), run_(run), history_(solver(run.solver).history), order_(sweepOrder(molecule)) {
        const size_t count = molecule.vertices.size();
        double total = 0;
        glm::dvec3 centre(0);
        for (const Vertex& vertex : molecule.vertices) {
            const bool free = !run.held || !vertex.pinned;
            x_.push_back(run.scale * vertex.position);
            v_.push_back(free ? glm::cross(run.spin, x_.back()) : glm::dvec3(0));
            inverseMass_.push_back(free ? 1 / vertex.mass : 0);
            massShare_.push_back(vertex.mass);
            total += vertex.mass;
            centre += vertex.mass * x_.back();
        }
        for (size_t i = 0; i < count; ++i) {
            restArm_.push_back(x_[i] - centre / total);
            massShare_[i] /= total;
        }
        dx_.resize(count, glm::dvec3(0));
        dv_ = z_ = q_ = start_ = dx_;
        for (const Spring& spring : molecule.springs)
            restLength_.push_back(run.scale * molecule.restLength(spring));
        if (solver(run.solver).spread) {
            pattern_ = blockPattern(molecule, run.held, Elimination::fewestRounds);
            for (size_t p = 0; p < pattern_.order.size(); ++p)
                for (size_t n = 0; n < pattern_.below[p].size(); ++n)
                    number_[{pattern_.order[p], pattern_.order[size_t(pattern_.below[p][n])]}] =
                        pattern_.block[p][n];
        }
        if (run.solver != SolverKind::bdf2Corotated) return;
        pattern_ = blockPattern(molecule, run.held);
        const double eta = 2 * run.substep / run.finer / 3;
        const std::vector<glm::vec4> factors =
            corotatedFactors(molecule, pattern_, {eta, 0, run.stiffness, run.damping});
        blocks_.resize(size_t(pattern_.blocks));
        for (int n = 0; n < 9 * pattern_.blocks; ++n)
            blocks_[size_t(n / 9)][n % 9 / 3][n % 3] = double(factors[size_t(n / 4)][n % 4]);
    }

    void step() {
        const double h = run_.substep / run_.finer;
        eta_ = history_ && !fresh_ ? 2 * h / 3 : h;
        for (size_t i = 0; i < x_.size(); ++i) {
            if (inverseMass_[i] == 0) continue;
            const glm::dvec3 unsprung = v_[i] + run_.gravity * eta_ + dv_[i] / 3.0;
            z_[i] = !history_ ? glm::dvec3(0) : fresh_ ? run_.gravity * (-0.5 * h * h) : dx_[i] / 3.0;
            start_[i] = q_[i] = z_[i] + unsprung * eta_;
        }
        if (solver(run_.solver).spread)
            solveNewton();
        else if (run_.solver == SolverKind::bdf2Corotated)
            solveCorotated();
        else
            sweep(history_);
        for (size_t i = 0; i < x_.size(); ++i) {
            if (inverseMass_[i] == 0) continue;
            const glm::dvec3 velocity = (q_[i] - z_[i]) / eta_;
            if (history_) dv_[i] = velocity - v_[i];
            dx_[i] = q_[i];
            v_[i] = velocity;
            x_[i] += q_[i];
        }
        fresh_ = false;
    }

    double strain() const {
        double out = 0;
        for (size_t s = 0; s < restLength_.size(); ++s) {
            const Spring& spring = molecule_.springs[s];
            const double length = glm::distance(x_[size_t(spring.a)], x_[size_t(spring.b)]);
            if (restLength_[s] > 0) out = std::max(out, std::abs(length / restLength_[s] - 1));
        }
        return out;
    }

  private:
    // As in shaders/physics/relaxation.glsl. `pushed`: N, what the spring has pushed with so far.
    void relax(size_t index, double& pushed) {
        const Spring& spring = molecule_.springs[index];
        const size_t a = size_t(spring.a), b = size_t(spring.b);
        const double weightA = inverseMass_[a] * eta_ * eta_, weightB = inverseMass_[b] * eta_ * eta_;
        const glm::dvec3 d = x_[a] - x_[b] + q_[a] - q_[b];
        const double length = std::max(glm::length(d), 1e-12);
        const double parted = glm::dot(d, q_[a] - q_[b] - z_[a] + z_[b]) / length;
        const double k = run_.stiffness * spring.stiffness, c = run_.damping * spring.damping / eta_;
        const double change =
            -(k * (length - restLength_[index]) + c * parted + pushed) / ((k + c) * (weightA + weightB) + 1);
        pushed += change;
        q_[a] += d / length * (change * weightA);
        q_[b] -= d / length * (change * weightB);
    }

    void sweep(bool back) {
        std::vector<double> pushed(order_.size(), 0);
        for (const size_t s : order_)
            relax(s, pushed[s]);
        for (size_t n = order_.size(); back && n-- > 0;)
            relax(order_[n], pushed[order_[n]]);
    }

    // Turns the rest shape onto x + q [Mueller 2016]. Returns the furthest distance of a vertex from it, m.
    double fit() {
        glm::dvec3 centre(0);
        for (size_t i = 0; i < x_.size(); ++i)
            centre += massShare_[i] * (x_[i] + q_[i]);
        glm::dmat3 covariance(0);
        for (size_t i = 0; i < x_.size(); ++i)
            covariance += glm::outerProduct(massShare_[i] * (x_[i] + q_[i] - centre), restArm_[i]);
        for (int round = 0; round < 3; ++round) {
            glm::dvec3 axis(0);
            double along = 0;
            for (int k = 0; k < 3; ++k) {
                axis += glm::cross(turn_[k], covariance[k]);
                along += glm::dot(turn_[k], covariance[k]);
            }
            axis /= std::max(std::abs(along), 1e-20);
            if (const double angle = glm::length(axis); angle > 1e-12)
                turn_ = glm::mat3_cast(glm::angleAxis(angle, axis / angle)) * turn_;
        }
        double furthest = 0;
        for (size_t i = 0; i < x_.size(); ++i)
            furthest = std::max(furthest, glm::distance(x_[i] + q_[i] - centre, turn_ * restArm_[i]));
        return furthest;
    }

    // residual = A^-1 residual
    void applyInverse(Vectors& residual) const {
        const auto element = [&](size_t place) -> glm::dvec3& {
            return residual[size_t(pattern_.order[place])];
        };
        for (size_t p = 0; p < pattern_.order.size(); ++p)
            for (size_t n = 0; n < pattern_.below[p].size(); ++n)
                element(size_t(pattern_.below[p][n])) -= blocks_[size_t(pattern_.block[p][n])] * element(p);
        for (size_t p = pattern_.order.size(); p-- > 0;) {
            element(p) = blocks_[size_t(pattern_.diagonal[p])] * element(p);
            for (size_t n = 0; n < pattern_.below[p].size(); ++n)
                element(p) -= element(size_t(pattern_.below[p][n])) * blocks_[size_t(pattern_.block[p][n])];
        }
    }

    // One quasi-Newton step. Returns the sum of its squares, m^2.
    double improve() {
        Vectors residual(x_.size(), glm::dvec3(0));
        for (size_t s = 0; s < restLength_.size(); ++s) {
            const Spring& spring = molecule_.springs[s];
            const size_t a = size_t(spring.a), b = size_t(spring.b);
            const glm::dvec3 d = x_[a] - x_[b] + q_[a] - q_[b], n = d / std::max(glm::length(d), 1e-12);
            const glm::dvec3 push =
                -n * (run_.stiffness * spring.stiffness * (glm::length(d) - restLength_[s]) +
                      run_.damping * spring.damping / eta_ * glm::dot(n, q_[a] - q_[b] - z_[a] + z_[b]));
            residual[a] += push;
            residual[b] -= push;
        }
        for (size_t i = 0; i < x_.size(); ++i)
            if (inverseMass_[i] > 0)
                residual[i] = (residual[i] - (q_[i] - start_[i]) / (inverseMass_[i] * eta_ * eta_)) * turn_;
        applyInverse(residual);
        double sum = 0;
        for (size_t i = 0; i < x_.size(); ++i) {
            if (inverseMass_[i] == 0) continue;
            q_[i] += turn_ * residual[i];
            sum += glm::dot(residual[i], residual[i]);
        }
        return sum;
    }

    // Two quasi-Newton steps. Returns whether they converge; else q is as it was.
    bool solved() {
        const Vectors before = q_;
        const double first = improve();
        fit();
        const double second = improve(), size = run_.scale * molecule_.size();
        if (second < 0.25 * first || second < 1e-12 * size * size) return true;
        q_ = before;
        return false;
    }

    // Guarded as shaders/solver/bdf2-corotated.glsl is.
    void solveCorotated() {
        if (fit() <= 0.03 * run_.scale * molecule_.size() && !fresh_ && solved()) return;
        sweep(true);
        fit();
        solved();
    }

    // The Newton steps of shaders/solver/bdf2-newton.glsl.
    void solveNewton() {
        const double least = newtonSettles * run_.scale * molecule_.size();
        for (int step = 0; step < newtonSteps; ++step) {
            Vectors residual = assemble();
            factor();
            applyInverse(residual);
            double furthest = 0;
            for (size_t i = 0; i < x_.size(); ++i) {
                if (inverseMass_[i] == 0) continue;
                q_[i] += residual[i];
                furthest = std::max(furthest, glm::length(residual[i]));
            }
            if (furthest <= least) return;
        }
    }

    // Fills the blocks with the matrix at x + q. Returns the stage's residual, N.
    Vectors assemble() {
        Vectors residual(x_.size(), glm::dvec3(0));
        std::vector<glm::dmat3> own(x_.size(), glm::dmat3(0));
        blocks_.assign(size_t(pattern_.blocks), glm::dmat3(0));
        for (size_t i = 0; i < x_.size(); ++i) {
            if (inverseMass_[i] == 0) continue;
            own[i] = glm::dmat3(1 / (inverseMass_[i] * eta_ * eta_));
            residual[i] = -own[i] * (q_[i] - start_[i]);
        }
        for (size_t s = 0; s < restLength_.size(); ++s) {
            const Spring& spring = molecule_.springs[s];
            const size_t a = size_t(spring.a), b = size_t(spring.b);
            const glm::dvec3 known = x_[a] - x_[b] + z_[a] - z_[b], d = x_[a] - x_[b] + q_[a] - q_[b];
            const double length = std::max(glm::length(d), 1e-12);
            const glm::dvec3 n = d / length, along = fresh_ ? (d + known) / (length + glm::length(known)) : n;
            const double k = run_.stiffness * spring.stiffness, c = run_.damping * spring.damping / eta_;
            const double tension = k * (length - restLength_[s]) + c * glm::dot(along, d - known);
            const double turning = std::clamp(tension / length, 0.0, k + c);
            const glm::dmat3 change = glm::dmat3(turning) + glm::outerProduct(n, n * (k + c - turning));
            residual[a] -= n * tension, residual[b] += n * tension;
            own[a] += change, own[b] += change;
            for (const auto& ends : {std::pair(spring.a, spring.b), std::pair(spring.b, spring.a)})
                if (const auto number = number_.find(ends); number != number_.end())
                    blocks_[size_t(number->second)] -= change;
        }
        for (size_t p = 0; p < pattern_.order.size(); ++p)
            blocks_[size_t(pattern_.diagonal[p])] = own[size_t(pattern_.order[p])];
        return residual;
    }

    // Turns the blocks of the matrix into those of its factors, L and the inverse of D, for applyInverse().
    void factor() {
        for (size_t p = 0; p < pattern_.order.size(); ++p) {
            glm::dmat3& diagonal = blocks_[size_t(pattern_.diagonal[p])];
            diagonal = glm::inverse(diagonal);
            const std::vector<int>&below = pattern_.below[p], &numbers = pattern_.block[p];
            for (size_t i = 0; i < below.size(); ++i) {
                const glm::dmat3 row = blocks_[size_t(numbers[i])] * diagonal;
                for (size_t j = 0; j <= i; ++j) {
                    const int later = below[i], earlier = below[j];
                    const int target =
                        i == j ? pattern_.diagonal[size_t(later)]
                               : number_.at({pattern_.order[size_t(earlier)], pattern_.order[size_t(later)]});
                    blocks_[size_t(target)] -= row * glm::transpose(blocks_[size_t(numbers[j])]);
                }
            }
            for (const int number : numbers)
                blocks_[size_t(number)] = blocks_[size_t(number)] * diagonal;
        }
    }

    const Molecule& molecule_;
    StrainRun run_;
    bool history_;
    std::vector<size_t> order_;
    std::vector<double> inverseMass_;  // 1/kg; 0 where held
    std::vector<double> massShare_;    // of the molecule's
    Vectors restArm_;                  // m, from the centre of mass
    std::vector<double> restLength_;   // m
    Vectors x_, v_, dx_, dv_;          // m, m/s, and their changes in the last substep
    Vectors z_, q_, start_;            // m: known before the stage, its solution, and that without springs
    glm::dmat3 turn_{1};               // of the rest shape
    BlockPattern pattern_;
    std::vector<glm::dmat3> blocks_;             // of the factors
    std::map<std::pair<int, int>, int> number_;  // bdf2-newton: of a block, by the vertices that it joins
    double eta_ = 0;                             // s
    bool fresh_ = true;                          // no history
};

}  // namespace

double largestStrain(const Molecule& molecule, const StrainRun& run) {
    StrainedMolecule strained(molecule, run);
    const int substeps = int(std::clamp(std::ceil(0.5 / run.substep), 1.0, 1000.0));
    double out = 0;
    for (int n = 0; n < substeps * run.finer; ++n) {
        strained.step();
        out = std::max(out, strained.strain());
    }
    return out;
}

}  // namespace shoal
