#include "compile/tower.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "compile/contact_plan.h"
#include "compile/plan.h"

namespace shoal {

namespace {

struct Block {
    glm::dvec2 middle;  // m, across gravity
    double low, high, width, radius;
    size_t group;
    int level = 1;
    double bottom = 0;  // m, of the tower below it
    size_t foot = 0;    // the group of its lowest
};

// Adds those that stand on three vertices or more, and on which others can.
void addBlocks(const GroupPlan& group, const ContactGroup& contact, const glm::dmat3& axes,
               std::vector<Block>& out) {
    const size_t vertices = size_t(group.vertexCount);
    for (size_t m = 0; m < group.start.anchors.size(); ++m) {
        glm::dvec3 low(1e300), high(-1e300);
        std::vector<double> heights;
        for (size_t v = 0; v < vertices; ++v) {
            const glm::dvec3 place = glm::dvec3(group.start.positions[m * vertices + v]) * axes;
            low = glm::min(low, place), high = glm::max(high, place);
            heights.push_back(place.y);
        }
        const double scale = group.constants.scales.empty() ? 1 : double(group.constants.scales[m]);
        const double radius = contact.radius * scale;
        const double flat = radius / 4;
        if (std::count_if(heights.begin(), heights.end(), [&](double y) { return y < low.y + flat; }) < 3 ||
            std::count_if(heights.begin(), heights.end(), [&](double y) { return y > high.y - flat; }) < 3)
            continue;
        const glm::dvec3 anchor = glm::dvec3(group.start.anchors[m]) * axes, middle = (low + high) / 2.0;
        out.push_back({.middle = {anchor.x + middle.x, anchor.z + middle.z},
                       .low = anchor.y + low.y - radius,
                       .high = anchor.y + high.y + radius,
                       .width = std::min(high.x - low.x, high.z - low.z) + 2 * radius,
                       .radius = radius,
                       .group = contact.group});
    }
}

bool standsOn(const Block& upper, const Block& lower) {
    return std::abs(upper.low - lower.high) < upper.radius &&
           glm::distance(upper.middle, lower.middle) < upper.width / 4;
}

}  // namespace

glm::dmat3 uprightAxes(const glm::dvec3& gravity) {
    const glm::dvec3 up = -glm::normalize(gravity);
    const glm::dvec3 across =
        glm::normalize(glm::cross(up, std::abs(up.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1)));
    return {across, up, glm::cross(across, up)};
}

Tower tallestTower(const Scene& scene, const std::vector<GroupPlan>& groups,
                   const std::vector<ContactGroup>& contacts) {
    std::vector<Block> blocks;
    if (scene.gravity == glm::dvec3(0)) return {};
    for (const ContactGroup& contact : contacts) {
        const GroupPlan& group = groups[contact.group];
        if (group.solidFrequency > 0 && !group.life && !group.needs.steers)
            addBlocks(group, contact, uprightAxes(scene.gravity), blocks);
    }
    std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.low < b.low; });
    double cell = 0;
    for (const Block& block : blocks)
        cell = std::max({cell, block.width / 4, block.radius});
    // by the cell of the middle of their tops
    std::unordered_map<size_t, std::vector<size_t>> tops;
    const auto key = [&](const Block& block, double top, const glm::dvec3& beside) {
        const glm::dvec3 place = glm::floor(glm::dvec3(block.middle.x, top, block.middle.y) / cell) + beside;
        const std::hash<double> hash;
        return hash(place.x) ^ (hash(place.y) * 31) ^ (hash(place.z) * 1009);
    };
    Tower out;
    for (size_t b = 0; b < blocks.size(); ++b) {
        Block& block = blocks[b];
        block.bottom = block.low, block.foot = block.group;
        for (int i = 0; i < 27; ++i) {
            const auto found = tops.find(key(block, block.low, glm::dvec3(i % 3, i / 3 % 3, i / 9) - 1.0));
            if (found == tops.end()) continue;
            for (const size_t below : found->second) {
                const Block& lower = blocks[below];
                if (!standsOn(block, lower) || lower.level < block.level) continue;
                block.level = lower.level + 1, block.bottom = lower.bottom, block.foot = lower.foot;
            }
        }
        tops[key(block, block.high, glm::dvec3(0))].push_back(b);
        if (block.level > std::max(out.levels, 1))
            out = {block.level, (block.high - block.bottom) / block.level, block.foot};
    }
    return out;
}

}  // namespace shoal
