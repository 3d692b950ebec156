// Finds what things hide of the sky from one another, as far as the picture shows them: contact shadows of
// the ambient light [McGuire 2012]. Worked out from the picture's depth, at half its size.
#pragma once

#include <string>
#include <vector>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/view.h"
#include "scene/scene.h"

namespace shoal {

class AmbientOcclusion {
  public:
    // None where the scene's sky has no occlusion.
    AmbientOcclusion(gpu::Context& context, const Scene& scene);

    // Returns what the picture's program defines to read it.
    std::vector<std::string> defines() const;
    void resize(int width, int height);  // of the picture
    // `sceneDepth`: of all that is not blended.
    void draw(const Eye& eye, const gpu::Texture& sceneDepth);
    // For the program of the picture (shaders/render/picture.frag). `drawn`: else the picture goes without.
    void apply(const gpu::Program& program, const Eye& eye, const gpu::Texture& sceneDepth, bool drawn) const;
    explicit operator bool() const { return strength_ > 0; }

  private:
    gpu::Context* context_;
    std::vector<std::string> gathers_;
    float strength_;  // 0: none
    float ambient_;   // luminance of the sky's light on something grey
    float farthest_;  // m: no sample lies further off
    gpu::Program find_, blur_;
    gpu::Texture rough_, smooth_;
    gpu::Framebuffer roughTarget_, smoothTarget_;
};

}  // namespace shoal
