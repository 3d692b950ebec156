#include "compile/corotated.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "compile/glsl_text.h"

namespace shoal {

namespace {

Eigen::Vector3d toEigen(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Eigen::MatrixXd stageMatrix(const Molecule& molecule, const CorotatedStage& stage) {
    const Eigen::Index size = 3 * Eigen::Index(molecule.vertices.size());
    const double beta = 1 / (stage.eta * stage.eta) + stage.drag / stage.eta;
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size, size);
    for (size_t v = 0; v < molecule.vertices.size(); ++v)
        out.diagonal().segment<3>(3 * Eigen::Index(v)).setConstant(beta * molecule.vertices[v].mass);
    for (const Spring& spring : molecule.springs) {
        const Eigen::Vector3d d = toEigen(molecule.vertices[size_t(spring.a)].position -
                                          molecule.vertices[size_t(spring.b)].position);
        if (d.norm() == 0) continue;
        const Eigen::Vector3d n = d.normalized();
        const double strength =
            stage.stiffness * spring.stiffness + stage.damping * spring.damping / stage.eta;
        const Eigen::Matrix3d block = strength * n * n.transpose();
        const Eigen::Index a = 3 * spring.a, b = 3 * spring.b;
        out.block<3, 3>(a, a) += block;
        out.block<3, 3>(b, b) += block;
        out.block<3, 3>(a, b) -= block;
        out.block<3, 3>(b, a) -= block;
    }
    return out;
}

std::string element(int number) {
    return concat("factors[", number / 4, "][", number % 4, "]");
}

// Three vertices that stand as far apart as possible: their plane is the first guess of how a molecule is
// turned.
std::array<int, 3> widestTriangle(const Molecule& molecule) {
    const int count = int(molecule.vertices.size());
    const auto position = [&](int v) { return molecule.vertices[size_t(v)].position; };
    const auto furthest = [&](const auto& distance) {
        int best = 0;
        for (int v = 1; v < count; ++v)
            if (distance(v) > distance(best)) best = v;
        return best;
    };
    const int a = 0, b = furthest([&](int v) { return glm::length(position(v) - position(a)); });
    const int c = furthest(
        [&](int v) { return glm::length(glm::cross(position(v) - position(a), position(b) - position(a))); });
    return {a, b, c};
}

std::string block(int number) {
    std::string out = "mat3(";
    for (int k = 0; k < 9; ++k)
        out += (k == 0 ? "" : ", ") + element(9 * number + k);
    return out + ")";
}

// L y = residual, D z = y, L^T correction = z.
std::string solveText(const BlockPattern& pattern) {
    std::string out =
        "\n// correction = A^-1 residual\nvoid applyInverse()\n{\n    for (int i = 0; i < VERTICES; ++i) {\n"
        "        correction[i] = residual[i];\n    }\n";
    const auto element = [&](size_t place) { return concat("correction[", pattern.order[place], "]"); };
    const size_t count = pattern.order.size();
    for (size_t p = 0; p < count; ++p)
        for (size_t n = 0; n < pattern.below[p].size(); ++n)
            out += concat("    ", element(size_t(pattern.below[p][n])), " -= ", block(pattern.block[p][n]),
                          " * ", element(p), ";\n");
    for (size_t p = count; p-- > 0;) {
        out += concat("    ", element(p), " = ", block(pattern.diagonal[p]), " * ", element(p), ";\n");
        for (size_t n = 0; n < pattern.below[p].size(); ++n)
            out += concat("    ", element(p), " -= ", element(size_t(pattern.below[p][n])), " * ",
                          block(pattern.block[p][n]), ";\n");
    }
    return out + "}\n";
}

std::string restText(const Molecule& molecule) {
    double total = 0;
    glm::dvec3 centre(0);
    for (const Vertex& vertex : molecule.vertices) {
        total += vertex.mass;
        centre += vertex.mass * vertex.position;
    }
    centre /= total;
    const size_t count = molecule.vertices.size();
    const auto arm = [&](size_t v) { return glslLiteral(molecule.vertices[v].position - centre); };
    const auto share = [&](size_t v) { return glslLiteral(molecule.vertices[v].mass / total); };
    return glslArray("vec3", "restArm", count, arm) + glslArray("float", "massShare", count, share);
}

}  // namespace

int corotatedElements(const BlockPattern& pattern) {
    return std::max(1, (9 * pattern.blocks + 3) / 4);
}

std::vector<glm::vec4> corotatedFactors(const Molecule& molecule, const BlockPattern& pattern,
                                        const CorotatedStage& stage) {
    const Eigen::MatrixXd whole = stageMatrix(molecule, stage);
    const Eigen::Index count = Eigen::Index(pattern.order.size());
    Eigen::MatrixXd matrix(3 * count, 3 * count);
    for (Eigen::Index i = 0; i < count; ++i)
        for (Eigen::Index j = 0; j < count; ++j)
            matrix.block<3, 3>(3 * i, 3 * j) =
                whole.block<3, 3>(3 * pattern.order[size_t(i)], 3 * pattern.order[size_t(j)]);
    std::vector<glm::vec4> out(size_t(corotatedElements(pattern)), glm::vec4(0));
    const auto keep = [&](int number, const Eigen::Matrix3d& block) {
        for (int k = 0; k < 9; ++k)
            out[size_t((9 * number + k) / 4)][(9 * number + k) % 4] = float(block(k % 3, k / 3));
    };
    for (Eigen::Index p = 0; p < count; ++p) {
        const Eigen::Matrix3d inverse = matrix.block<3, 3>(3 * p, 3 * p).inverse();
        keep(pattern.diagonal[size_t(p)], inverse);
        const std::vector<int>& below = pattern.below[size_t(p)];
        for (size_t n = 0; n < below.size(); ++n)
            keep(pattern.block[size_t(p)][n], matrix.block<3, 3>(3 * below[n], 3 * p) * inverse);
        for (const int i : below)
            for (const int j : below)
                matrix.block<3, 3>(3 * i, 3 * j) -=
                    matrix.block<3, 3>(3 * i, 3 * p) * inverse * matrix.block<3, 3>(3 * p, 3 * j);
    }
    return out;
}

std::string corotatedBlock(const BlockPattern& pattern) {
    return concat("layout(std140) uniform Factors { vec4 factors[", corotatedElements(pattern), "]; };\n");
}

std::string corotatedConstants(const std::vector<glm::vec4>& factors) {
    std::string out = concat("const vec4 factors[", std::max<size_t>(1, factors.size()), "] = vec4[](");
    if (factors.empty()) out += "vec4(0.0)";
    for (size_t i = 0; i < factors.size(); ++i)
        out += concat(i == 0 ? "vec4(" : ",\n    vec4(", glslLiteral(factors[i].x), ", ",
                      glslLiteral(factors[i].y), ", ", glslLiteral(factors[i].z), ", ",
                      glslLiteral(factors[i].w), ")");
    return out + ");\n";
}

std::string corotatedText(const Molecule& molecule, const BlockPattern& pattern, bool held) {
    const std::array<int, 3> fit = widestTriangle(molecule);
    const double size = molecule.size();
    return concat("#define FIT_A ", fit[0], "\n#define FIT_B ", fit[1], "\n#define FIT_C ", fit[2],
                  "\n#define STRAYS ", glslLiteral(0.03 * size), "\n#define SETTLED ",
                  glslLiteral(1e-12 * size * size), "\n#define SHARED_PINS ", held ? "true" : "false",
                  "\n\n") +
           restText(molecule) + "\nvec3 residual[VERTICES];    // N, in the rest shape's axes\n" +
           "vec3 correction[VERTICES];  // m, likewise\n" + solveText(pattern);
}

}  // namespace shoal
