// `shoal export --usd`: a run as Universal Scene Description.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "app/export/export_scene.h"
#include "core/error.h"
#include "core/json_build.h"
#include "core/printable.h"
#include "exchange/rigid_fit.h"
#include "exchange/usda.h"
#include "run/progress.h"
#include "run/signals.h"

namespace shoal::app {

using exchange::DrawnMesh, exchange::GroupMesh, exchange::RigidFit, exchange::UsdMoving, exchange::UsdSample,
    exchange::UsdStage;

namespace {

struct Rigidity {
    bool asInstances = false;
    std::optional<double> residual = {};  // m, that --rigid would leave, where a bound asks for it
};

class UsdGroup {
  public:
    UsdGroup(UsdStage& stage, const Scene& scene, const Simulation& simulation, size_t index,
             const Rigidity& rigidity)
        : plan_(&simulation.plan().groups[index]),
          index_(index),
          mesh_(scene.groups[plan_->index]),
          changes_(plan_->needs.life),
          residual_(rigidity.residual) {
        const bool rigid = rigidity.asInstances && !mesh_.points();
        UsdMoving how;
        how.changes = changes_;
        how.looksChange = changes_ || mesh_.looksChange();
        const Snapshot state = simulation.snapshot(index);
        how.origin = exchange::originOf(state.positions);
        std::vector<exchange::MoleculeState> molecules;
        for (size_t m = 0; m < size_t(plan_->count); ++m)
            molecules.push_back(moleculeIn(state, m));
        DrawnMesh mesh = mesh_.mesh(std::span(molecules).first(rigid ? 1 : molecules.size()));
        if (rigid) {
            fit_.emplace(mesh_, plan_->constants.scales, plan_->count);
            for (const glm::dvec3& x : fit_->rest())
                mesh.positions.emplace_back(x);
            mesh.normals = fit_->normals();
            how.instances = fit_->scales();
            for (const exchange::MoleculeState& molecule : molecules)
                how.colors.push_back(mesh_.colorOf(molecule));
        }
        number_ = stage.addMoving(mesh, how);
    }

    void sample(UsdStage& stage, const Simulation& simulation, int frame) {
        const Snapshot state = simulation.snapshot(index_);
        UsdSample out;
        const std::vector<exchange::MoleculeState> molecules = livingIn(state);
        std::vector<glm::dvec3> places;
        std::vector<glm::vec3> normals;
        for (size_t i = 0; i < molecules.size(); ++i) {
            if (fit_) places.clear();
            mesh_.place(molecules[i], places, normals);
            if (fit_) {
                const exchange::RigidMotion motion = fit_->motion(i, places);
                out.points.push_back(motion.middle);
                out.turns.emplace_back(motion.turn);
                if (mesh_.looksChange()) out.colors.push_back(mesh_.colorOf(molecules[i]));
            } else {
                mesh_.addVelocities(molecules[i].velocities, out.velocities);
            }
        }
        if (!fit_) {
            out.points = std::move(places);
            if (!mesh_.points()) out.normals = std::move(normals);
        }
        if (!fit_ && (changes_ || mesh_.looksChange())) {
            DrawnMesh mesh = mesh_.mesh(molecules);
            out.colors = std::move(mesh.colors);
            out.opacities = std::move(mesh.opacities);
            out.widths = std::move(mesh.sizes);
            if (changes_) out.corners = std::move(mesh.corners);
            if (changes_ && !mesh_.points()) out.uvs = std::move(mesh.uvs);
        }
        stage.sample(number_, frame, out);
    }

    const std::string& name() const { return mesh_.name(); }
    const std::optional<RigidFit>& fit() const { return fit_; }
    std::vector<Warning> warnings(const Scene& scene) const {
        if (!fit_) return {};
        return warningsOfBending(scene.groups[plan_->index], *plan_, fit_->worst());
    }
    // Tells what the group is written as where instances were asked for, and why.
    std::string rigiditySentence() const {
        const std::string what = concat("group \"", printable(name()), "\": ");
        const auto off = [](double residual) { return concat(residual * 1e3, " mm off"); };
        if (fit_) return what + "rigid, vertices lie up to " + off(fit_->worst());
        if (residual_) return what + "meshes, as rigid vertices would lie up to " + off(*residual_);
        return what + (mesh_.points() ? "points, which do not turn" : "meshes, for births or deaths");
    }

  private:
    const GroupPlan* plan_;
    size_t index_, number_ = 0;
    GroupMesh mesh_;
    bool changes_;
    std::optional<double> residual_;
    std::optional<RigidFit> fit_;
};

// A collider, which may move.
class UsdCollider {
  public:
    UsdCollider(UsdStage& stage, const Scene& scene, const Collider& collider, double time)
        : collider_(&collider), eye_(scene.camera.eye) {
        const DrawnMesh mesh = exchange::colliderMesh(collider, eye_, time);
        if (mesh.positions.empty()) return;
        if (!collider.path) {
            stage.add(mesh);
            return;
        }
        UsdMoving how;
        how.origin = mesh.origin;
        number_ = stage.addMoving(mesh, how);
    }

