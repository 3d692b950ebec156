// Images of any channels, as compositors read them (OpenEXR).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shoal::exchange {

struct ImageChannel {
    std::string name;           // R, G, B, A, Z, or of a layer: layer.channel
    std::vector<float> values;  // rows from the top
    bool whole = false;         // in 32 bits; else half of that
};

// The file is whole or not there. Error: cannot be written.
void writeExr(const std::filesystem::path& file, int width, int height,
              const std::vector<ImageChannel>& channels);

}  // namespace shoal::exchange
