#include "compile/school_plan.h"

#include <algorithm>
#include <cmath>

#include "compile/glsl_text.h"
#include "compile/plan.h"
#include "molecule/analysis.h"

namespace shoal {

namespace {

constexpr int64_t mostEntries = int64_t(1) << 26;

// Holds, for each vertex of the rest shape, its share of the mass, and that share times its z and y from the
// centre of mass.
struct Moments {
    std::vector<double> share, along, upward;
    double length = 0;  // m, along z
};

Moments momentsOf(const Molecule& molecule) {
    Moments out;
    double mass = 0;
    glm::dvec3 middle(0);
    double low = 1e300, high = -1e300;  // m
    for (const Vertex& vertex : molecule.vertices) {
        mass += vertex.mass;
        middle += vertex.position * vertex.mass;
        low = std::min(low, vertex.position.z);
        high = std::max(high, vertex.position.z);
    }
    middle /= mass;
    out.length = high - low;
    for (const Vertex& vertex : molecule.vertices) {
        const glm::dvec3 arm = vertex.position - middle;
        out.share.push_back(vertex.mass / mass);
        out.along.push_back(vertex.mass / mass * arm.z);
        out.upward.push_back(vertex.mass / mass * arm.y);
    }
    return out;
}

// Adds up the floats of one array of the state, straight on: `into` each sum, with its weights.
std::string sumText(const BufferLayout& layout, int firstElement,
                    const std::vector<std::pair<const char*, const std::vector<double>*>>& sums) {
    std::string out;
    const int floats = 3 * layout.vertexCount;
    for (int e = 0; e < layout.positionElements(); ++e) {
        out += concat("    e = element(oldState, first, ", firstElement + e, ");\n");
        for (int k = 4 * e; k < std::min(4 * e + 4, floats); ++k)
            for (const auto& [name, weights] : sums)
                if (const double weight = (*weights)[size_t(k / 3)]; weight != 0)
                    out += concat("    ", name, ".", "xyz"[k % 3], " += ", glslLiteral(weight), " * e.",
                                  "xyzw"[k - 4 * e], ";\n");
    }
    return out;
}

std::string bodyText(const Molecule& molecule, const BufferLayout& layout) {
    const Moments moments = momentsOf(molecule);
    std::string out =
        "// Means and moments by mass, of the places relative to the anchor and of the velocities.\n"
        "void addUp(int first, out vec3 middle, out vec3 along, out vec3 upward, out vec3 drift, out vec3 "
        "turning,\n           out vec3 rolling)\n{\n    vec4 e;\n    middle = along = upward = drift = "
        "turning = "
        "rolling = vec3(0.0);\n";
    out += sumText(layout, 0,
                   {{"middle", &moments.share}, {"along", &moments.along}, {"upward", &moments.upward}});
    out += sumText(layout, layout.positionElements(),
                   {{"drift", &moments.share}, {"turning", &moments.along}, {"rolling", &moments.upward}});
    return out + "}\n";
}

int powerOfTwo(int atLeast) {
    int out = 4;
    while (out < atLeast)
        out *= 2;
    return out;
}

class Planner {
  public:
    Planner(const Scene& scene, const std::vector<GroupPlan>& groups) : scene_(scene), groups_(groups) {}

    SchoolPlan plan() {
        for (size_t g = 0; g < groups_.size(); ++g)
            if (source(g).school) addMember(g);
        if (out_.any()) out_.origin = middle();
        return std::move(out_);
    }

  private:
    const Group& source(size_t g) const { return scene_.groups[groups_[g].index]; }

    void addMember(size_t g) {
        const School& school = *source(g).school;
        const Moments moments = momentsOf(source(g).molecule);
        SchoolMember member;
        member.group = g;
        member.school = school;
        member.length = moments.length;
        member.keel = !groups_[g].needs.directionalDrag;
        member.grid = addGrid(g, school.location);
        for (const auto* list : {&school.flees, &school.hunts})
            for (const SchoolTarget& target : *list)
                member.targetGrids.push_back(addGrid(groupNamed(target.group), target.location));
        out_.members.push_back(std::move(member));
    }

    size_t groupNamed(const std::string& name) const {
        for (size_t g = 0; g < groups_.size(); ++g)
            if (source(g).name == name) return g;
        throw Error(concat("there is no group \"", name, "\""));
    }

    size_t addGrid(size_t g, const Location& location) {
        addBodies(g);
        const int count = groups_[g].count;
        if (int64_t(out_.entries) + count > mostEntries)
            throw Error(location, concat("schools that look for more than ", mostEntries,
                                         " others in all cannot be counted"));
        SchoolGrid grid{g, count, out_.entries, powerOfTwo(count), out_.keys};
        out_.entries += count;
        out_.keys += grid.keys;
        out_.grids.push_back(grid);
        return out_.grids.size() - 1;
    }

    void addBodies(size_t g) {
        for (const SchoolBodies& bodies : out_.bodies)
            if (bodies.group == g) return;
        out_.bodies.push_back({g, out_.bodyCount, bodyText(source(g).molecule, groups_[g].layout())});
        out_.bodyCount += groups_[g].count;
    }

    // On the anchors' lattice, so that a difference to an anchor is exact.
    glm::dvec3 middle() const {
        glm::dvec3 low(1e300), high(-1e300);
        for (const SchoolBodies& bodies : out_.bodies)
            for (const glm::vec3& anchor : groups_[bodies.group].start.anchors) {
                low = glm::min(low, glm::dvec3(anchor));
                high = glm::max(high, glm::dvec3(anchor));
            }
        return low.x > high.x ? glm::dvec3(0) : glm::floor((low + high) * 8.0) / 16.0;
    }

    const Scene& scene_;
    const std::vector<GroupPlan>& groups_;
    SchoolPlan out_;
};

}  // namespace

const SchoolBodies& SchoolPlan::bodiesOf(size_t group) const {
    return *std::find_if(bodies.begin(), bodies.end(),
                         [group](const SchoolBodies& candidate) { return candidate.group == group; });
}

const SchoolMember* SchoolPlan::memberOf(size_t group) const {
    const auto found = std::find_if(members.begin(), members.end(),
                                    [group](const SchoolMember& member) { return member.group == group; });
    return found == members.end() ? nullptr : &*found;
}

SchoolPlan planSchools(const Scene& scene, const std::vector<GroupPlan>& groups) {
    return Planner(scene, groups).plan();
}

double bendOf(const Molecule& molecule, const Spring& spring) {
    return spring.actuation ? bendReach(molecule, spring) : 0;
}

}  // namespace shoal
