#include "app/screenshot.h"

#include <algorithm>
#include <iostream>

#include "core/image.h"
#include "core/printable.h"
#include "gpu/gl.h"

namespace shoal::app {

void saveScreenshot(const std::string& file, int width, int height) {
    Image image{width, height, 4, std::vector<uint8_t>(size_t(width) * size_t(height) * 4)};
    const size_t row = size_t(width) * 4;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    std::vector<uint8_t> bottomUp(image.pixels.size());
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bottomUp.data());
    for (size_t y = 0; y < size_t(height); ++y)
        std::copy_n(bottomUp.begin() + std::ptrdiff_t((size_t(height) - 1 - y) * row), row,
                    image.pixels.begin() + std::ptrdiff_t(y * row));
    for (size_t i = 3; i < image.pixels.size(); i += 4)
        image.pixels[i] = 255;
    writePng(file, image);
    std::cout << "screenshot: " << printable(file) << "\n";
}

}  // namespace shoal::app
