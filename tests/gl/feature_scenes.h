// Scenes that together use every feature of a step: what the tests of the fused path run.
#pragma once

#include <string>
#include <vector>

#include "gl/numerics.h"
#include "support/every_kind.h"

namespace shoal::test {

struct FeatureScene {
    std::string name;
    Scene scene;
};

// A sheet of columns x rows vertices, 1 m along its longer side, bent a little; neighbours and next but one
// are sprung. The first corner is pinned where asked for, and a few springs are muscles.
Molecule sheet(int columns, int rows, bool pinned);
Molecule shippedMolecule(const std::string& name);
// Every spring moves: a wave that runs along the molecule.
void addMuscles(Molecule& molecule, double amplitude);

// Molecules at random in a box of 4 m about `middle`, from half to one and a half times their size, free of
// gravity and fields; as many substeps as they need at 60 frames a second.
Scene swarm(const Molecule& molecule, int count, SolverKind solver, const glm::dvec3& middle = {0, 2, 0});
// So that the solver is stable with some room.
void setStableSubsteps(Scene& scene);

// Rolling heights of 4 m x 4 m about the origin.
HeightFieldCollider rolling(bool sampledNormals);
// A plane at y = 0 and a sphere and a height field that stand out of it.
std::vector<Collider> everyCollider();

// Scenes of models/ with at most `mostMolecules` in a group: those without contact between molecules, which
// multiplies roundings, and without births and schools, which the fused path alone has; or `fusedOnly` the
// others. And scenes made here.
std::vector<FeatureScene> shippedScenes(int mostMolecules, bool fusedOnly = false);
std::vector<FeatureScene> featureScenes();  // with every solver where there are compute shaders

}  // namespace shoal::test
