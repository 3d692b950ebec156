// Sliders for birth and death of one group.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "scene/edit_limits.h"
#include "scene/scene.h"

namespace shoal::window {

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

}  // namespace shoal::window
