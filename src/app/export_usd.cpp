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

class UsdGroup {
  public:
    UsdGroup(UsdStage& stage, const Scene& scene, const Simulation& simulation, size_t index, bool rigid)
        : plan_(&simulation.plan().groups[index]),
          index_(index),
          mesh_(scene.groups[plan_->index], plan_->constants.seeds),
          changes_(plan_->needs.life),
          rigid_(rigid && !mesh_.points()) {
        if (rigid_ && changes_)
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
        std::vector<size_t> molecules(rigid_ ? 1 : size_t(plan_->count));
        for (size_t i = 0; i < molecules.size(); ++i)
            molecules[i] = i;
        DrawnMesh mesh = mesh_.mesh(molecules);
        if (rigid_) {
            const std::vector<glm::dvec3> rest = mesh_.restPlaces();
            mesh_.place(rest, rest_, mesh.normals);
            glm::dvec3 middle(0);
            for (const glm::dvec3& x : rest_)
                middle += x / double(rest_.size());
            for (glm::dvec3& x : rest_)
                x -= middle;
            for (const glm::dvec3& x : rest_)
                mesh.positions.emplace_back(x);
            how.instances = plan_->constants.scales;
            how.instances.resize(size_t(plan_->count), 1);
            scales_ = how.instances;
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
            if (rigid_) places.clear();
            mesh_.place(ofMolecule(state.positions, state, m), places, normals);
            if (rigid_)
                turn(m, places, out);
            else
                mesh_.addVelocities(ofMolecule(state.velocities, state, m), out.velocities);
        }
        if (!rigid_) {
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

    double worst() const { return worst_; }
    const std::string& name() const { return mesh_.name(); }
    bool rigid() const { return rigid_; }

  private:
    void turn(size_t m, const std::vector<glm::dvec3>& places, UsdSample& out) {
        std::vector<glm::dvec3> scaled;
        for (const glm::dvec3& x : rest_)
            scaled.push_back(double(scales_[m]) * x);
        const exchange::RigidMotion motion = exchange::rigidMotion(scaled, places);
        worst_ = std::max(worst_, motion.worst);
        out.points.push_back(motion.middle);
        out.turns.emplace_back(motion.turn);
    }

    const GroupPlan* plan_;
    size_t index_, number_ = 0;
    GroupMesh mesh_;
    bool changes_, rigid_;
    std::vector<glm::dvec3> rest_;  // m, about its middle
    std::vector<float> scales_;
    double worst_ = 0;  // m
};

}  // namespace

void exportUsd(const Options& options, const Scene& scene, Simulation& simulation) {
    const ExportOptions& asked = options.animation;
    UsdStage stage(asked.usd, scene.frameRate);
    for (const Model& model : scene.models)
        if (model.draw) stage.add(exchange::modelMesh(model));
    stage.add(scene.camera);
    std::vector<UsdGroup> groups;
    for (size_t g = 0; g < simulation.plan().groups.size(); ++g)
        if (simulation.plan().groups[g].count > 0)
            groups.emplace_back(stage, scene, simulation, g, asked.rigid);
    for (int frame = 0; frame < asked.frames && !signalThatAsked(); ++frame) {
        if (frame > 0) simulation.frame();
        simulation.check();
        for (UsdGroup& group : groups)
            group.sample(stage, simulation, frame);
        stage.endFrame(frame);
    }
    stage.finish();
    const std::vector<std::string>& written = stage.written();
    if (options.json) {
        JsonValue residuals = JsonValue::makeObject();
        for (const UsdGroup& group : groups)
            if (group.rigid()) residuals.members.push_back(key(group.name().c_str(), group.worst()));
        std::cout << writeJson(
            object(key("frames", asked.frames), key("rigidResidual", residuals), key("written", written)));
        return;
    }
    for (const UsdGroup& group : groups)
        if (group.rigid())
            std::cout << "group \"" << printable(group.name()) << "\": rigid, vertices lie up to "
                      << group.worst() * 1e3 << " mm off\n";
    std::cout << "wrote " << printable(written.back()) << ", "
              << many(int64_t(asked.frames), "frame", "frames");
    if (written.size() > 1)
        std::cout << ", and " << many(int64_t(written.size() - 1), "other file", "other files");
    std::cout << "\n";
}

}  // namespace shoal::app
