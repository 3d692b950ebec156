#include "compile/kernel.h"

#include <algorithm>
#include <functional>
#include <numbers>

#include "compile/clocks.h"
#include "compile/corotated.h"
#include "compile/generate.h"
#include "compile/glsl_text.h"
#include "compile/group_state.h"
#include "compile/muscle_waves.h"
#include "compile/school_plan.h"
#include "core/error.h"

namespace shoal {

namespace {

std::string element(const char* array, int index) {
    return concat(array, "[", index, "]");
}

std::string moleculeText(const Molecule& molecule, const Needs& needs) {
    const size_t count = molecule.vertices.size();
    std::string out = glslArray("float", "inverseMass", count,
                                [&](size_t v) { return glslLiteral(1 / molecule.vertices[v].mass); });
    out += glslArray("bool", "pinned", count, [&](size_t v) {
        return std::string(needs.pins && molecule.vertices[v].pinned ? "true" : "false");
    });
    if (needs.life)
        out += glslArray("vec3", "restPlace", count,
                         [&](size_t v) { return glslLiteral(molecule.vertices[v].position); });
    out +=
        "\n// N: the strongest pull of the springs on a pin.\nfloat pullOnPins()\n{\n    float pull = 0.0;\n";
    for (size_t v = 0; v < count && needs.release && needs.springs; ++v)
        if (molecule.vertices[v].pinned) out += concat("    pull = max(pull, length(force[", v, "]));\n");
    out += "    return pull;\n}\n";
    out += "\nvec3 meanProbe()\n{\n    vec3 sum = probe[0];\n";
    for (size_t v = 1; v < count; ++v)
        out += concat("    sum += probe[", v, "];\n");
    out += concat("    return sum * ", glslLiteral(1 / double(count)), ";\n}\n");
    if (!needs.thrust && !needs.steers) return out;
    const double mass = molecule.mass();
    // The mean over the vertices by mass: each product in a register, or Mesa would take equal shares out of
    // the sum and round otherwise than a loop does.
    const auto mean = [&](const char* name, const char* array) {
        std::string text = concat("\nvec3 ", name, "()\n{\n    vec3 sum = vec3(0.0);\n");
        for (size_t v = 0; v < count; ++v)
            text += concat("    sum += inRegister(", array, "[", v, "] * ",
                           glslLiteral(molecule.vertices[v].mass / mass), ");\n");
        return text + "    return sum;\n}\n";
    };
    if (needs.thrust) out += mean("meanVelocity", "w");
    if (needs.steers) out += mean("steeredMiddle", "probe");
    return out;
}

// Holds the GLSL of a spring's numbers: constants, or reads of what springNumbers() returns.
struct SpringText {
    std::string load;  // a line before; may be empty
    std::string stiffness, damping, restLength;
    bool damped = true;
};

const char* phaseText(const Needs& needs) {
    return needs.phase ? "phase" : "0.0";
}

SpringText liveText(const Molecule& molecule, size_t index, const Needs& needs) {
    const double bend = needs.steers ? bendOf(molecule, molecule.springs[index]) : 0;
    SpringText out;
    out.load = concat("    s = texelFetch(liveSprings, ivec2(", 2 * index,
                      ", 0), 0);\n    m = texelFetch(liveSprings, ivec2(", 2 * index + 1, ", 0), 0);\n");
    out.stiffness = "s.x";
    out.damping = "s.y";
    out.restLength = concat("bentLength(s.z", needs.scale ? " * scale" : "", ", musclePull(m.xyz, ",
                            needs.steers ? "0.0, swimClock(time), " : "m.w, time, ", phaseText(needs), "), ",
                            bend != 0 ? concat(glslLiteral(bend), " * curvature)") : "0.0)");
    return out;
}

std::string restLength(const Molecule& molecule, const Spring& spring, const Needs& needs) {
    std::string length = glslLiteral(molecule.restLength(spring));
    if (needs.scale) length += " * scale";
    if (needs.steers) return MuscleWaves(molecule, needs).lengthOf(length, spring);
    if (!spring.actuation || spring.actuation->amplitude == 0) return length;
    const Actuation& muscle = *spring.actuation;
    const size_t number = muscleNumber(muscleFrequencies(molecule), spring);
    return concat("bentLength(", length, ", musclePull(vec3(", glslLiteral(muscle.amplitude), ", ",
                  glslLiteral(2 * std::numbers::pi * muscle.frequency), ", ", glslLiteral(muscle.phase),
                  "), muscleAngles[", number / 4, "].", "xyzw"[number % 4], ", time, ", phaseText(needs),
                  "), 0.0)");
}

SpringText numbersOf(const Molecule& molecule, size_t index, const Needs& needs) {
    if (needs.liveSprings) return liveText(molecule, index, needs);
    const Spring& spring = molecule.springs[index];
    SpringText out;
    out.stiffness = glslLiteral(spring.stiffness);
    out.damping = glslLiteral(spring.damping);
    out.restLength = restLength(molecule, spring, needs);
    out.damped = spring.damping > 0;
    return out;
}

const char* springVariables(const Needs& needs) {
    return needs.liveSprings ? "    vec4 s;\n    vec4 m;\n" : "";
}

// The force of a spring, added to its ends: of the way between these, and of their relative velocity.
std::string forceText(const Spring& spring, const SpringText& numbers, const std::string& way,
                      const std::string& relative) {
    return concat(numbers.load, "    f = sprung(", way, ", ", numbers.damped ? relative : "vec3(0.0)", ", ",
                  numbers.stiffness, ", ", numbers.damping, ", ", numbers.restLength, ", ",
                  element("inverseMass", spring.a), " + ", element("inverseMass", spring.b), ");\n    ",
                  element("force", spring.a), " += f;\n    ", element("force", spring.b), " -= f;\n");
}

std::string springText(const Molecule& molecule, const Needs& needs) {
    std::string out = concat(
        "// Of all springs, on all vertices, from x and w; time for the muscles.\n"
        "void springForces(float time)\n{\n"
        "    for (int i = 0; i < VERTICES; ++i) {\n        force[i] = vec3(0.0);\n    }\n    vec3 f;\n",
        springVariables(needs), MuscleWaves(molecule, needs).text());
    for (size_t i = 0; i < molecule.springs.size(); ++i) {
        const Spring& spring = molecule.springs[i];
        out += forceText(spring, numbersOf(molecule, i, needs),
                         concat(element("x", spring.a), " - ", element("x", spring.b)),
                         concat(element("w", spring.a), " - ", element("w", spring.b)));
    }
    return out + "}\n";
}

// One Gauss-Seidel sweep over the springs, in their order or against it.
std::string sweepText(const Molecule& molecule, const Needs& needs, bool forward) {
    std::string out =
        concat("\nvoid relax", forward ? "Forward" : "Backward", "(float time, float inverseEta)\n{\n",
               springVariables(needs), MuscleWaves(molecule, needs).text());
    const size_t count = molecule.springs.size();
    const std::vector<size_t> order = sweepOrder(molecule);
    for (size_t i = 0; i < count; ++i) {
        const size_t index = order[forward ? i : count - 1 - i];
        const Spring& spring = molecule.springs[index];
        const SpringText numbers = numbersOf(molecule, index, needs);
        out += numbers.load;
        if (forward) out += concat("    lambda[", index, "] = 0.0;\n");
        out += concat("    relax(RELAXED(", spring.a, ", ", spring.b, "), lambda[", index, "], ",
                      numbers.stiffness, ", ", numbers.damping, ", ", numbers.restLength, ", inverseEta);\n");
    }
    return out + "}\n";
}

// The springs' forces inside a stage.
std::string stageText(const Molecule& molecule, const Needs& needs) {
    std::string out =
        "\n// Adds the springs' forces at x + q, with the stage's velocity.\n"
        "void stageForces(float time, float inverseEta)\n{\n    vec3 f;\n";
    out += MuscleWaves(molecule, needs).text();
    for (size_t i = 0; i < molecule.springs.size(); ++i) {
        const Spring& spring = molecule.springs[i];
        const std::string a = concat("[", spring.a, "]"), b = concat("[", spring.b, "]");
        out += forceText(spring, numbersOf(molecule, i, needs),
                         concat("(x", a, " - x", b, ") + (q", a, " - q", b, ")"),
                         concat("((q", a, " - q", b, ") - (z", a, " - z", b, ")) * inverseEta"));
    }
    return out + "}\n";
}

std::string normalText(const Molecule& molecule) {
    std::string out =
        "\n// Unit normals of the surface through the probes.\nvoid surfaceNormals()\n{\n"
        "    for (int i = 0; i < VERTICES; ++i) {\n        normal[i] = vec3(0.0);\n    }\n    vec3 n;\n";
    std::vector<bool> covered(molecule.vertices.size());
    for (const Triangle& t : molecule.triangles) {
        out += concat("    n = areaVector(", element("probe", t.b), " - ", element("probe", t.a), ", ",
                      element("probe", t.c), " - ", element("probe", t.a), ");\n");
        for (const int corner : {t.a, t.b, t.c}) {
            out += concat("    ", element("normal", corner), " += n;\n");
            covered[size_t(corner)] = true;
        }
    }
    for (size_t v = 0; v < covered.size(); ++v)
        if (covered[v]) out += concat("    normal[", v, "] = unitNormal(normal[", v, "]);\n");
    return out + "}\n";
}

// "x[1].yz" for floats `from` to `to` of the vertices' floats in a row, all of one vertex.
std::string components(const char* array, int from, int to) {
    static constexpr const char* names[] = {"x", "y", "z"};
    std::string out = concat(array, "[", from / 3, "]");
    if (to - from == 3) return out;
    out += ".";
    for (int k = from; k < to; ++k)
        out += names[k % 3];
    return out;
}

// The floats of 4-vector e, cut where a vertex ends: calls visit(first float, last + 1).
template <typename Visit>
void forEachPart(int e, int floats, Visit visit) {
    for (int from = 4 * e; from < std::min(4 * e + 4, floats);) {
        const int to = std::min({from - from % 3 + 3, 4 * e + 4, floats});
        visit(from, to);
        from = to;
    }
}

// `last`: what the w of the last 4-vector holds, where the vertices leave it free; or null.
std::string loadText(const char* array, int firstElement, int elements, int floats,
                     const char* last = nullptr) {
    std::string out;
    for (int e = 0; e < elements; ++e) {
        out += concat("    e = element(oldState, first, ", firstElement + e, ");\n");
        forEachPart(e, floats, [&](int from, int to) {
            out += concat("    ", components(array, from, to), " = e.",
                          std::string("xyzw").substr(size_t(from - 4 * e), size_t(to - from)), ";\n");
        });
    }
    if (last) out += concat("    ", last, " = e.w;\n");
    return out;
}

std::string loadText(const BufferLayout& layout, const char* age, const char* span) {
    const int elements = layout.positionElements(), floats = 3 * layout.vertexCount;
    std::string out =
        "void loadState(int molecule)\n{\n"
        "    int first = firstElement(molecule, STATE_ELEMENTS);\n    vec4 e;\n";
    out += loadText("x", 0, elements, floats, age) + loadText("v", elements, elements, floats, span);
    if (layout.history)
        out +=
            loadText("dx", 2 * elements, elements, floats) + loadText("dv", 3 * elements, elements, floats);
    if (layout.lifeApart())
        out += concat("    e = element(oldState, first, ", layout.stateElements() - 1,
                      ");\n    age = e.x;\n    span = e.y;\n");
    return out + "}\n";
}

// Adds the 4-vectors that hold an array's floats.
void addElements(const char* array, const BufferLayout& layout, const char* last,
                 std::vector<std::string>& out) {
    const int floats = 3 * layout.vertexCount;
    for (int e = 0; e < layout.positionElements(); ++e) {
        std::string parts;
        forEachPart(e, floats, [&](int from, int to) {
            parts += (parts.empty() ? "" : ", ") + components(array, from, to);
        });
        for (int k = floats; k < 4 * e + 4; ++k)
            parts += concat(", ", last && k == 4 * e + 3 ? last : "0.0");
        out.push_back(concat("vec4(", parts, ")"));
    }
}

void addPacking(const Molecule& molecule, const Needs& needs, bool history, KernelText& out) {
    const BufferLayout layout{int(molecule.vertices.size()), history, needs.life};
    const bool inside = layout.life && !layout.lifeApart();
    const char *const age = inside ? "age" : nullptr, *const span = inside ? "span" : nullptr;
    out.load = loadText(layout, age, span);
    addElements("x", layout, age, out.state);
    addElements("v", layout, span, out.state);
    if (history) {
        addElements("dx", layout, nullptr, out.state);
        addElements("dv", layout, nullptr, out.state);
    }
    if (layout.lifeApart()) out.state.emplace_back("vec4(age, span, 0.0, 0.0)");
    if (needs.normals) addElements("normal", layout, nullptr, out.normals);
}

// A choice of one of several texts by `stage`.
std::string byStage(int stages, const std::function<std::string(int)>& text) {
    std::string out;
    for (int s = 0; s < stages; ++s)
        out += s + 1 < stages ? concat("stage == ", s, " ? ", text(s), " : ") : text(s);
    return out;
}

// stageTime: when a stage takes its rates, s after the substep's start. shareOf: of its rates in the substep.
// afterStage: where it leads, to the next or to the substep's end; sum: of shareOf(s) times the rates of
// stages s.
std::string stagesText(const Tableau& tableau) {
    const auto times = [](double factor, const std::string& what) {
        return factor == 1 ? what : concat(glslLiteral(factor), " * ", what);
    };
    const auto lead = [&](int s) {
        const auto [rate, sum] = tableau.way(s);
        if (sum == 0) return concat("rate * (", times(rate, "substep"), ")");
        if (rate == 0) return concat("sum * (", times(sum, "substep"), ")");
        return concat("(", times(rate, "rate"), " + ", times(sum, "sum"), ") * substep");
    };
    const auto function = [&](const char* head, const std::function<std::string(int)>& text) {
        return concat(head, "\n{\n    return ", byStage(tableau.stages, text), ";\n}\n\n");
    };
    return function("float stageTime(int stage)", [&](int s) { return times(tableau.time(s), "substep"); }) +
           function("float shareOf(int stage)", [&](int s) { return glslLiteral(tableau.b[s]); }) +
           function("vec3 afterStage(int stage, vec3 start, vec3 rate, vec3 sum)",
                    [&](int s) { return concat("start + ", lead(s)); });
}

}  // namespace

std::vector<std::string> BufferLayout::defines(bool layered) const {
    std::vector<std::string> out = {concat("POSITION_ELEMENTS ", positionElements()),
                                    concat("STATE_ELEMENTS ", stateElements())};
    if (layered)
        out.insert(out.end(), {"LAYERED", concat("STATE_WIDTH ", stateWidth)});
    else
        out.push_back(concat("BLOCK ", block));
    if (history) out.insert(out.end(), {"HISTORY", concat("NO_HISTORY ", glslLiteral(noHistory))});
    if (life) out.emplace_back("LIFE");
    return out;
}

std::vector<glm::vec4> springNumbers(const Molecule& molecule) {
    std::vector<glm::vec4> out;
    for (const Spring& spring : molecule.springs) {
        const Actuation muscle = spring.actuation.value_or(Actuation{});
        out.emplace_back(spring.stiffness, spring.damping, molecule.restLength(spring), 0);
        out.emplace_back(muscle.amplitude, 2 * std::numbers::pi * muscle.frequency, muscle.phase, 0);
    }
    return out;
}

std::vector<double> springFrequencies(const Molecule& molecule) {
    std::vector<double> out;
    for (const Spring& spring : molecule.springs)
        out.push_back(spring.actuation.value_or(Actuation{}).frequency);
    return out;
}

bool countsMuscles(const Needs& needs) {
    return needs.actuation && !needs.steers;
}

std::vector<size_t> sweepOrder(const Molecule& molecule) {
    std::vector<size_t> out;
    std::vector<bool> done(molecule.springs.size());
    while (out.size() < done.size()) {
        std::vector<bool> taken(molecule.vertices.size());
        for (size_t s = 0; s < done.size(); ++s) {
            const size_t a = size_t(molecule.springs[s].a), b = size_t(molecule.springs[s].b);
            if (done[s] || taken[a] || taken[b]) continue;
            taken[a] = taken[b] = done[s] = true;
            out.push_back(s);
        }
    }
    return out;
}

KernelText kernelText(const Molecule& molecule, const Needs& needs, const Solver& solver, bool ofLane) {
    KernelText text;
    if (countsMuscles(needs))
        text.muscles = parameterArray("muscleAngles", muscleAngles(muscleFrequencies(molecule), 0).size());
    text.waves = MuscleWaves(molecule, needs).arrayText();
    if (solver.rungeKutta()) text.stages = stagesText(solver.tableau);
    if (!ofLane) return text;
    text.molecule = moleculeText(molecule, needs);
    text.forces = "#include \"physics/normal.glsl\"\n#include \"step/springs.glsl\"\n\n";
    if (needs.liveSprings)
        text.forces += "uniform sampler2D liveSprings;  // two a spring: src/compile/kernel.h\n\n";
    text.forces += needs.springs ? springText(molecule, needs) : "void springForces(float time)\n{\n}\n";
    text.forces += needs.normals ? normalText(molecule) : "\nvoid surfaceNormals()\n{\n}\n";
    if (solver.implicit && !solver.spread && needs.springs)
        text.sweeps = sweepText(molecule, needs, true) + sweepText(molecule, needs, false);
    else if (solver.implicit && !solver.spread)
        text.sweeps =
            "void relaxForward(float time, float inverseEta)\n{\n}\n\n"
            "void relaxBackward(float time, float inverseEta)\n{\n}\n";
    if (solver.kind == SolverKind::bdf2Corotated)
        text.sweeps += stageText(molecule, needs) +
                       corotatedText(molecule, blockPattern(molecule, needs.pins), needs.pins);
    addPacking(molecule, needs, solver.history, text);
    return text;
}

std::vector<TexelRun> texelRuns(size_t first, size_t count) {
    std::vector<TexelRun> out;
    constexpr size_t width = stateWidth;
    for (size_t done = 0; done < count; done += size_t(out.back().width)) {
        const size_t x = (first + done) % width;
        out.push_back({int(x), int((first + done) / width), int(std::min(width - x, count - done)), done});
    }
    return out;
}

}  // namespace shoal
