#include "app/run/picture_layers.h"

#include <cctype>
#include <set>

#include "core/error.h"
#include "exchange/layered_image.h"

namespace shoal::app {

// Names differ in files as they do in the scene.
static std::string channelOf(const std::string& group, std::set<std::string>& taken) {
    std::string base = "mask.";
    for (const char c : group)
        base += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    std::string out = base;
    for (int i = 2; !taken.insert(out).second; ++i)
        out = concat(base, "_", i);
    return out;
}

void writeLayers(const std::filesystem::path& file, const PictureLayers& layers) {
    std::vector<exchange::ImageChannel> channels;
    const char* const colors[] = {"R", "G", "B", "A"};
    for (size_t c = 0; c < 4; ++c) {
        exchange::ImageChannel& channel = channels.emplace_back();
        channel.name = colors[c];
        for (size_t i = c; i < layers.color.size(); i += 4)
            channel.values.push_back(layers.color[i]);
    }
    channels.push_back({"Z", layers.depth, true});
    std::set<std::string> taken;
    for (const auto& [group, mask] : layers.masks)
        channels.push_back({channelOf(group, taken), mask});
    exchange::writeExr(file, layers.width, layers.height, channels);
}

}  // namespace shoal::app
