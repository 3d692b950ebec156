#include "app/molecule/canvas.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace shoal::app {

void Canvas::blend(int x, int y, const Color& color, float share) {
    if (x < 0 || y < 0 || x >= size_.x || y >= size_.y) return;
    uint8_t* pixel =
        &image_->pixels[(size_t(corner_.y + y) * size_t(image_->width) + size_t(corner_.x + x)) * 4];
    const float opacity = color.a * std::clamp(share, 0.0f, 1.0f);
    for (int i = 0; i < 3; ++i)
        pixel[i] = uint8_t(std::lround(glm::mix(float(pixel[i]), 255 * color[i], opacity)));
}

// Blends each pixel by the share of it that lies within half the width of the line.
void Canvas::line(glm::vec2 a, glm::vec2 b, float width, const Color& color) {
    const float half = width / 2;
    const glm::vec2 low = glm::min(a, b) - half - 1.0f, high = glm::max(a, b) + half + 1.0f, ab = b - a;
    const float length = glm::dot(ab, ab);
    for (int y = std::max(0, int(low.y)); y <= std::min(size_.y - 1, int(high.y)); ++y)
        for (int x = std::max(0, int(low.x)); x <= std::min(size_.x - 1, int(high.x)); ++x) {
            const glm::vec2 p(float(x) + 0.5f, float(y) + 0.5f);
            const float t = length > 0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0f, 1.0f) : 0.0f;
            const float share = half + 0.5f - glm::distance(p, a + t * ab);
            if (share > 0) blend(x, y, color, share);
        }
}

void Canvas::square(glm::vec2 middle, float half, const Color& color) {
    for (int y = int(middle.y - half); y <= int(middle.y + half); ++y)
        for (int x = int(middle.x - half); x <= int(middle.x + half); ++x)
            blend(x, y, color, 1);
}

void Canvas::paste(const Image& picture) {
    for (int y = 0; y < std::min(size_.y, picture.height); ++y)
        std::copy_n(
            picture.pixels.begin() + std::ptrdiff_t(size_t(y) * size_t(picture.width) * 4),
            4 * std::min(size_.x, picture.width),
            image_->pixels.begin() +
                std::ptrdiff_t((size_t(corner_.y + y) * size_t(image_->width) + size_t(corner_.x)) * 4));
}

namespace {

// The interface's font, one byte a texel.
struct Letters {
    ImFontAtlas atlas;
    ImFont* font = nullptr;
    unsigned char* texels = nullptr;
    int width = 0, height = 0;

    Letters() {
        font = atlas.AddFontDefault();
        atlas.GetTexDataAsAlpha8(&texels, &width, &height);
    }
};

const Letters& letters() {
    static const Letters out;
    return out;
}

const ImFontGlyph* glyphOf(char c) {
    const ImWchar code = static_cast<unsigned char>(c);
#if IMGUI_VERSION_NUM >= 19200
    return letters().font->GetFontBaked(letters().font->LegacySize)->FindGlyph(code);
#else
    return letters().font->FindGlyph(code);
#endif
}

}  // namespace

int Canvas::widthOf(const std::string& words, int scale) {
    float out = 0;
    for (const char c : words)
        if (const ImFontGlyph* glyph = glyphOf(c)) out += glyph->AdvanceX * float(scale);
    return int(out);
}

void Canvas::text(glm::ivec2 place, const std::string& words, const Color& color, int scale) {
    float pen = float(place.x);
    for (const char c : words) {
        const ImFontGlyph* glyph = glyphOf(c);
        if (!glyph) continue;
        const int u = int(std::lround(glyph->U0 * float(letters().width))),
                  v = int(std::lround(glyph->V0 * float(letters().height)));
        const int wide = int(std::lround(glyph->X1 - glyph->X0)),
                  high = int(std::lround(glyph->Y1 - glyph->Y0));
        for (int y = 0; y < high * scale; ++y)
            for (int x = 0; x < wide * scale; ++x) {
                const int texel = (v + y / scale) * letters().width + u + x / scale;
                const float share = float(letters().texels[texel]) / 255;
                if (share > 0)
                    blend(int(pen) + int(glyph->X0) * scale + x, place.y + int(glyph->Y0) * scale + y, color,
                          share);
            }
        pen += glyph->AdvanceX * float(scale);
    }
}

}  // namespace shoal::app
