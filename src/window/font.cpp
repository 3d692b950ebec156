#include "window/font.h"

#include <fontconfig/fontconfig.h>
#include <imgui.h>

#include <cstdint>
#include <iostream>
#include <memory>

#include "core/file.h"
#include "core/printable.h"

namespace shoal::window {

namespace {

struct Place {
    std::string file;
    int face = 0;
};

// What the user's configuration takes for plain text in the user's language; empty: there is nothing.
Place plainTextFont() {
    const std::unique_ptr<FcConfig, decltype(&FcConfigDestroy)> config(FcConfigCreate(), FcConfigDestroy);
    if (!FcConfigParseAndLoad(config.get(), nullptr, FcFalse) || !FcConfigBuildFonts(config.get())) return {};
    using Pattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;
    const auto* wanted = reinterpret_cast<const FcChar8*>("sans-serif:scalable=true:color=false");
    const Pattern pattern(FcNameParse(wanted), FcPatternDestroy);
    FcConfigSubstitute(config.get(), pattern.get(), FcMatchPattern);
    FcDefaultSubstitute(pattern.get());
    FcResult result = FcResultNoMatch;
    const Pattern match(FcFontMatch(config.get(), pattern.get(), &result), FcPatternDestroy);
    FcChar8* file = nullptr;
    Place out;
    if (!match || FcPatternGetString(match.get(), FC_FILE, 0, &file) != FcResultMatch) return {};
    FcPatternGetInteger(match.get(), FC_INDEX, 0, &out.face);
    out.file = reinterpret_cast<const char*>(file);
    out.face &= 0xFFFF;  // above it is the instance of a font that varies
    return out;
}

// Numbers of a font file, which are big-endian; 0 beyond its end.
class FontReader {
  public:
    explicit FontReader(std::string_view file) : file_(file) {}

    uint32_t number(size_t offset, size_t bytes) const {
        uint32_t out = 0;
        for (size_t i = 0; i < bytes; ++i)
            out = out << 8 | (offset + i < file_.size() ? uint8_t(file_[offset + i]) : 0);
        return out;
    }
    int signedNumber(size_t offset) const { return int16_t(number(offset, 2)); }
    // Where a table begins; 0: it is not there, or not whole.
    size_t table(size_t font, std::string_view name) const {
        for (uint32_t i = 0; i < number(font + 4, 2); ++i) {
            const size_t row = font + 12 + 16 * size_t(i);
            if (row + 16 > file_.size() || file_.substr(row, 4) != name) continue;
            const size_t begin = number(row + 8, 4), size = number(row + 12, 4);
            return begin + size <= file_.size() ? begin : 0;
        }
        return 0;
    }

  private:
    std::string_view file_;
};

}  // namespace

std::optional<double> lineHeightOf(std::string_view file, int face) {
    const FontReader reader(file);
    size_t font = 0;
    if (file.starts_with("ttcf")) {
        if (face < 0 || uint32_t(face) >= reader.number(8, 4)) return {};
        font = reader.number(12 + 4 * size_t(face), 4);
    }
    const uint32_t kind = reader.number(font, 4);
    constexpr uint32_t trueType = 0x00010000, apple = 0x74727565, openType = 0x4F54544F;  // "true", "OTTO"
    if (kind != trueType && kind != apple && kind != openType) return {};
    for (const char* needed : {"cmap", "head", "hhea", "hmtx", "maxp"})
        if (reader.table(font, needed) == 0) return {};
    const bool outlines = reader.table(font, "glyf") > 0 && reader.table(font, "loca") > 0;
    if (!outlines && reader.table(font, "CFF ") == 0) return {};
    const size_t metrics = reader.table(font, "hhea");
    const double em = reader.number(reader.table(font, "head") + 18, 2);
    const double line = reader.signedNumber(metrics + 4) - reader.signedNumber(metrics + 6);
    constexpr double least = 0.5, most = 4;
    return line > least * em && line < most * em ? std::optional(line / em) : std::nullopt;
}

std::optional<FontFile> systemFont() {
    const Place place = plainTextFont();
    if (place.file.empty()) return {};
    try {
        FontFile out{readFile(place.file), place.face};
        if (const std::optional<double> line = lineHeightOf(out.bytes, out.face)) {
            out.line = *line;
            return out;
        }
    } catch (const Error&) {
        // told below
    }
    std::cerr << "shoal: warning: the font " << printable(place.file)
              << " cannot be read: letters are the built-in ones\n";
    return {};
}

// Letters of the languages of Europe, signs, arrows and mathematics; the common ones of Japanese and Chinese,
// which a font has that the system takes for these languages, up to a size at which they fill 16 MB.
static const ImWchar* lettersFor(float height) {
    static const ImWchar few[] = {0x20,   0x24F,  0x370,  0x52F,  0x1E00, 0x1FFF, 0x2000,
                                  0x22FF, 0x25A0, 0x25FF, 0xFFFD, 0xFFFD, 0};
    static ImVector<ImWchar> many;
    if (height > 32) return few;
    if (many.empty()) {
        ImFontGlyphRangesBuilder builder;
        builder.AddRanges(few);
        builder.AddRanges(ImGui::GetIO().Fonts->GetGlyphRangesJapanese());
        builder.AddRanges(ImGui::GetIO().Fonts->GetGlyphRangesChineseSimplifiedCommon());
        builder.BuildRanges(&many);
    }
    return many.Data;
}

static bool spellsOut = false;  // the built-in font is in use

void addLetters(const FontFile* font, float height) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    spellsOut = !font;
    ImFontConfig config;
    config.SizePixels = height;
    if (!font) {
        atlas.AddFontDefault(&config);
        return;
    }
    config.FontDataOwnedByAtlas = false;
    config.FontNo = font->face;
    config.OversampleH = height > 20 ? 1 : 2;
    atlas.AddFontFromMemoryTTF(const_cast<char*>(font->bytes.data()), int(font->bytes.size()), height,
                               &config, lettersFor(height));
#if IMGUI_VERSION_NUM < 19200  // later ones make letters as they need them
    if (!atlas.Build()) addLetters(nullptr, height);
#endif
}

std::string inLetters(std::string words) {
    constexpr const char* spellings[][2] = {{"π", "pi"}, {"−", "-"},  {"…", "..."},
                                            {"→", "->"}, {"≤", "<="}, {"√", "root "}};
    for (const auto& [letter, spelling] : spellings)
        for (size_t found = 0; spellsOut && (found = words.find(letter, found)) != std::string::npos;)
            words.replace(found, std::string_view(letter).size(), spelling);
    return words;
}

}  // namespace shoal::window
