#include "app/field_watch.h"

#include "core/cache_folder.h"

namespace shoal::app {

FieldBaking FieldWatch::baking() {
    return {cacheFolder(), [this](double share) { show(share); }};
}

void FieldWatch::show(double share) {
    const int now = int(share * 100);
    if (now < shown_) {  // another field, or the same finer
        bar_.reset();
        shown_ = 0;
    }
    const auto waited = std::chrono::steady_clock::now() - start_;
    if (!bar_ && waited < std::chrono::seconds(1)) return;
    if (!bar_) bar_.emplace("baking a distance field", 100);
    for (; shown_ < now; ++shown_)
        bar_->step();
}

}  // namespace shoal::app
