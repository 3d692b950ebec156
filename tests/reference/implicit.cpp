#include <cmath>

#include <Eigen/Dense>

#include "compile/kernel.h"
#include "compile/newton.h"
#include "molecule/skin.h"
#include "reference/discrete.h"
#include "reference/fields.h"
#include "reference/forces.h"

namespace shoal::reference {

namespace {

// Across and along the surface.
struct Rates {
    double across, along;
};

// A stage in the making.
struct Stage {
    double eta = 0;                  // s
    double time = 0;                 // s, at its end
    Vectors known;                   // z, m
    Vectors moved;                   // q, m
    std::vector<glm::dmat3> weight;  // inverse of mass times beta, s^2/kg; 0 where pinned
};

glm::dmat3 byDirection(const glm::dvec3& n, const Rates& rates) {
    return glm::dmat3(rates.along) + (rates.across - rates.along) * glm::outerProduct(n, n);
}

// v + decay (u - v) + phi a, each by its direction.
glm::dvec3 relaxed(const glm::dvec3& v, const glm::dvec3& u, const glm::dvec3& a, const glm::dvec3& n,
                   const Rates& decay, const Rates& phi) {
    return v + byDirection(n, decay) * (u - v) + byDirection(n, phi) * a;
}

template <typename Function>
Rates ratesOf(const Drag& drag, const Function& function) {
    return {function(drag.normal), function(drag.tangent)};
}

// The coefficients of drag over a whole step.
struct Flight {
    Rates decay, phi, bend;  // bend: (h - phi) / gamma
};

Flight flightOf(const Problem& problem, double h) {
    const auto decay = [&](double gamma) { return -std::expm1(-gamma * h); };
    const auto phi = [&](double gamma) { return gamma == 0 ? h : decay(gamma) / gamma; };
    const auto bend = [&](double gamma) {
        return gamma * h < 1e-5 ? h * h * (0.5 - gamma * h / 6) : (h - phi(gamma)) / gamma;
    };
    return {ratesOf(problem.drag, decay), ratesOf(problem.drag, phi), ratesOf(problem.drag, bend)};
}

Vectors fluidAt(const Problem& problem, const Vectors& position, double time) {
    Vectors out(position.size(), glm::dvec3(0));
    for (size_t i = 0; i < out.size() && problem.drag.any(); ++i)
        out[i] = forceWind(problem.forces, time) + fluidVelocity(problem.fields, position[i], time);
    return out;
}

// Gravity and forces.
Vectors fallAt(const Problem& problem, const Vectors& position, double time) {
    Vectors out(position.size(), problem.gravity);
    for (size_t i = 0; i < out.size(); ++i)
        out[i] += forceAcceleration(problem.forces, position[i], time);
    return out;
}

Vectors surfaceAt(const Problem& problem, const Vectors& position) {
    return problem.drag.directional() ? vertexNormals(*problem.molecule, position)
                                      : Vectors(position.size(), glm::dvec3(0));
}

void relax(const Problem& problem, const State& state, Stage& stage, size_t index, double& pushed) {
    const Spring& spring = problem.molecule->springs[index];
    const size_t a = size_t(spring.a), b = size_t(spring.b);
    const glm::dvec3 d = (state.position[a] + stage.moved[a]) - (state.position[b] + stage.moved[b]);
    const double length = glm::length(d);
    if (length < 1e-12) return;
    const glm::dvec3 n = d / length;
    const glm::dvec3 parted = (stage.moved[a] - stage.known[a]) - (stage.moved[b] - stage.known[b]);
    const double k = problem.stiffness * spring.stiffness, c = problem.damping * spring.damping / stage.eta;
    const double weight = glm::dot(n, (stage.weight[a] + stage.weight[b]) * n);
    const double stretch = length - restLength(problem, spring, stage.time);
    const double change = -(k * stretch + c * glm::dot(n, parted) + pushed) / ((k + c) * weight + 1);
    pushed += change;
    stage.moved[a] += stage.weight[a] * n * change;
    stage.moved[b] -= stage.weight[b] * n * change;
}

void sweep(const Problem& problem, const State& state, Stage& stage, bool back) {
    const std::vector<size_t> order = sweepOrder(*problem.molecule);
    std::vector<double> pushed(order.size(), 0);
    for (const size_t i : order)
        relax(problem, state, stage, i, pushed[i]);
    for (size_t i = order.size(); back && i-- > 0;)
        relax(problem, state, stage, order[i], pushed[order[i]]);
}

Eigen::Vector3d toEigen(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

// The rotation of the rest shape that comes nearest to the displaced molecule, by mass; and how far the
// furthest vertex is from it, as a share of the molecule's size.
struct Fit {
    Eigen::Matrix3d rotation;
    double furthest = 0;
};

Fit fit(const Problem& problem, const State& state, const Stage& stage) {
    const auto& vertices = problem.molecule->vertices;
    glm::dvec3 centre(0), restCentre(0);
    double total = 0;
    for (size_t i = 0; i < vertices.size(); ++i) {
        total += vertices[i].mass;
        centre += vertices[i].mass * (state.position[i] + stage.moved[i]);
        restCentre += vertices[i].mass * vertices[i].position;
    }
    centre /= total;
    restCentre /= total;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    const auto arm = [&](size_t i) { return toEigen(state.position[i] + stage.moved[i] - centre); };
    const auto rest = [&](size_t i) { return toEigen(vertices[i].position - restCentre); };
    for (size_t i = 0; i < vertices.size(); ++i)
        covariance += vertices[i].mass * arm(i) * rest(i).transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
    Fit out{svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose(), 0};
    const double size = problem.molecule->size();
    for (size_t i = 0; i < vertices.size(); ++i)
        out.furthest = std::max(
            out.furthest, (arm(i) - problem.scale * out.rotation * rest(i)).norm() / (problem.scale * size));
    return out;
}

Eigen::MatrixXd restMatrix(const Problem& problem, double eta) {
    const Molecule& molecule = *problem.molecule;
    const Eigen::Index size = 3 * Eigen::Index(molecule.vertices.size());
    const double gamma = std::max(problem.drag.normal, problem.drag.tangent);
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size, size);
    for (const Spring& spring : molecule.springs) {
        const glm::dvec3 d =
            molecule.vertices[size_t(spring.a)].position - molecule.vertices[size_t(spring.b)].position;
        if (glm::length(d) == 0) continue;
        Eigen::VectorXd n = Eigen::VectorXd::Zero(size);
        n.segment<3>(3 * spring.a) = toEigen(glm::normalize(d));
        n.segment<3>(3 * spring.b) = -toEigen(glm::normalize(d));
        out += (problem.stiffness * spring.stiffness + problem.damping * spring.damping / eta) * n *
               n.transpose();
    }
    for (size_t i = 0; i < molecule.vertices.size(); ++i) {
        const Eigen::Index row = 3 * Eigen::Index(i);
        if (problem.pinned(i)) {
            out.middleRows<3>(row).setZero();
            out.middleCols<3>(row).setZero();
        }
        out.block<3, 3>(row, row) +=
            (1 / (eta * eta) + gamma / eta) * molecule.vertices[i].mass * Eigen::Matrix3d::Identity();
    }
    return out;
}

// Tries to solve the stage by two quasi-Newton steps from where it is. False: they have not solved it, and it
// is as it was. `eta`: of the matrix; `start`: the solution without springs.
bool improve(const Problem& problem, const State& state, double eta, const Vectors& start, Stage& stage) {
    const Eigen::LDLT<Eigen::MatrixXd> matrix(restMatrix(problem, eta));
    const Vectors before = stage.moved;
    const size_t count = start.size();
    double first = 0, second = 0;
    for (int step = 0; step < 2; ++step) {
        const Fit rotation = fit(problem, state, stage);
        Vectors position(count), velocity(count);
        for (size_t i = 0; i < count; ++i) {
            position[i] = state.position[i] + stage.moved[i];
            velocity[i] = (stage.moved[i] - stage.known[i]) / stage.eta;
        }
        const Vectors spring = springAcceleration(problem, position, velocity, stage.time);
        Eigen::VectorXd residual = Eigen::VectorXd::Zero(3 * Eigen::Index(count));
        for (size_t i = 0; i < count; ++i) {
            if (problem.pinned(i)) continue;
            const glm::dvec3 left = problem.molecule->vertices[i].mass * spring[i] -
                                    glm::inverse(stage.weight[i]) * (stage.moved[i] - start[i]);
            residual.segment<3>(3 * Eigen::Index(i)) = rotation.rotation.transpose() * toEigen(left);
        }
        const Eigen::VectorXd change = matrix.solve(residual);
        first = second;
        second = 0;
        for (size_t i = 0; i < count; ++i) {
            if (problem.pinned(i)) continue;
            const Eigen::Vector3d d = rotation.rotation * change.segment<3>(3 * Eigen::Index(i));
            stage.moved[i] += glm::dvec3(d.x(), d.y(), d.z());
            second += d.squaredNorm();
        }
    }
    const double size = problem.scale * problem.molecule->size();
    if (second < 0.25 * first || second < 1e-12 * size * size) return true;
    stage.moved = before;
    return false;
}

// Quasi-Newton steps, guarded as the shader's are: where they fail, from where the sweeps end. The matrix is
// that of steps with history.
void solveCorotated(const Problem& problem, const State& state, bool fresh, Stage& stage) {
    const Vectors start = stage.moved;
    const double eta = fresh ? 2 * stage.eta / 3 : stage.eta;
    const bool near = !fresh && fit(problem, state, stage).furthest <= 0.03;
    if (near && improve(problem, state, eta, start, stage)) return;
    sweep(problem, state, stage, true);
    improve(problem, state, eta, start, stage);
}

// Newton steps with the matrix of the molecule as it is, without how a damper's pull turns with its spring.
void solveNewton(const Problem& problem, const State& state, bool fresh, Stage& stage) {
    const Molecule& molecule = *problem.molecule;
    const Vectors start = stage.moved;
    const Eigen::Index size = 3 * Eigen::Index(start.size());
    const double settled = newtonSettles * problem.scale * molecule.size();
    for (int step = 0; step < newtonSteps; ++step) {
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
        Eigen::VectorXd residual = Eigen::VectorXd::Zero(size);
        for (const Spring& spring : molecule.springs) {
            const size_t a = size_t(spring.a), b = size_t(spring.b);
            const glm::dvec3 known =
                (state.position[a] + stage.known[a]) - (state.position[b] + stage.known[b]);
            const glm::dvec3 d = (state.position[a] + stage.moved[a]) - (state.position[b] + stage.moved[b]);
            const double length = std::max(glm::length(d), 1e-12);
            const glm::dvec3 n = d / length, along = fresh ? (d + known) / (length + glm::length(known)) : n;
            const double k = problem.stiffness * spring.stiffness,
                         c = problem.damping * spring.damping / stage.eta;
            const double tension =
                k * (length - restLength(problem, spring, stage.time)) + c * glm::dot(along, d - known);
            const double turning = std::clamp(tension / length, 0.0, k + c);
            const Eigen::Vector3d unit = toEigen(n);
            const Eigen::Matrix3d change =
                turning * Eigen::Matrix3d::Identity() + (k + c - turning) * unit * unit.transpose();
            for (const int row : {spring.a, spring.b}) {
                residual.segment<3>(3 * row) -= (row == spring.a ? tension : -tension) * unit;
                for (const int column : {spring.a, spring.b})
                    matrix.block<3, 3>(3 * row, 3 * column) += row == column ? change : -change;
            }
        }
        for (size_t i = 0; i < start.size(); ++i) {
            const Eigen::Index row = 3 * Eigen::Index(i);
            if (problem.pinned(i)) {
                matrix.middleRows<3>(row).setZero(), matrix.middleCols<3>(row).setZero();
                matrix.block<3, 3>(row, row).setIdentity();
                residual.segment<3>(row).setZero();
                continue;
            }
            const glm::dmat3 heavy = glm::inverse(stage.weight[i]);
            residual.segment<3>(row) -= toEigen(heavy * (stage.moved[i] - start[i]));
            for (int column = 0; column < 3; ++column)
                matrix.block<3, 1>(row, row + column) += toEigen(heavy[column]);
        }
        const Eigen::VectorXd change = Eigen::LDLT<Eigen::MatrixXd>(matrix).solve(residual);
        double furthest = 0;
        for (size_t i = 0; i < start.size(); ++i) {
            const Eigen::Vector3d d = change.segment<3>(3 * Eigen::Index(i));
            stage.moved[i] += glm::dvec3(d.x(), d.y(), d.z());
            furthest = std::max(furthest, d.norm());
        }
        if (furthest <= settled) return;
    }
}

}  // namespace

void xpbdStep(const Problem& problem, State& state, double h) {
    const size_t count = state.position.size();
    push(problem, state, h);
    const Vectors u = fluidAt(problem, state.position, state.time), n = surfaceAt(problem, state.position);
    const Vectors a = fallAt(problem, state.position, state.time);
    const Flight flight = flightOf(problem, h);
    Stage stage{h, state.time + h, Vectors(count, glm::dvec3(0)), Vectors(count, glm::dvec3(0)),
                std::vector<glm::dmat3>(count, glm::dmat3(0))};
    for (size_t i = 0; i < count; ++i) {
        if (problem.pinned(i)) continue;
        stage.moved[i] = h * relaxed(state.velocity[i], u[i], a[i], n[i], flight.decay, flight.phi);
        stage.weight[i] = h / problem.molecule->vertices[i].mass * byDirection(n[i], flight.phi);
    }
    sweep(problem, state, stage, false);
    for (size_t i = 0; i < count; ++i) {
        state.velocity[i] = stage.moved[i] / h;
        state.position[i] += stage.moved[i];
    }
    state.time += h;
}

// The thrust over h from the velocity with half of the last step's change; without history over h/2.
static void pushAhead(const Problem& problem, State& state, const History& history, double h) {
    if (history.velocityChange.empty()) return push(problem, state, h / 2);
    Vectors between = state.velocity;
    for (size_t i = 0; i < between.size(); ++i)
        between[i] += history.velocityChange[i] / 2.0;
    const glm::dvec3 mean = meanVelocity(problem, between);
    const glm::dvec3 gained = thrusted(problem.forces, mean, state.time, h) - mean;
    for (size_t i = 0; i < between.size(); ++i)
        if (!problem.pinned(i)) state.velocity[i] += gained;
}

void bdf2Step(const Problem& problem, State& state, History& history, double h, SolverKind kind) {
    const size_t count = state.position.size();
    const bool fresh = history.displacement.empty();
    const double eta = fresh ? h : 2 * h / 3;
    pushAhead(problem, state, history, h);
    Vectors ahead = state.position;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 v = state.velocity[i];
        if (problem.pinned(i)) continue;
        ahead[i] +=
            fresh ? h * v : history.displacement[i] / 3.0 + eta * (v + history.velocityChange[i] / 3.0);
    }
    const Vectors u = fluidAt(problem, ahead, state.time + h), n = surfaceAt(problem, ahead);
    const Vectors a = fallAt(problem, ahead, state.time + h);
    const Flight flight = flightOf(problem, h);
    const Rates phi =
        fresh ? flight.phi : ratesOf(problem.drag, [eta](double gamma) { return eta / (1 + gamma * eta); });
    const Rates decay{problem.drag.normal * phi.across, problem.drag.tangent * phi.along};
    Stage stage{eta, state.time + h, Vectors(count, glm::dvec3(0)), Vectors(count, glm::dvec3(0)),
                std::vector<glm::dmat3>(count, glm::dmat3(0))};
    for (size_t i = 0; i < count; ++i) {
        if (problem.pinned(i)) continue;
        const glm::dvec3 v = state.velocity[i];
        const glm::dvec3 w = fresh ? v : v + history.velocityChange[i] / 3.0;
        const glm::dvec3 velocity = relaxed(w, u[i], a[i], n[i], decay, phi);
        stage.known[i] = fresh ? h * v - eta * velocity : history.displacement[i] / 3.0;
        if (fresh)
            stage.known[i] +=
                byDirection(n[i], flight.bend) *
                (a[i] + byDirection(n[i], {problem.drag.normal, problem.drag.tangent}) * (u[i] - v));
        stage.moved[i] = stage.known[i] + eta * velocity;
        stage.weight[i] = eta / problem.molecule->vertices[i].mass * byDirection(n[i], phi);
    }
    if (kind == SolverKind::bdf2Newton)
        solveNewton(problem, state, fresh, stage);
    else if (kind == SolverKind::bdf2Corotated)
        solveCorotated(problem, state, fresh, stage);
    else
        sweep(problem, state, stage, true);
    history.displacement.resize(count);
    history.velocityChange.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 velocity = (stage.moved[i] - stage.known[i]) / eta;
        history.velocityChange[i] = velocity - state.velocity[i];
        history.displacement[i] = stage.moved[i];
        state.velocity[i] = velocity;
        state.position[i] += stage.moved[i];
    }
    if (fresh) push(problem, state, h / 2);
    state.time += h;
}

}  // namespace shoal::reference
