#include "molecule/skin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "molecule/linearised.h"

namespace shoal {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double mostWeight = 3;  // above, a direction that the vertices hardly span is left to the offset
constexpr double thin = 0.05;     // such a direction: its extent by the largest
constexpr double exact = 1e-7;    // of the molecule's size
constexpr double leastNormal = 0.1;
constexpr double mostLift = 0.1;  // of the size: further off, a normal that turns swings the skin about

// Holds the vertices that a skin vertex can be bound to, and the kernel at each.
struct Neighbours {
    std::vector<int> vertices;
    std::vector<double> kernel;  // above 0
};

double kernelAt(double distance, double reach) {
    const double t = std::min(distance / reach, 1.0), s = 1 - t * t;
    return std::max(s * s, 1e-8);
}

using Ranking = std::vector<std::pair<double, int>>;  // distance from a point, vertex

Ranking ranked(const Molecule& molecule, const glm::dvec3& point) {
    Ranking all;
    for (size_t i = 0; i < molecule.vertices.size(); ++i)
        all.emplace_back(glm::distance(molecule.vertices[i].position, point), int(i));
    std::sort(all.begin(), all.end());
    return all;
}

Neighbours nearest(const Ranking& all) {
    const size_t count = std::min(all.size(), size_t(Skin::mostWeights));
    // If no vertex is left out, there is none at which the kernel has to fall to 0.
    const double reach = all.size() > count ? all[count].first : 2 * all[count - 1].first;
    Neighbours out;
    for (size_t i = 0; i < count; ++i) {
        out.vertices.push_back(all[i].second);
        out.kernel.push_back(reach > 0 ? kernelAt(all[i].first, reach) : 1);
    }
    return out;
}

// Chooses neighbours where the nearest vertices lie in a plane, on a line, or close together: the nearest
// one, then those needed to span space as far as the point is away, then the nearest of the rest.
Neighbours spanning(const Molecule& molecule, Ranking all) {
    const auto place = [&](size_t i) { return molecule.vertices[size_t(all[i].second)].position; };
    const glm::dvec3 first = place(0);
    std::vector<glm::dvec3> axes;
    for (size_t chosen = 1; chosen < std::min<size_t>(4, all.size()); ++chosen) {
        size_t best = chosen;
        double most = -1;
        for (size_t i = chosen; i < all.size(); ++i) {
            const glm::dvec3 way = place(i) - first;
            glm::dvec3 across = way;
            for (const glm::dvec3& axis : axes)
                across -= glm::dot(across, axis) * axis;
            const double height = glm::length(across);
            if (height > most) most = height, best = i;
            if (height > 0.3 * glm::length(way) && height > 0.5 * all[0].first) break;
        }
        glm::dvec3 axis = place(best) - first;
        for (const glm::dvec3& other : axes)
            axis -= glm::dot(axis, other) * other;
        axes.push_back(unit(axis));
        std::rotate(all.begin() + std::ptrdiff_t(chosen), all.begin() + std::ptrdiff_t(best),
                    all.begin() + std::ptrdiff_t(best) + 1);
    }
    all.resize(std::min(all.size(), size_t(Skin::mostWeights)));
    const double reach = 2 * std::max_element(all.begin(), all.end())->first;
    Neighbours out;
    for (const auto& [distance, vertex] : all) {
        out.vertices.push_back(vertex);
        out.kernel.push_back(reach > 0 ? kernelAt(distance, reach) : 1);
    }
    return out;
}

// Returns the weights with which linear functions f add up to constant f + slope . gradient f at `point`:
// their sum is `constant`, the sum of weight x (from the point) is `slope`. Directions that the vertices span
// less than `least` of the widest are left out.
VectorXd weightsFor(const Molecule& molecule, const Neighbours& near, const Vector3d& point, double constant,
                    const Vector3d& slope, double least) {
    const auto count = Eigen::Index(near.vertices.size());
    // about the weighted middle, so that what is constant and what is linear are apart
    Vector3d middle = Vector3d::Zero();
    double total = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
        const double k = near.kernel[size_t(i)];
        middle += k * toEigen(molecule.vertices[size_t(near.vertices[size_t(i)])].position);
        total += k;
    }
    middle /= total;
    MatrixXd rows(3, count);  // root of the kernel times the place
    VectorXd roots(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        roots(i) = std::sqrt(near.kernel[size_t(i)]);
        rows.col(i) =
            roots(i) * (toEigen(molecule.vertices[size_t(near.vertices[size_t(i)])].position) - middle);
    }
    const Eigen::JacobiSVD<MatrixXd> svd(rows, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const VectorXd& sizes = svd.singularValues();
    const Vector3d target = slope + constant * (point - middle);
    VectorXd out = roots * (constant / total);
    for (Eigen::Index i = 0; i < sizes.size(); ++i)
        if (sizes(i) > least * sizes(0) && sizes(i) > 0)
            out += svd.matrixV().col(i) * (svd.matrixU().col(i).dot(target) / sizes(i));
    return out.cwiseProduct(roots);
}

glm::dvec3 sum(const Neighbours& near, const VectorXd& weights, const std::vector<glm::dvec3>& values) {
    glm::dvec3 out(0);
    for (size_t i = 0; i < near.vertices.size(); ++i)
        out += weights(Eigen::Index(i)) * values[size_t(near.vertices[i])];
    return out;
}

// Holds the positions and normals of a molecule's vertices at rest, and its size.
struct Rest {
    std::vector<glm::dvec3> positions, normals;
    double size;

