#include "window/group_editors.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "window/edit_widgets.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

constexpr double degrees = 57.29577951308232;

ImU32 shown(const glm::dvec4& color, const glm::dvec3& behind) {
    std::array<float, 3> out{};
    for (int i = 0; i < 3; ++i) {
        const double light = color[i] * color.w + behind[i] * (1 - color.w);
        out[size_t(i)] = float(std::pow(std::clamp(light, 0.0, 1.0), 1 / 2.2));
    }
    return ImGui::GetColorU32(ImVec4(out[0], out[1], out[2], 1));
}

glm::dvec4 colorAt(const std::vector<ColorKey>& keys, double age) {
    const auto value = [](const ColorKey& key) { return glm::dvec4(key.color, key.opacity); };
    if (age <= keys.front().age) return value(keys.front());
    for (size_t i = 0; i + 1 < keys.size(); ++i)
        if (age < keys[i + 1].age)
            return glm::mix(value(keys[i]), value(keys[i + 1]),
                            (age - keys[i].age) / (keys[i + 1].age - keys[i].age));
    return value(keys.back());
}

// A life from birth to death as a bar, over dark and light, with a mark at each keyframe.
void drawBar(const std::vector<ColorKey>& keys) {
    constexpr int steps = 48;
    const float width = ImGui::GetContentRegionAvail().x, height = points(18), mark = points(4);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < steps; ++i) {
        const float x0 = at.x + width * float(i) / steps, x1 = at.x + width * float(i + 1) / steps;
        const glm::dvec4 a = colorAt(keys, double(i) / steps), b = colorAt(keys, double(i + 1) / steps);
        for (int half = 0; half < 2; ++half) {
            const glm::dvec3 behind(half == 0 ? 0.02 : 0.5);
            const float y0 = at.y + 0.5f * height * float(half), y1 = y0 + 0.5f * height;
            list.AddRectFilledMultiColor(ImVec2(x0, y0), ImVec2(x1, y1), shown(a, behind), shown(b, behind),
                                         shown(b, behind), shown(a, behind));
        }
    }
    for (const ColorKey& key : keys) {
        const float x = at.x + width * float(key.age), y = at.y + height;
        list.AddTriangleFilled(ImVec2(x - mark, y + 1.5f * mark), ImVec2(x, y - 0.5f * mark),
                               ImVec2(x + mark, y + 1.5f * mark), ImGui::GetColorU32(ImGuiCol_Text));
    }
    ImGui::InvisibleButton("bar", ImVec2(width, height + 1.5f * mark));
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Colour and opacity from birth to death, over black and over grey.");
}

bool pickColor(const char* tip, ColorKey& key) {
    std::array<float, 3> value{float(key.color.x), float(key.color.y), float(key.color.z)};
    beginRow({"color", tip});
    if (!ImGui::ColorEdit3("##color", value.data(), ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR))
        return false;
    for (int i = 0; i < 3; ++i)
        key.color[i] = std::clamp(std::round(double(value[size_t(i)]) * 1000) / 1000, 0.0, mostParticleColor);
    return true;
}

}  // namespace

bool ParticleEditor::draw(ParticleType& type, bool ages) {
    bool changed = drawShape(type, ages);
    changed |= drawColors(type);
    if (type.image && type.shape != ParticleShape::points) changed |= drawImage(*type.image);
    changed |= drawBlending(type);
    changed |=
        slide({"mass", "What contact and forces on pins feel.", "%.4g kg", true}, limits_.mass, type.mass);
    if (changed) settle(type);
    return changed;
}

bool ParticleEditor::drawShape(ParticleType& type, bool ages) const {
    bool changed = false;
    int shape = int(type.shape);
    if (pick({"shape", "Dots of so many pixels; sprites and quads have a size and may show an image."},
             {"points", "sprites", "quads"}, shape)) {
        type.shape = ParticleShape(shape);
        changed = true;
    }
    if (type.shape == ParticleShape::points)
        return slide({"pixels", "The dot's diameter.", "%.1f px"}, limits_.pixels, type.pixels) || changed;
    changed |= slideSpan({"size", "Least and most diameter.", "%.4f m", true}, limits_.size, type.size);
    if (ages)
        changed |= slideSpan({"growth", "Factors on the size at birth and at death.", "%.2f", false, 1, true},
                             limits_.growth, type.growth);
    return drawTurning(type) || changed;
}

