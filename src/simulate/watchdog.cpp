#include "simulate/watchdog.h"

#include <cmath>
#include <limits>

#include "compile/choose_solver.h"
#include "compile/collider_table.h"
#include "compile/pack.h"
#include "compile/plan.h"
#include "simulate/simulation.h"

namespace shoal {

namespace {

// As the shaders see it: the square must be finite as well.
bool finiteSquare(const glm::vec3& value) {
    return std::isfinite(glm::dot(value, value));
}

glm::vec3 anchorShift(const glm::vec3& p) {
    if (std::abs(p.x) <= 1 && std::abs(p.y) <= 1 && std::abs(p.z) <= 1) return glm::vec3(0);
    return latticePoint(p);
}

// In world coordinates.
glm::dvec3 placeOf(const GroupState& state, size_t molecule, size_t vertex) {
    return glm::dvec3(state.anchors[molecule]) + glm::dvec3(state.positions[vertex]);
}

bool wasHeld(const GroupPlan& group, const GroupState& state, size_t molecule) {
    for (size_t v = 0; v < group.pinned.size(); ++v) {
        if (!group.pinned[v]) continue;
        const size_t i = molecule * group.pinned.size() + v;
        if (state.velocities[i] != glm::vec3(0) ||
            placeOf(state, molecule, i) != placeOf(group.start, molecule, i))
            return false;
    }
    return true;
}

std::string cause(const Plan& plan, const Alarm& alarm) {
    if (alarm.cutShort)
        return concat(
            "its ways among many colliders took too many turns of loops: more than ",
            ColliderTable::mostTurns, " in a frame, or on the ping-pong path ",
            ColliderTable::mostTurnsOfPass, " in a substep, or more than Mesa's rasteriser takes (",
            gpu::mostSoftwareTurns,
            " in a frame). Try fewer --substeps at a higher frameRate, or fewer colliders in one place");
    std::string hasty = hastyForce(plan.forces, plan.groups[alarm.group], 1 / plan.frameRate / plan.substeps);
    constexpr const char* remedy = ". Try more --substeps, another --solver, or smaller numbers";
    if (!hasty.empty()) return hasty + remedy;
    if (!alarm.finite)
        return concat("the step is too long for something here, ",
                      plan.colliders.turns > 0 ? "a way among many colliders was cut short, " : "",
                      "or a force is beyond what a float holds", remedy);
    return concat("the limit is ", runawaySpeed,
                  " m/s: the step is too long for something here, or a field, a ",
                  "force, drag or start velocity is too large", remedy);
}

std::string describe(const Plan& plan, const Alarm& alarm) {
    return concat("stopped at frame ", alarm.frame, ", ", alarm.time, " s: group \"",
                  plan.groups[alarm.group].name, "\", molecule ", alarm.molecule, ", vertex ", alarm.vertex,
                  alarm.cutShort ? " was cut short"
                  : alarm.finite ? concat(" moves with ", alarm.speed, " m/s")
                                 : " is not finite",
                  "; ", cause(plan, alarm));
}

}  // namespace

std::string fastestDefine() {
    return concat("FASTEST_SQUARED ", runawaySpeed * runawaySpeed);
}

RunawayQuery::RunawayQuery(gpu::Traffic& traffic) : traffic_(&traffic) {
    GLuint id = 0;
    glGenQueries(1, &id);
    query_ = gpu::Handle<gpu::deleteQuery>(id);
}

RunawayQuery::Asking::Asking(RunawayQuery& query) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, query.query_.id());
    query.asked_ = true;
}