    explicit Rest(const Molecule& molecule) : size(molecule.size()) {
        for (const Vertex& vertex : molecule.vertices)
            positions.push_back(vertex.position);
        normals = vertexNormals(molecule, positions);
    }
};

double rounded(double value, double digits) {
    return std::round(value * digits) / digits;
}

void store(const Neighbours& near, const VectorXd& weights, SkinVertex& out) {
    constexpr double digits = 1e7;
    double rest = 1;
    size_t largest = 0;
    for (size_t i = 0; i < near.vertices.size(); ++i) {
        const double weight = rounded(weights(Eigen::Index(i)), digits);
        if (weight == 0) continue;
        out.weights.push_back({near.vertices[i], weight});
        rest -= weight;
        if (std::abs(weight) > std::abs(out.weights[largest].weight)) largest = out.weights.size() - 1;
    }
    out.weights[largest].weight = rounded(out.weights[largest].weight + rest, digits);
}

// Binds a point to vertices in one way.
struct Hanging {
    Neighbours near;
    VectorXd weights;
    double offset = 0;
    double left = 0;  // m, how far off the point it is at rest

    Hanging(const Molecule& molecule, const Rest& rest, Neighbours on, const glm::dvec3& point, bool lifted)
        : near(std::move(on)),
          weights(weightsFor(molecule, near, toEigen(point), 1, Vector3d::Zero(), lifted ? thin : 1e-9)) {
        glm::dvec3 missing = point - sum(near, weights, rest.positions);
        if (lifted) {
            const glm::dvec3 normal = sum(near, weights, rest.normals);
            // where normals cancel out, the rounding of weights turns what is left of them
            offset = glm::length(normal) > leastNormal ? glm::dot(missing, unit(normal)) : 0;
            missing -= offset * unit(normal);
        }
        left = glm::length(missing);
    }
    bool reaches(const Rest& rest) const { return left <= exact * rest.size; }
    double most() const { return weights.cwiseAbs().maxCoeff(); }
};

Hanging hang(const Molecule& molecule, const Rest& rest, const glm::dvec3& point) {
    const Ranking all = ranked(molecule, point);
    Hanging plain(molecule, rest, nearest(all), point, false);
    const bool reaches = plain.reaches(rest);
    if (reaches && plain.most() <= mostWeight) return plain;
    Hanging lifted(molecule, rest, nearest(all), point, true);
    const bool lifts = lifted.reaches(rest);
    if (lifts && lifted.most() <= mostWeight && std::abs(lifted.offset) <= mostLift * rest.size)
        return lifted;
    Hanging wide(molecule, rest, spanning(molecule, all), point, false);
    if (wide.reaches(rest) && !(reaches && plain.most() < wide.most())) return wide;
    return reaches && !lifts ? plain : lifted;
}

SkinVertex bind(const Molecule& molecule, const Rest& rest, const glm::dvec3& point) {
    const Hanging hanging = hang(molecule, rest, point);
    SkinVertex out;
    store(hanging.near, hanging.weights, out);
    // shorter than rounding leaves it
    if (std::abs(hanging.offset) > exact * rest.size) out.offset = hanging.offset;
    return out;
}

// Skin vertices in one place.
std::vector<std::vector<size_t>> places(const Skin& skin) {
    std::map<std::tuple<double, double, double>, std::vector<size_t>> found;
    glm::dvec3 low(1e300), high(-1e300);
    for (const SkinVertex& v : skin.vertices)
        low = glm::min(low, v.position), high = glm::max(high, v.position);
    // Copies of a vertex are bound alike, and differ by nothing; from other hands, by rounding.
    const double cell = std::max(1e-5 * glm::distance(low, high), 1e-300);
    for (size_t i = 0; i < skin.vertices.size(); ++i) {
        const glm::dvec3 c = glm::round((skin.vertices[i].position - low) / cell);
        found[{c.x, c.y, c.z}].push_back(i);
    }
    std::vector<std::vector<size_t>> out;
    out.reserve(found.size());
    for (auto& [place, vertices] : found)
        out.push_back(std::move(vertices));
    return out;
}

}  // namespace

