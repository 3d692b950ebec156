#include "app/bench_draw.h"

#include <memory>

#include "render/renderer.h"
#include "run/data_paths.h"

namespace shoal::app {

bench::DrawMaker drawMaker(gpu::Context& context) {
    return [&context](const Scene& scene, const Plan& plan) -> bench::Draw {
        RenderOptions options;
        options.width = pictureWidth;
        options.height = pictureHeight;
        const auto renderer = std::make_shared<Renderer>(context, shaderRoot(), scene, plan, options);
        return [renderer, view = View::of(scene.camera)](const StateView& state) {
            renderer->draw(state, view);
        };
    };
}

}  // namespace shoal::app
