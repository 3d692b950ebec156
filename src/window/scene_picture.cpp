#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "gpu/gl.h"
#include "window/open_scene.h"

namespace shoal::window {

void ScenePicture::drawAt(OpenScene& open, const Frame& frame, const PictureLevel& level) {
    const auto scaled = [&](int side) { return std::max(1, int(std::lround(level.scale * side))); };
    Renderer& renderer = open.running.renderer();
    renderer.setQuality(level.quality);
    renderer.resize(scaled(frame.width), scaled(frame.height));
    Explanations& explanations = *open.explanations;
    explanations.settings.lineWidth = frame.lineWidth * level.scale;
    explanations.prepare(open.running.scene(), open.simulation(), open.view());
    renderer.draw(open.simulation().state(), open.view(), explanations.any() ? &explanations : nullptr);
}

void ScenePicture::draw(OpenScene& open, const Frame& frame, bool force) {
    constexpr double patience = 0.3;  // s, from the last move to a full picture
    const Seen current{open.view(), frame.width, frame.height, open.running.builds()};
    if (frame.width != seen_.width || frame.height != seen_.height) rate.forget();
    if (frame.moves || current != seen_) movedAt_ = frame.time, full_ = false;
    seen_ = current;
    rests_ = frame.time - movedAt_ > patience;
    const bool counted = std::exchange(counts_, false);
    if (rests_ && full_) return;
    if (!rests_ && !force) {
        if (counted) rate.took(frame.seconds, drawing_);
        const bool measures = rate.measures(frame.seconds);
        if (measures) glFinish();
        const auto start = std::chrono::steady_clock::now();
        drawAt(open, frame, rate.level());
        if (measures) glFinish();
        drawing_ = measures ? std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()
                            : frame.seconds;
        counts_ = true;
        return;
    }
    drawAt(open, frame, pictureLevels[0]);
    full_ = true;
}

bool ScenePicture::missesRate() {
    return !told_ && (told_ = rate.missed());
}

}  // namespace shoal::window