    void sample(UsdStage& stage, int frame, double time) {
        if (!number_) return;
        const DrawnMesh mesh = exchange::colliderMesh(*collider_, eye_, time);
        UsdSample out;
        for (const glm::vec3& x : mesh.positions)
            out.points.push_back(mesh.origin + glm::dvec3(x));
        out.normals = mesh.normals;
        stage.sample(*number_, frame, out);
    }

  private:
    const Collider* collider_;
    glm::dvec3 eye_;
    std::optional<size_t> number_;  // nothing: it stands still, or is not drawn
};

// Which groups are to be instances. Where a bound is given all frames are run once before they are written.
std::vector<Rigidity> rigidGroups(const ExportOptions& asked, const Scene& scene, Simulation& simulation) {
    const std::vector<GroupPlan>& plans = simulation.plan().groups;
    std::vector<Rigidity> out(plans.size(), {.asInstances = asked.rigid});
    for (const GroupPlan& plan : plans)
        if (asked.rigid && plan.needs.life && !GroupMesh(scene.groups[plan.index]).points())
            throw Error("group \"", plan.name,
                        "\" has births or deaths: --rigid needs molecules that live throughout");
    if (!asked.rigidWithin) return out;
    std::vector<std::optional<GroupMesh>> meshes(plans.size());
    std::vector<std::optional<RigidFit>> fits(plans.size());
    for (size_t g = 0; g < plans.size(); ++g) {
        if (plans[g].count == 0 || plans[g].needs.life) continue;
        meshes[g].emplace(scene.groups[plans[g].index]);
        if (!meshes[g]->points()) fits[g].emplace(*meshes[g], plans[g].constants.scales, plans[g].count);
    }
    const SavedState start = simulation.save();
    eachFrame(simulation, asked.frames, [&](int) {
        for (size_t g = 0; g < fits.size(); ++g) {
            if (!fits[g]) continue;
            const Snapshot state = simulation.snapshot(g);
            for (size_t m = 0; m < size_t(state.count); ++m) {
                std::vector<glm::dvec3> places;
                std::vector<glm::vec3> normals;
                meshes[g]->place(moleculeIn(state, m), places, normals);
                fits[g]->motion(m, places);
            }
        }
    });
    simulation.load(start);
    for (size_t g = 0; g < fits.size(); ++g)
        if (fits[g]) out[g] = {fits[g]->worst() <= *asked.rigidWithin, fits[g]->worst()};
    return out;
}

}  // namespace

bool exportUsd(const Options& options, const Scene& scene, Simulation& simulation) {
    const ExportOptions& asked = options.animation;
    UsdStage stage(asked.usd, scene.frameRate);
    const std::vector<Rigidity> rigid = rigidGroups(asked, scene, simulation);  // or refused, before any file
    for (const Model& model : scene.models)
        if (model.draw && !model.mesh.triangles.empty()) stage.add(exchange::modelMesh(model));
    stage.add(scene.camera);
    std::vector<UsdCollider> colliders;
    for (const Collider& collider : scene.colliders)
        colliders.emplace_back(stage, scene, collider, simulation.time());
    std::vector<UsdGroup> groups;
    for (size_t g = 0; g < rigid.size(); ++g)
        if (simulation.plan().groups[g].count > 0) groups.emplace_back(stage, scene, simulation, g, rigid[g]);
    int frames = 0;  // that are written
    eachFrame(simulation, asked.frames, [&](int frame) {
        for (UsdGroup& group : groups)
            group.sample(stage, simulation, frame);
        for (UsdCollider& collider : colliders)
            collider.sample(stage, frame, simulation.time());
        stage.endFrame(frame);
        ++frames;
    });
    if (frames == 0) return false;
    stage.finish();
    for (const UsdGroup& group : groups)
        tellWarnings(group.warnings(scene));
    if (signalThatAsked())
        std::cerr << "shoal: " << stoppedBySignal() << " after frame " << frames << " of " << asked.frames
                  << "; " << printable(stage.written().back()) << " ends there\n";
    const std::vector<std::string>& written = stage.written();
    if (options.json) {
        JsonValue residuals = JsonValue::makeObject();
        for (const UsdGroup& group : groups)
            if (group.fit()) residuals.members.push_back(key(group.name().c_str(), group.fit()->worst()));
        std::cout << writeJson(
            object(key("frames", frames), key("rigidResidual", residuals), key("written", written)));
        return true;
    }
    for (const UsdGroup& group : groups)
        if (asked.rigid || asked.rigidWithin) std::cout << group.rigiditySentence() << "\n";
    std::cout << "wrote " << printable(written.back()) << ", " << many(int64_t(frames), "frame", "frames");
    if (written.size() > 1)
        std::cout << ", and " << many(int64_t(written.size() - 1), "other file", "other files");
    std::cout << "\n";
    return true;
}

}  // namespace shoal::app
