// Shoal as a library (docs/library.md): all that a program needs to make, step and draw scenes. SI units.
//
//   shoal::Scene scene;
//   scene.gravity = {0, -9.81, 0};
//   scene.groups.push_back(shoal::groupOf(shoal::readMolecule("leaf.json"), {{0, 1, 0}, {0.5, 1, 0}}));
//   shoal::gpu::Context context({.shaders = "share/shoal/shaders"});
//   shoal::Simulation simulation(context, shoal::compile(scene));
//   simulation.frame();
//
// Structs are plain, with defaults: what they hold, in which units, stands beside each member. Mistakes are
// shoal::Error, whose what() says what and where.
#pragma once

#include <utility>
#include <vector>

#include "compile/plan.h"
#include "gpu/context.h"
#include "molecule/molecule_file.h"
#include "render/renderer.h"
#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "scene/force_kinds.h"
#include "scene/json/scene_file.h"
#include "simulate/checkpoint.h"
#include "simulate/simulation.h"

namespace shoal {

// A group of a molecule at these places (m), as it is drawn.
inline Group groupOf(Molecule molecule, const std::vector<glm::dvec3>& places) {
    Group out;
    out.name = molecule.name;
    out.molecule = std::move(molecule);
    out.count = int(places.size());
    out.place.kind = Placement::Kind::list;
    out.place.turn = Placement::Turn::none;
    for (const glm::dvec3& place : places)
        out.place.items.push_back({.position = place});
    return out;
}

// A group of so many, strewn at random in a box (m), turned any way.
inline Group strewn(Molecule molecule, int count, const Box& box) {
    Group out;
    out.name = molecule.name;
    out.molecule = std::move(molecule);
    out.count = count;
    out.place.kind = Placement::Kind::volume;
    out.place.box = box;
    return out;
}

inline Collider colliderOf(ColliderShape shape) {
    Collider out;
    out.shape = std::move(shape);
    return out;
}

inline Field fieldOf(FieldShape shape) {
    Field out;
    out.shape = std::move(shape);
    return out;
}

}  // namespace shoal
