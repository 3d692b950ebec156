#include "compile/passes.h"

#include "compile/plan.h"

namespace shoal {

const char* name(PassKind kind) {
    static constexpr const char* names[] = {"records", "normals", "thrust",  "restore",
                                            "advect",  "stage",   "collide", "watch"};
    return names[size_t(kind)];
}

std::vector<Pass> passesOf(const GroupPlan& group) {
    const Needs& needs = group.needs;
    const Solver& solver = shoal::solver(group.solver);
    const int stages = solver.tableau.stages;
    const bool leapfrog = group.solver == SolverKind::leapfrog;
    // symmetrically where the solver is: half before and half after the rest of a substep
    const bool halves = needs.thrust && solver.order > 1;
    std::vector<Pass> out;
    using When = Pass::When;
    const auto add = [&](bool need, PassKind kind, When when, std::string why) {
        if (need) out.push_back({kind, when, std::move(why)});
    };
    add(needs.records, PassKind::records, When::frameStart,
        needs.release ? "pins may be released, and anchors follow what flies" : "anchors follow what moves");
    add(needs.springs && leapfrog, PassKind::restore, When::frameStart,
        "leapfrog starts a frame from the springs' force");
    add(needs.thrust, PassKind::thrust, When::substep, "a thrust pushes along the velocity");
    add(needs.springs && solver.order == 1, PassKind::restore, When::substep, "the molecule has springs");
    add(needs.directionalDrag && stages == 0, PassKind::normals, When::substep,
        "drag differs across and along the surface");
    add(true, stages > 0 ? PassKind::stage : PassKind::advect, When::substep,
        concat(stages > 0 ? concat(stages, " times: ") : "", "moves every vertex",
               needs.gravity ? " under gravity" : "",
               needs.fields ? ", dragged by the fields"
               : needs.drag ? ", with drag"
                            : "",
               needs.forces ? ", with forces" : "", needs.wind ? ", in the wind" : ""));
    add(halves && stages > 0, PassKind::thrust, When::substep, "the other half of the thrust");
    add(needs.collide, PassKind::collide, When::substep, "the scene has colliders");
    add(needs.springs && leapfrog, PassKind::restore, When::substep, "the molecule has springs");
    add(halves && stages == 0, PassKind::thrust, When::substep, "the other half of the thrust");
    add(needs.normals, PassKind::normals, When::frameEnd, "drawn, or exported, with its normals");
    add(true, PassKind::watch, When::frameEnd, "stops a run whose state is not finite or too fast");
    return out;
}

bool keepsAcceleration(const GroupPlan& group) {
    return group.needs.springs && (group.solver == SolverKind::leapfrog ||
                                   (group.solver == SolverKind::euler && group.needs.collide));
}

}  // namespace shoal
