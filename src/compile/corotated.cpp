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

int blockNumber(int i, int j) {
    return i * (i + 1) / 2 + j;
}

std::string element(int number) {
    return concat("inverse[", number / 4, "][", number % 4, "]");
}

// Three vertices that stand as far apart as possible: their plane is the first guess of how a molecule is
// turned.
std::array<int, 3> widestTriangle(const Molecule& molecule) {
    const int count = int(molecule.vertices.size());
    const auto at = [&](int v) { return molecule.vertices[size_t(v)].position; };
    const auto furthest = [&](const auto& distance) {
        int best = 0;
        for (int v = 1; v < count; ++v)
            if (distance(v) > distance(best)) best = v;
        return best;
    };
    const int a = 0, b = furthest([&](int v) { return glm::length(at(v) - at(a)); });
    const int c = furthest([&](int v) { return glm::length(glm::cross(at(v) - at(a), at(b) - at(a))); });
    return {a, b, c};
}

std::string inverseText(int vertices) {
    std::string out =
        concat("layout(std140) uniform Inverse { vec4 inverse[", corotatedBlockSize(vertices),
               "]; };\n\n// correction = A^-1 residual\nvoid applyInverse()\n{\n    mat3 b;\n"
               "    for (int i = 0; i < VERTICES; ++i) {\n        correction[i] = vec3(0.0);\n    }\n");
    for (int i = 0; i < vertices; ++i) {
        for (int j = 0; j <= i; ++j) {
            out += "    b = mat3(";
            for (int k = 0; k < 9; ++k)
                out += (k == 0 ? "" : ", ") + element(9 * blockNumber(i, j) + k);
            out += concat(");\n    correction[", i, "] += b * residual[", j, "];\n");
            if (i != j) out += concat("    correction[", j, "] += residual[", i, "] * b;\n");
        }
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
    const auto arm = [&](size_t v) {
        const glm::dvec3 p = molecule.vertices[v].position - centre;
        return concat("vec3(", glslLiteral(p.x), ", ", glslLiteral(p.y), ", ", glslLiteral(p.z), ")");
    };
    const auto share = [&](size_t v) { return glslLiteral(molecule.vertices[v].mass / total); };
    return glslArray("vec3", "restArm", count, arm) + glslArray("float", "massShare", count, share);
}

}  // namespace

int corotatedBlockSize(int vertices) {
    return (9 * vertices * (vertices + 1) / 2 + 3) / 4;
}

int largestCorotated(int blockBytes) {
    int vertices = 1;
    while (corotatedBlockSize(vertices + 1) * 16 <= blockBytes)
        ++vertices;
    return vertices;
}

std::vector<glm::vec4> corotatedInverse(const Molecule& molecule, const CorotatedStage& stage) {
    const int vertices = int(molecule.vertices.size());
    const auto pinned = [&](int v) { return stage.held && molecule.vertices[size_t(v)].pinned; };
    Eigen::MatrixXd matrix = stageMatrix(molecule, stage);
    for (int v = 0; v < vertices; ++v) {
        if (!pinned(v)) continue;
        matrix.middleRows<3>(3 * v).setZero();
        matrix.middleCols<3>(3 * v).setZero();
        matrix.block<3, 3>(3 * v, 3 * v).setIdentity();
    }
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
    matrix.llt().solveInPlace(inverse);
    for (int v = 0; v < vertices; ++v)
        if (pinned(v)) inverse.block<3, 3>(3 * v, 3 * v).setZero();
    std::vector<glm::vec4> out(size_t(corotatedBlockSize(vertices)), glm::vec4(0));
    for (int i = 0; i < vertices; ++i) {
        for (int j = 0; j <= i; ++j) {
            for (int k = 0; k < 9; ++k) {
                const int number = 9 * blockNumber(i, j) + k;
                out[size_t(number / 4)][number % 4] = float(inverse(3 * i + k % 3, 3 * j + k / 3));
            }
        }
    }
    return out;
}

std::string corotatedText(const Molecule& molecule, bool held) {
    const std::array<int, 3> fit = widestTriangle(molecule);
    const double size = molecule.size();
    return concat("#define FIT_A ", fit[0], "\n#define FIT_B ", fit[1], "\n#define FIT_C ", fit[2],
                  "\n#define STRAYS ", glslLiteral(0.03 * size), "\n#define SETTLED ",
                  glslLiteral(1e-12 * size * size), "\n#define SHARED_PINS ", held ? "true" : "false",
                  "\n\n") +
           restText(molecule) + "\nvec3 residual[VERTICES];    // N, in the rest shape's axes\n" +
           "vec3 correction[VERTICES];  // m, likewise\n" + inverseText(int(molecule.vertices.size()));
}

}  // namespace shoal
