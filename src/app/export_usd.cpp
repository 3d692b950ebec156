// `shoal export --usd`: a run as Universal Scene Description.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "app/export_scene.h"
#include "core/error.h"
#include "core/json_build.h"
#include "core/printable.h"
#include "exchange/animation_texture.h"
#include "exchange/usda.h"
#include "run/signals.h"

namespace shoal::app {

using exchange::DrawnMesh, exchange::GroupMesh, exchange::UsdMoving, exchange::UsdSample, exchange::UsdStage;

namespace {

// A group's molecules as one shape at rest that turns and moves.
class RigidFit {
  public:
    RigidFit(const GroupMesh& mesh, const GroupPlan& plan) : scales_(plan.constants.scales) {
        scales_.resize(size_t(plan.count), 1);
        mesh.place(mesh.restPlaces(), rest_, normals_);
        glm::dvec3 middle(0);
        for (const glm::dvec3& x : rest_)
            middle += x / double(rest_.size());
        for (glm::dvec3& x : rest_)
            x -= middle;
    }

    // Returns the rigid motion that brings the rest shape nearest to the drawn molecule m.
    exchange::RigidMotion motion(size_t m, const std::vector<glm::dvec3>& places) {
        std::vector<glm::dvec3> scaled;
        for (const glm::dvec3& x : rest_)
            scaled.push_back(double(scales_[m]) * x);
        const exchange::RigidMotion out = exchange::rigidMotion(scaled, places);
        worst_ = std::max(worst_, out.worst);
        return out;
    }
    void look(const GroupMesh& mesh, const Snapshot& state) {
        for (const size_t m : livingIn(state)) {
            std::vector<glm::dvec3> places;
            std::vector<glm::vec3> normals;
            mesh.place(ofMolecule(state.positions, state, m), places, normals);
            motion(m, places);
        }
    }

    const std::vector<glm::dvec3>& rest() const { return rest_; }  // m, about its middle
    const std::vector<glm::vec3>& normals() const { return normals_; }
    const std::vector<float>& scales() const { return scales_; }
    double worst() const { return worst_; }  // m

  private:
    std::vector<glm::dvec3> rest_;
    std::vector<glm::vec3> normals_;
    std::vector<float> scales_;
    double worst_ = 0;
};

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
          mesh_(scene.groups[plan_->index], plan_->constants.seeds),
          changes_(plan_->needs.life),
          residual_(rigidity.residual) {
        const bool rigid = rigidity.asInstances && !mesh_.points();
        if (rigid && changes_)
            throw Error("group \"", mesh_.name(),
                        "\" has births or deaths: --rigid needs molecules that live throughout");
        UsdMoving how;
        how.changes = changes_;
        how.origin = exchange::originOf(simulation.snapshot(index).positions);
        const Group& group = scene.groups[plan_->index];
        if (group.particle && group.particle->shape != ParticleShape::points)
            how.width = (group.particle->size.x + group.particle->size.y) / 2;
        else if (!group.particle)
            how.width = group.molecule.material.pointSize;
        std::vector<size_t> molecules(rigid ? 1 : size_t(plan_->count));
        for (size_t i = 0; i < molecules.size(); ++i)
            molecules[i] = i;
        DrawnMesh mesh = mesh_.mesh(molecules);
        if (rigid) {
            fit_.emplace(mesh_, *plan_);
            for (const glm::dvec3& x : fit_->rest())
                mesh.positions.emplace_back(x);
            mesh.normals = fit_->normals();
            how.instances = fit_->scales();
            for (size_t m = 0; m < how.instances.size(); ++m)
                how.colors.push_back(mesh_.colorOf(m));
        }
        number_ = stage.addMoving(mesh, how);
    }