RunawayQuery::Asking::~Asking() {
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

std::optional<int> RunawayQuery::framesSince() const {
    if (!asked_) return {};
    GLuint raised = GL_FALSE;
    glGetQueryObjectuiv(query_.id(), GL_QUERY_RESULT, &raised);
    traffic_->countReadBack(gpu::Traffic::Kind::control, sizeof raised);
    if (raised == GL_FALSE) return {};
    return 0;
}

RunawayWord::RunawayWord(gpu::Context& context, Reading reading)
    : reading_(reading), traffic_(&context.traffic()) {
    constexpr uint32_t fine = 0;
    word_ = gpu::Buffer(context, gpu::Buffer::Use::storage, &fine, sizeof fine, "alarm");
    if (reading == Reading::waits) return;
    constexpr uint32_t none[mostBehind + 1] = {};
    constexpr GLbitfield mapped = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    copies_ = gpu::Handle<gpu::deleteBuffer>(glGenBuffers);
    glBindBuffer(GL_COPY_WRITE_BUFFER, copies_.id());
    glBufferStorage(GL_COPY_WRITE_BUFFER, sizeof none, none, mapped | GL_CLIENT_STORAGE_BIT);
    copy_ =
        static_cast<const volatile uint32_t*>(glMapBufferRange(GL_COPY_WRITE_BUFFER, 0, sizeof none, mapped));
    context.checkErrors("the watchdog");
}

void RunawayWord::endFrame(int number) {
    last_ = number;
    if (reading_ == Reading::waits) return;
    glBindBuffer(GL_COPY_READ_BUFFER, word_.id());
    glBindBuffer(GL_COPY_WRITE_BUFFER, copies_.id());
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, GLintptr(next_ * sizeof(uint32_t)),
                        sizeof(uint32_t));
    fences_[next_].reset(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    next_ = (next_ + 1) % fences_.size();
    const Fence& oldest = fences_[next_];
    constexpr GLuint64 second = 1'000'000'000;
    while (oldest && glClientWaitSync(oldest.get(), GL_SYNC_FLUSH_COMMANDS_BIT, second) == GL_TIMEOUT_EXPIRED)
        ;
}

// The word as far as it has arrived: once set it stays so.
uint32_t RunawayWord::seen() const {
    uint32_t out = copy_[next_];
    for (size_t i = 0; reading_ == Reading::ahead && i < fences_.size(); ++i)
        out = std::max(out, uint32_t(copy_[i]));
    traffic_->countReadBack(gpu::Traffic::Kind::control, sizeof out);
    return out;
}

std::optional<int> RunawayWord::framesSince(bool waits) {
    if (waits || reading_ == Reading::waits)
        word_.download(gpu::Traffic::Kind::control, 0, &raised_, sizeof raised_);
    else if (raised_ == 0)
        raised_ = seen();
    if (raised_ == 0) return {};
    return reading_ == Reading::waits ? 0 : last_ + 1 - int(raised_);
}

void RunawayWord::disarm() {
    constexpr uint32_t fine = 0;
    word_.update(gpu::Traffic::Kind::control, 0, &fine, sizeof fine);
    raised_ = fine;
    if (reading_ == Reading::waits) return;
    for (size_t i = 0; i < fences_.size(); ++i)
        endFrame(last_);
    glFinish();
}

Alarm findAlarm(const SavedState& saved) {
    Alarm worst;
    worst.time = saved.time;
    worst.frame = saved.frames;
    for (size_t g = 0; g < saved.groups.size(); ++g) {
        const GroupState& state = saved.groups[g];
        const size_t vertices = state.positions.size() / state.anchors.size();
        for (size_t i = 0; i < state.positions.size(); ++i) {
            if (!state.lives.empty() && state.lives[i / vertices].y <= 0) continue;  // a free place
            const bool finite = finiteSquare(state.positions[i]) && finiteSquare(state.velocities[i]);
            const double speed = glm::length(glm::dvec3(state.velocities[i]));
            const bool cutShort = state.positions[i] == glm::vec3(std::numeric_limits<float>::infinity());
            // what was cut short is the cause of what is not finite beside it
            if (!cutShort && (!worst.finite || (finite && !(speed > worst.speed)))) continue;
            worst.group = g;
            worst.molecule = int(i / vertices);
            worst.vertex = int(i % vertices);
            worst.speed = speed;
            worst.finite = finite;
            worst.cutShort = cutShort;
            if (cutShort) return worst;
        }
    }
    return worst;
}

bool runsAway(const Alarm& alarm) {
    return !alarm.finite || alarm.speed >= runawaySpeed;
}

Runaway::Runaway(const Plan& plan, const Alarm& alarm)
    : Error(plan.groups[alarm.group].location, describe(plan, alarm)), alarm_(alarm) {}

void undoRecords(const GroupPlan& group, GroupState& state) {
    const size_t vertices = size_t(group.vertexCount);
    for (size_t m = 0; m < state.anchors.size(); ++m) {
        if (group.needs.records) state.anchors[m] -= anchorShift(state.positions[m * vertices]);
        if (state.released[m] && wasHeld(group, state, m)) state.released[m] = 0;
    }
}

}  // namespace shoal
