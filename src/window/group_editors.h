// Sliders for what a group of a scene says: birth and death, looks of particles, steering.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "scene/edit_limits.h"
#include "scene/scene.h"
#include "scene/school.h"

namespace shoal::window {

// Sliders for birth and death of one group.
class LifeEditor {
  public:
    LifeEditor(const Scene& scene, size_t group);

    // Whether the user changed `scene`'s group in this frame.
    bool drawEmitters(Scene& scene);
    bool drawLife(Scene& scene);

  private:
    bool drawEmitter(Scene& scene, size_t index);
    bool drawKind(const Scene& scene, Emitter& emitter, Lifecycle& life) const;
    bool drawPlace(const Scene& scene, Emitter& emitter) const;
    bool drawWhen(Emitter& emitter) const;
    bool drawBursts(Emitter& emitter) const;
    bool drawVelocity(Emitter& emitter, glm::dvec2& angles) const;
    bool drawEnds(Lifecycle& life) const;
    bool drawNewborn(Lifecycle& life) const;
    bool drawPlaces(const Group& group, Lifecycle& life) const;

    size_t group_;
    LifeLimits limits_;
    std::vector<glm::dvec2> angles_;  // of the emitters' directions, rad
    glm::dvec2 span_{2, 3};           // s, that comes back when the group no longer lives for ever
    Box within_;                      // the same
    double afterContact_ = 0.5;       // s
};

// Sliders for the looks of one group of point particles.
class ParticleEditor {
  public:
    explicit ParticleEditor(const ParticleType& type) : limits_(limitsOf(type)) {}

    // Whether the user changed the type in this frame. `ages`: some are born or die.
    bool draw(ParticleType& type, bool ages);

  private:
    bool drawShape(ParticleType& type, bool ages) const;
    bool drawTurning(ParticleType& type) const;
    bool drawColors(ParticleType& type) const;
    bool drawImage(ParticleImage& image) const;
    bool drawBlending(ParticleType& type) const;

    LooksLimits limits_;
};

// Sliders for how the molecules of one group steer by one another.
class SchoolEditor {
  public:
    explicit SchoolEditor(const School& school);

    // Whether the user changed the school in this frame.
    bool draw(School& school) const;

  private:
    // Ranges that grow with what the file says.
    Limit radius_, separation_, rate_, speed_, acceleration_, turn_, wander_, walls_, targets_;
};

}  // namespace shoal::window
