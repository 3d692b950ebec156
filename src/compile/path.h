// Which of the execution paths runs a plan, and what each takes of the device. Pure functions.
//
//   fused       a compute kernel a group: each molecule is read once a frame, runs all its substeps in
//               registers and is written once. OpenGL 4.3.
//   fragments   the same kernels as fragment shaders, which write to several textures at once. OpenGL 3.3;
//               this is what "fused" means where there is no 4.3.
//   ping-pong   fragment passes over textures, several a substep. OpenGL 3.3; for old hardware, and as an
//               independent check of the other.
#pragma once

#include <array>
#include <string>

#include "compile/lanes.h"
#include "compile/plan.h"

namespace shoal {

enum class Path { automatic, fused, fragments, pingPong };

// "auto", "fused", "fragments", "ping-pong".
const char* name(Path path);
// Error: another word, with the nearest.
Path path(const std::string& word);

// Holds the limits of a context by which a path is chosen.
struct PathLimits {
    std::string version = "4.3";  // for messages
    bool compute = true;          // OpenGL 4.3 or newer
    bool software = false;        // a CPU rasteriser
    int maxTextureSize = 16384;
    int maxSharedBytes = 32768;
    int maxUniformComponents = 1024;  // of a compute shader or, without compute, of a fragment shader
    int maxUniformBlockBytes = 16384;
    int targets = 8;  // textures that one draw writes
    int maxTextureLayers = 256;
    // By Path: why a path computes wrongly on this driver (simulate/self_check.h) and is taken only when it
    // is demanded; empty: it does not.
    std::array<std::string, 4> wrong = {};
};

// In fragments and in passes so many spheres may touch one: with what else a pass draws, these fit the 8 draw
// buffers that OpenGL 3.3 promises.
constexpr int contactsInFragments = 24;

struct PathChoice {
    Path path = Path::fused;
    std::string why;                 // for people: why not another
    Lanes lanes = Lanes::automatic;  // of the fused path, as they are demanded
};

// Error: the path that is demanded (or, for automatic, any) cannot run the plan: no OpenGL 4.3, a molecule
// with too many vertices and how many would do, more molecules than the textures hold and how many would fit,
// a field sampling that the ping-pong path does not have; the lanes that are demanded are not of the path, or
// do not hold a molecule.
PathChoice choosePath(const Plan& plan, Path wanted, const PathLimits& limits,
                      Lanes lanes = Lanes::automatic);

// Error, located: a molecule has more vertices than any path holds that is `wanted`. choosePath() says so,
// too; this follows from the scene alone, whose plan takes long for large molecules.
void checkVertices(const Scene& scene, Path wanted, const PathLimits& limits);

// Bytes on the device: positions, velocities, records and constants, all sides; normals where something is
// drawn.
size_t stateBytes(const Plan& plan, Path path, bool drawn, bool inPlace = false);
// Likewise of the tables: topology, samples and tiles.
size_t tableBytes(const Plan& plan, Path path);

// For people: groups, passes and why each is there, memory.
std::string explain(const Plan& plan, const PathChoice& choice, bool inPlace = false);
// For programs.
class JsonValue;
JsonValue explainJson(const Plan& plan, const PathChoice& choice, bool inPlace = false);

}  // namespace shoal
