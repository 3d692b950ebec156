// Numbers in pictures: figures of 5 x 7 dots, two pixels a dot.
#pragma once

#include <string>

#include "core/image.h"

namespace shoal::app {

// Digits, '.', '-', '+', 'e', 'm' and spaces in dark grey on an RGB image; what is outside of it is left out.
void drawText(Image& image, int left, int top, const std::string& text);
int textWidth(const std::string& text);  // pixels

}  // namespace shoal::app