Skin bindSkin(const Molecule& molecule, const SkinMesh& mesh) {
    const Rest rest(molecule);
    Molecule bound;
    bound.vertices = molecule.vertices;
    bound.triangles = molecule.triangles;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        SkinVertex vertex = bind(molecule, rest, mesh.positions[i]);
        constexpr double digits = 1e6;
        vertex.uv = {rounded(mesh.uvs[i].x, digits), rounded(mesh.uvs[i].y, digits)};
        bound.skin.vertices.push_back(std::move(vertex));
    }
    bound.skin.triangles = mesh.triangles;
    placeSkin(bound);
    return std::move(bound.skin);
}

void rebindSkin(Molecule& molecule) {
    SkinMesh mesh;
    for (const SkinVertex& vertex : molecule.skin.vertices) {
        mesh.positions.push_back(vertex.position);
        mesh.uvs.push_back(vertex.uv);
    }
    mesh.triangles = molecule.skin.triangles;
    molecule.skin = bindSkin(molecule, mesh);
}

std::vector<glm::dvec3> skinNormals(const Skin& skin) {
    constexpr double crease = 0.766;  // cosine of 40 degrees
    std::vector<glm::dvec3> own(skin.vertices.size(), glm::dvec3(0));
    for (const SkinTriangle& t : skin.triangles) {
        const int corners[] = {t.a, t.b, t.c};
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3& point = skin.vertices[size_t(corners[i])].position;
            const glm::dvec3 next = skin.vertices[size_t(corners[(i + 1) % 3])].position - point;
            const glm::dvec3 last = skin.vertices[size_t(corners[(i + 2) % 3])].position - point;
            const glm::dvec3 across = glm::cross(next, last);
            // by its angle, as for models (geometry/mesh.cpp)
            own[size_t(corners[i])] += unit(across) * std::atan2(glm::length(across), glm::dot(next, last));
        }
    }
    std::vector<glm::dvec3> out(own.size());
    for (const std::vector<size_t>& place : places(skin))
        for (const size_t i : place) {
            glm::dvec3 all(0);
            for (const size_t j : place)
                if (i == j || glm::dot(unit(own[i]), unit(own[j])) > crease) all += own[j];
            out[i] = glm::length(all) > 0 ? unit(all) : glm::dvec3(0, 1, 0);
        }
    return out;
}

