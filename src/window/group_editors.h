// Sliders for what a group of a scene says: birth and death, looks of particles.
#pragma once

#include <vector>

#include "scene/scene.h"
#include "window/key_rows.h"

namespace shoal::window {

// Sliders for birth and death of one group.
class LifeEditor {
  public:
    explicit LifeEditor(size_t group) : group_(group) {}

    // Whether the user changed `scene`'s group in this frame.
    bool drawEmitters(Scene& scene);
    bool drawLife(Scene& scene);

  private:
    bool drawEmitter(Scene& scene, size_t index);
    bool drawKind(const Scene& scene, Emitter& emitter, Lifecycle& life) const;
    bool drawModel(const Scene& scene, Emitter& emitter) const;
    bool drawCapacity(const Group& group, Lifecycle& life) const;

    size_t group_;
    KeyRows life_;
    std::vector<KeyRows> emitters_;
};

// Sliders for the looks of one group of point particles.
class ParticleEditor {
  public:
    // Whether the user changed the type in this frame. `ages`: the group has a life cycle.
    bool draw(ParticleType& type, bool ages);

  private:
    KeyRows rows_, image_;
    std::vector<KeyRows> colors_;
};

}  // namespace shoal::window
