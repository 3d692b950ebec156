// Where the picture is taken from, and how it reaches shaders without losing accuracy far from the origin:
// everything is drawn relative to the eye, in the scene's directions.
#pragma once

#include <glm/glm.hpp>

#include "gpu/program.h"
#include "scene/scene.h"

namespace shoal {

struct View {
    glm::dvec3 eye{0, 2, 8}, target{0, 1, 0}, up{0, 1, 0};  // m
    double fieldOfView = 0.8;                               // rad, vertical
    double exposure = 1;
    double time = 0;  // s: where the colliders are that move

    bool operator==(const View&) const = default;
    static View fromCamera(const Camera& camera, double time = 0);
};

// Columns: right, up, towards the eye.
glm::dmat3 directionsOf(const View& view);

// A point that places are relative to, split so that floats subtract it exactly: a point of the anchors'
// lattice (1/16 m) and the rest below that.
struct Origin {
    glm::dvec3 exact{0};
    glm::vec3 lattice{0}, rest{0};

    explicit Origin(const glm::dvec3& point = glm::dvec3(0));
    void apply(const gpu::Program& program) const;  // shaders/state/molecule.glsl
};

// A view of a picture of some size, in the terms of the shaders.
struct Eye {
    Origin origin;
    glm::mat4 toClip{1};       // from places relative to the eye
    glm::mat3 viewToScene{1};  // columns: right, up, towards the eye
    glm::vec2 tangents{1};     // of half the field of view
    float pixelsPerMeter = 1;  // at a distance of one metre
    glm::vec2 size{1};         // pixels
    float nearest = 0;         // m: of the depth buffer, which holds 1 - nearest / depth
    double time = 0;           // s

    Eye(const View& view, int width, int height);
};

}  // namespace shoal