std::vector<SkinFrame> skinFrames(const Molecule& molecule) {
    const Rest rest(molecule);
    const std::vector<glm::dvec3> normals = skinNormals(molecule.skin);
    std::vector<SkinFrame> out;
    for (size_t i = 0; i < normals.size(); ++i) {
        const SkinVertex& vertex = molecule.skin.vertices[i];
        const glm::dvec3 n = normals[i];
        const glm::dvec3 t =
            unit(glm::cross(std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), n));
        const glm::dvec3 b = glm::cross(n, t);
        Neighbours near;
        double farthest = 0;
        for (const SkinWeight& w : vertex.weights) {
            near.vertices.push_back(w.vertex);
            farthest = std::max(farthest, glm::distance(rest.positions[size_t(w.vertex)], vertex.position));
        }
        VectorXd weights(Eigen::Index(vertex.weights.size()));
        for (size_t k = 0; k < vertex.weights.size(); ++k) {
            const double d = glm::distance(rest.positions[size_t(near.vertices[k])], vertex.position);
            near.kernel.push_back(farthest > 0 ? kernelAt(d, 1.1 * farthest) : 1);
            weights(Eigen::Index(k)) = vertex.weights[k].weight;
        }
        const glm::dvec3 normal = unit(sum(near, weights, rest.normals));
        const auto slope = [&](const glm::dvec3& tangent, std::vector<double>& to, double& offset) {
            const VectorXd solved = weightsFor(molecule, near, toEigen(vertex.position), 0, toEigen(tangent),
                                               vertex.offset == 0 ? 1e-6 : thin);
            offset = glm::dot(tangent - sum(near, solved, rest.positions), normal);
            if (std::abs(offset) < 1e-5) offset = 0;
            to.assign(solved.data(), solved.data() + solved.size());
        };
        SkinFrame frame;
        slope(t, frame.along, frame.alongOffset);
        slope(b, frame.across, frame.acrossOffset);
        out.push_back(std::move(frame));
    }
    return out;
}

namespace {

glm::dvec3 sum(const std::vector<SkinWeight>& weights, const std::vector<glm::dvec3>& values) {
    glm::dvec3 out(0);
    for (const SkinWeight& w : weights)
        out += w.weight * values[size_t(w.vertex)];
    return out;
}

}  // namespace

void sumNormals(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                std::vector<glm::dvec3>& out) {
    out.assign(positions.size(), glm::dvec3(0));
    for (const Triangle& t : molecule.triangles) {
        const glm::dvec3 a = positions[size_t(t.a)];
        const glm::dvec3 area = glm::cross(positions[size_t(t.b)] - a, positions[size_t(t.c)] - a);
        for (const int corner : {t.a, t.b, t.c})
            out[size_t(corner)] += area;
    }
    for (glm::dvec3& n : out)
        n = unit(n);
}

std::vector<glm::dvec3> vertexNormals(const Molecule& molecule, const std::vector<glm::dvec3>& positions) {
    std::vector<glm::dvec3> out;
    sumNormals(molecule, positions, out);
    return out;
}

std::vector<glm::dvec3> skinPositions(const Molecule& molecule, const std::vector<glm::dvec3>& positions) {
    const std::vector<glm::dvec3> normals = vertexNormals(molecule, positions);
    std::vector<glm::dvec3> out;
    for (const SkinVertex& vertex : molecule.skin.vertices) {
        glm::dvec3 position = sum(vertex.weights, positions);
        if (vertex.offset != 0) position += vertex.offset * unit(sum(vertex.weights, normals));
        out.push_back(position);
    }
    return out;
}

std::vector<glm::dvec3> skinNormals(const Molecule& molecule, const std::vector<SkinFrame>& frames,
                                    const std::vector<glm::dvec3>& positions) {
    const std::vector<glm::dvec3> normals = vertexNormals(molecule, positions);
    std::vector<glm::dvec3> out;
    for (size_t i = 0; i < frames.size(); ++i) {
        const std::vector<SkinWeight>& weights = molecule.skin.vertices[i].weights;
        const SkinFrame& frame = frames[i];
        const glm::dvec3 outward = unit(sum(weights, normals));
        glm::dvec3 along = frame.alongOffset * outward, across = frame.acrossOffset * outward;
        for (size_t k = 0; k < weights.size(); ++k) {
            along += frame.along[k] * positions[size_t(weights[k].vertex)];
            across += frame.across[k] * positions[size_t(weights[k].vertex)];
        }
        out.push_back(unit(glm::cross(along, across)));
    }
    return out;
}

void placeSkin(Molecule& molecule) {
    std::vector<glm::dvec3> rest;
    for (const Vertex& vertex : molecule.vertices)
        rest.push_back(vertex.position);
    const std::vector<glm::dvec3> places = skinPositions(molecule, rest);
    for (size_t i = 0; i < places.size(); ++i)
        molecule.skin.vertices[i].position = places[i];
}

}  // namespace shoal
