#include "compile/generate_forces.h"

#include "compile/call_writer.h"
#include "compile/generate.h"
#include "compile/pack.h"
#include "scene/force_kinds.h"

namespace shoal {

namespace {

class ForceWriter {
  public:
    GroupForces result;
    std::string pulls, thrusts, anyThrusts;  // statements

    void add(const Force& force, size_t index) {
        const GroupForces::Entry entry{index, result.parameterCount};
        std::visit([&](const auto& kind) { add(kind, entry, isFar(force)); }, *force.shape);
    }

    std::string slot() { return concat("forceParameters[", result.parameterCount++, "]"); }

  private:
    void add(const WindForce&, const GroupForces::Entry& entry, bool) { result.winds.push_back(entry); }

    void add(const ThrustForce&, const GroupForces::Entry& entry, bool) {
        result.thrusts.push_back(entry);
        const std::string a = slot();
        thrusts +=
            concat("    velocity *= thrustFactor(velocity, whole ? ", a, ".x : ", a, ".y, ", a, ".z);\n");
        anyThrusts += concat("    velocity *= thrustFactor(velocity, exp(", a, ".w * time), ", a, ".z);\n");
    }

    // Every other kind is an acceleration that depends on the place.
    template <typename Pull>
    void add(const Pull& pull, const GroupForces::Entry& entry, bool far) {
        result.pulls.push_back(entry);
        CallWriter writer("forceParameters[#]", entry.slot);
        pulls += concat("    a += ", writer.text(pull.call(), far), ";\n");
        result.parameterCount += writer.parameters.size();
    }
};

}  // namespace

GroupForces generateForces(const std::vector<Force>& forces, const std::string& group, bool dragged) {
    ForceWriter writer;
    for (size_t i = 0; i < forces.size(); ++i) {
        const bool idle = std::holds_alternative<WindForce>(*forces[i].shape) && !dragged;
        if (actsOn(forces[i], group) && !idle) writer.add(forces[i], i);
    }
    writer.result.windSlot = writer.result.parameterCount;
    const std::string wind =
        concat("\nvec3 withWind(vec3 velocity)\n{\n    return velocity",
               writer.result.winds.empty() ? "" : concat(" + ", writer.slot(), ".xyz"), ";\n}\n");
    GroupForces out = std::move(writer.result);
    if (out.any())
        out.source = concat("#include \"physics/force.glsl\"\n",
                            parameterArray("forceParameters", out.parameterCount));
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