    void sample(UsdStage& stage, const Simulation& simulation, int frame) {
        const Snapshot state = simulation.snapshot(index_);
        UsdSample out;
        const std::vector<size_t> molecules = livingIn(state);
        std::vector<glm::dvec3> places;
        std::vector<glm::vec3> normals;
        for (const size_t m : molecules) {
            if (fit_) places.clear();
            mesh_.place(ofMolecule(state.positions, state, m), places, normals);
            if (fit_) {
                const exchange::RigidMotion motion = fit_->motion(m, places);
                out.points.push_back(motion.middle);
                out.turns.emplace_back(motion.turn);
            } else {
                mesh_.addVelocities(ofMolecule(state.velocities, state, m), out.velocities);
            }
        }
        if (!fit_) {
            out.points = std::move(places);
            if (!mesh_.points()) out.normals = std::move(normals);
        }
        if (changes_) {
            const DrawnMesh now = mesh_.mesh(molecules);
            out.corners = now.corners;
            out.colors = now.colors;
            if (!mesh_.points()) out.uvs = now.uvs;
        }
        stage.sample(number_, frame, out);
    }

    const std::string& name() const { return mesh_.name(); }
    const std::optional<RigidFit>& fit() const { return fit_; }
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

void eachFrame(Simulation& simulation, int frames, const auto& look) {
    for (int frame = 0; frame < frames && !signalThatAsked(); ++frame) {
        if (frame > 0) simulation.frame();
        simulation.check();
        look(frame);
    }
}

// Which groups are to be instances. Where a bound is given all frames are run once before they are written.
std::vector<Rigidity> rigidGroups(const ExportOptions& asked, const Scene& scene, Simulation& simulation) {
    const std::vector<GroupPlan>& plans = simulation.plan().groups;
    std::vector<Rigidity> out(plans.size(), {.asInstances = asked.rigid});
    if (!asked.rigidWithin) return out;
    std::vector<std::optional<GroupMesh>> meshes(plans.size());
    std::vector<std::optional<RigidFit>> fits(plans.size());
    for (size_t g = 0; g < plans.size(); ++g) {
        if (plans[g].count == 0 || plans[g].needs.life) continue;
        meshes[g].emplace(scene.groups[plans[g].index], plans[g].constants.seeds);
        if (!meshes[g]->points()) fits[g].emplace(*meshes[g], plans[g]);
    }
    const SavedState start = simulation.save();
    eachFrame(simulation, asked.frames, [&](int) {
        for (size_t g = 0; g < fits.size(); ++g)
            if (fits[g]) fits[g]->look(*meshes[g], simulation.snapshot(g));
    });
    simulation.load(start);
    for (size_t g = 0; g < fits.size(); ++g)
        if (fits[g]) out[g] = {fits[g]->worst() <= *asked.rigidWithin, fits[g]->worst()};
    return out;
}

}  // namespace

void exportUsd(const Options& options, const Scene& scene, Simulation& simulation) {
    const ExportOptions& asked = options.animation;
    UsdStage stage(asked.usd, scene.frameRate);
    for (const Model& model : scene.models)
        if (model.draw && !model.mesh.triangles.empty()) stage.add(exchange::modelMesh(model));
    stage.add(scene.camera);
    const std::vector<Rigidity> rigid = rigidGroups(asked, scene, simulation);
    std::vector<UsdGroup> groups;
    for (size_t g = 0; g < rigid.size(); ++g)
        if (simulation.plan().groups[g].count > 0) groups.emplace_back(stage, scene, simulation, g, rigid[g]);
    eachFrame(simulation, asked.frames, [&](int frame) {
        for (UsdGroup& group : groups)
            group.sample(stage, simulation, frame);
        stage.endFrame(frame);
    });
    stage.finish();
    const std::vector<std::string>& written = stage.written();
    if (options.json) {
        JsonValue residuals = JsonValue::makeObject();
        for (const UsdGroup& group : groups)
            if (group.fit()) residuals.members.push_back(key(group.name().c_str(), group.fit()->worst()));
        std::cout << writeJson(
            object(key("frames", asked.frames), key("rigidResidual", residuals), key("written", written)));
        return;
    }
    for (const UsdGroup& group : groups)
        if (asked.rigid || asked.rigidWithin) std::cout << group.rigiditySentence() << "\n";
    std::cout << "wrote " << printable(written.back()) << ", "
              << many(int64_t(asked.frames), "frame", "frames");
    if (written.size() > 1)
        std::cout << ", and " << many(int64_t(written.size() - 1), "other file", "other files");
    std::cout << "\n";
}

}  // namespace shoal::app
