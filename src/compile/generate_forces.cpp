#include "compile/generate_forces.h"

#include "compile/generate.h"
#include "compile/pack.h"

namespace shoal {

namespace {

class ForceWriter {
  public:
    GroupForces result;
    std::string pulls, thrusts, anyThrusts;  // statements

    void add(const Force& force, size_t index) {
        comment_ = concat("    // ", kindName(force.shape), " ", inComment(force.name), "\n");
        const GroupForces::One one{index, result.parameterCount};
        std::visit([&](const auto& kind) { add(kind, one, isFar(force)); }, force.shape);
    }

    std::string slot() { return concat("forceParameters[", result.parameterCount++, "]"); }

  private:
    void add(const WindForce&, const GroupForces::One& one, bool) { result.winds.push_back(one); }

    void add(const ThrustForce&, const GroupForces::One& one, bool) {
        result.thrusts.push_back(one);
        const std::string a = slot();
        thrusts += concat(comment_, "    velocity *= thrustFactor(velocity, whole ? ", a, ".x : ", a, ".y, ",
                          a, ".z);\n");
        anyThrusts += concat("    velocity *= thrustFactor(velocity, exp(", a, ".w * time), ", a, ".z);\n");
    }

    // Every other kind is an acceleration, whose call `emit` writes.
    template <typename Pull>
    void add(const Pull& pull, const GroupForces::One& one, bool far) {
        result.pulls.push_back(one);
        pulls += concat(comment_, "    a += ", emit(pull, far), ";\n");
    }

    // Takes one more slot of what is far.
    std::string relative(const std::string& position, bool far) {
        const std::string from = far ? concat("(anchor - ", slot(), ".xyz)") : "anchor";
        return concat("(", from, " - ", position, ".xyz) + position");
    }

    std::string emit(const AttractForce& force, bool far) {
        const std::string at = slot(), size = slot(), x = relative(at, far);
        if (force.falloff == AttractForce::Falloff::constant)
            return concat("constantPull(", x, ", ", at, ".w, ", size, ".x)");
        return concat("inverseSquarePull(", x, ", ", at, ".w, ", size, ".x, ", size, ".y)");
    }

    std::string emit(const VortexLineForce&, bool far) {
        const std::string at = slot(), axis = slot(), size = slot();
        return concat("vortexLinePull(", relative(at, far), ", ", axis, ".xyz, ", at, ".w, ", axis, ".w, ",
                      size, ".x, ", size, ".y)");
    }

    std::string comment_;
};

}  // namespace

GroupForces generateForces(const std::vector<Force>& forces, const std::string& group, bool dragged) {
    ForceWriter writer;
    for (size_t i = 0; i < forces.size(); ++i) {
        const bool idle = std::holds_alternative<WindForce>(forces[i].shape) && !dragged;
        if (actsOn(forces[i], group) && !idle) writer.add(forces[i], i);
    }
    writer.result.windSlot = writer.result.parameterCount;
    std::string wind;
    if (!writer.result.winds.empty())
        wind = concat("\nvec3 forceWind()\n{\n    return ", writer.slot(), ".xyz;\n}\n");
    GroupForces out = std::move(writer.result);
    if (!out.any()) return out;
    out.source =
        concat("#include \"physics/force.glsl\"\n", parameterArray("forceParameters", out.parameterCount));
    if (!out.pulls.empty())
        out.source +=
            concat("vec3 forceAcceleration(vec3 anchor, vec3 position)\n{\n    vec3 a = vec3(0.0);\n",
                   writer.pulls, "    return a;\n}\n");
    if (!out.thrusts.empty())
        out.source +=
            concat("\nvec3 thrustedVelocity(vec3 velocity, bool whole)\n{\n", writer.thrusts,
                   "    return velocity;\n}\n\n", "vec3 thrustedOver(vec3 velocity, float time)\n{\n",
                   writer.anyThrusts, "    return velocity;\n}\n");
    out.source += wind;
    return out;
}

}  // namespace shoal