bool ParticleEditor::drawTurning(ParticleType& type) const {
    bool changed = false;
    if (type.shape == ParticleShape::quads) {
        int facing = int(type.facing);
        if (pick({"facing", "Turned to the camera, along the velocity, or freely in space."},
                 {"camera", "velocity", "free"}, facing)) {
            type.facing = ParticleFacing(facing);
            changed = true;
        }
        if (type.facing == ParticleFacing::velocity)
            return slide({"stretch", "Longer by this times the speed.", "%.3f s", true}, limits_.stretch,
                         type.stretch) ||
                   changed;
    }
    changed |= slideSpan({"turn", "Least and most turn at birth.", "%.0f\xC2\xB0", false, degrees},
                         limits_.turn, type.turn);
    return slideSpan({"spin", "Least and most turning speed.", "%.0f\xC2\xB0/s", false, degrees},
                     limits_.spin, type.spin) ||
           changed;
}

bool ParticleEditor::drawColors(ParticleType& type) const {
    std::vector<ColorKey>& keys = type.colors;
    bool changed = false;
    drawBar(keys);
    for (size_t k = 0; k < keys.size(); ++k) {
        ImGui::PushID(int(k));
        double age = keys[k].age;
        const Row row{"at", "Share of the life at which it is so.", "%.0f %% of life", false, 100};
        if (keys.size() > 1 && slide(row, {0, 1}, age)) {
            keys[k].age = ageBetween(keys, k, age);
            changed = true;
        }
        changed |= pickColor("Linear light; more than 1 glows.", keys[k]);
        changed |= slide({"opacity", "How much it covers.", "%.2f"}, {0, 1}, keys[k].opacity);
        if (keys.size() > 1 && ImGui::SmallButton("Remove this keyframe")) {
            keys.erase(keys.begin() + std::ptrdiff_t(k--));
            changed = true;
        }
        ImGui::PopID();
    }
    if (keys.size() < mostColorKeys && ImGui::SmallButton("Add a keyframe")) {
        addColorKey(keys);
        changed = true;
    }
    return changed;
}

bool ParticleEditor::drawImage(ParticleImage& image) const {
    const std::string file = std::filesystem::path(image.file).filename().string();
    beginRow({"image", "Its file."});
    ImGui::TextUnformatted(concat(file, ", tiles ", image.firstTile,
                                  image.lastTile > image.firstTile ? " to " : "",
                                  image.lastTile > image.firstTile ? std::to_string(image.lastTile) : "")
                               .c_str());
    if (image.firstTile == image.lastTile) return false;
    bool changed =
        tick({"flip-book", "All tiles one after another, else one for each particle."}, image.flipBook);
    if (!image.flipBook) return changed;
    changed |= slide({"frame rate", "0: once over the life.", "%.1f Hz"}, limits_.frameRate, image.frameRate);
    return tick({"fade", "Neighbouring frames fade into one another."}, image.blend) || changed;
}

bool ParticleEditor::drawBlending(ParticleType& type) const {
    bool changed = false;
    int blend = int(type.blend), sort = int(type.sort);
    if (pick({"blend", "How it meets what is behind it."}, {"none", "alpha", "additive", "multiplicative"},
             blend)) {
        type.blend = Blend(blend);
        changed = true;
    }
    if (type.blend == Blend::alpha && pick({"sort", "How they are put in order from back to front."},
                                           {"none", "every frame", "over some frames"}, sort)) {
        type.sort = DrawSort(sort);
        changed = true;
    }
    if (type.blend == Blend::alpha && type.sort == DrawSort::spread)
        changed |= slide({"frames", "Over how many frames the order is made.", "%d"}, limits_.spreadFrames,
                         type.spreadFrames);
    if (type.blend != Blend::none)
        changed |= slide({"softness", "Fades where a surface is nearer than this behind it.", "%.3f m", true},
                         limits_.softness, type.softness);
    if (type.blend != Blend::multiplicative)
        changed |= tick({"lit", "By sun and sky; else it sends its own colour."}, type.lit);
    return changed;
}

}  // namespace shoal::window
