// Smooth lines, dots and words over a picture, on the CPU.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "core/image.h"

namespace shoal::app {

class Canvas {
  public:
    // Draws on the part of `size` at `corner` of an image with four channels, and clips to that part.
    Canvas(Image& image, glm::ivec2 corner, glm::ivec2 size) : image_(&image), corner_(corner), size_(size) {}

    using Color = glm::vec4;  // as displayed, with opacity; each in [0, 1]
    // Places and widths: pixels, from the upper left corner of the part.
    void line(glm::vec2 a, glm::vec2 b, float width, const Color& color);
    void dot(glm::vec2 middle, float radius, const Color& color) { line(middle, middle, 2 * radius, color); }
    void square(glm::vec2 middle, float half, const Color& color);
    void text(glm::ivec2 place, const std::string& words, const Color& color, int scale = 1);
    static int widthOf(const std::string& words, int scale = 1);  // pixels that text() takes
    // Copies a picture of the part's size or less into it.
    void paste(const Image& picture);

  private:
    void blend(int x, int y, const Color& color, float share);

    Image* image_;
    glm::ivec2 corner_, size_;
};

}  // namespace shoal::app
