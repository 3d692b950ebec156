#include "bench/stored_states.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "core/contract.h"
#include "core/json_build.h"

namespace shoal::bench {

namespace {

constexpr int sampled = 8;         // vertices of a group
constexpr float shift = 3e-7f;     // of a place and a velocity
constexpr int framesBetween = 10;  // of two shifts
constexpr int shiftedRuns = 3;
// The wind of one more run, as a factor less 1, where there are tiles of noise: a GPU's filter weighs texels
// by 8 bits.
constexpr double windShift = 5e-4;
constexpr double margin = 8;     // of a tolerance, over what shifts make of a figure
constexpr double least = 2e-4;   // tolerance, over the figure's scale
constexpr double chance = 0.25;  // of a molecule's size: vertices that move further are chance
// Channels of 255: the mean difference of two pictures of blocks that devices may show.
constexpr double pictureTolerance = 2;

const std::vector<std::string>& statisticNames() {
    static const std::vector<std::string> names = {
        "mean x",          "mean y", "mean z",          "mean velocity x", "mean velocity y",
        "mean velocity z", "spread", "spread of speed", "alive",           "released"};
    return names;
}

// Means, RMS distance from them, and counts; of the vertices of those that are alive.
std::vector<double> statisticsOf(const Snapshot& state) {
    glm::dvec3 place(0), velocity(0);
    double squares = 0, speeds = 0, alive = 0, released = 0, vertices = 0;
    const auto each = [&](const auto& work) {
        for (size_t m = 0; m < size_t(state.count); ++m)
            if (state.alive.empty() || state.alive[m]) work(m);
    };
    const auto count = size_t(state.vertexCount);
    each([&](size_t m) {
        ++alive;
        released += !state.released.empty() && state.released[m];
        for (size_t i = m * count; i < (m + 1) * count; ++i, ++vertices)
            place += state.positions[i], velocity += state.velocities[i];
    });
    if (vertices == 0) return std::vector<double>(statisticNames().size(), 0);
    place /= vertices, velocity /= vertices;
    each([&](size_t m) {
        for (size_t i = m * count; i < (m + 1) * count; ++i) {
            squares += glm::dot(state.positions[i] - place, state.positions[i] - place) / vertices;
            speeds += glm::dot(state.velocities[i], state.velocities[i]) / vertices;
        }
    });
    return {place.x,           place.y, place.z, velocity.x, velocity.y, velocity.z, std::sqrt(squares),
            std::sqrt(speeds), alive,   released};
}

// The figure of which a statistic's least tolerance is a share.
double scaleOf(size_t statistic, const std::vector<double>& values, double size) {
    if (statistic < 3 || statistic == 6) return std::max(values[6], size);
    if (statistic < 6 || statistic == 7) return std::max(values[7], 1e-2);
    return std::max(values[8], 1.0);
}

std::vector<glm::dvec3> sampledVertices(const Snapshot& state) {
    std::vector<glm::dvec3> out;
    const int most = std::min(sampled, state.count);
    for (int i = 0; i < most; ++i) {
        const auto m = size_t(int64_t(i) * state.count / most);
        out.push_back(state.positions[m * size_t(state.vertexCount) + size_t(i % state.vertexCount)]);
    }
    return out;
}

void shiftState(SavedState& state, const Plan& plan, std::mt19937& random) {
    std::uniform_real_distribution<float> any(-shift, shift);
    for (size_t g = 0; g < state.groups.size(); ++g) {
        const auto size = float(plan.groups[g].size);
        for (glm::vec3& x : state.groups[g].positions)
            for (int i = 0; i < 3; ++i)
                x[i] += any(random) * std::max(std::abs(x[i]), size);
        for (glm::vec3& v : state.groups[g].velocities)
            for (int i = 0; i < 3; ++i)
                v[i] += any(random) * std::abs(v[i]);
    }
}

// As many digits as a float has.
double rounded(double value) {
    return std::strtod(formatted("%.7g", value).c_str(), nullptr);
}
double roundedUp(double value) {
    return std::strtod(formatted("%.2g", value * 1.05).c_str(), nullptr);
}

double furthest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double out = 0;
    for (size_t i = 0; i < a.size(); ++i)
        out = std::max(out, glm::length(a[i] - b[i]));
    return out;
}

JsonValue asJson(const StoredGroup& group) {
    JsonValue out = object(key("name", group.name), key("statistics", group.statistics),
                           key("tolerances", group.tolerances));
    if (!group.vertices.empty())
        append(out, key("vertices", group.vertices), key("vertexTolerance", group.vertexTolerance));
    return out;
}

JsonValue asJson(const StoredState& state) {
    return object(key("name", state.name), key("frames", state.frames),
                  key("groups", arrayOf(state.groups, asJson)));
}

}  // namespace

const StoredState* StoredStates::find(const std::string& name) const {
    for (const StoredState& state : states)
        if (state.name == name) return &state;
    return nullptr;
}

StoredStates readStoredStates(const std::string& file) {
    const JsonValue value = readJson(file);
    JsonReader reader(value, file);
    StoredStates out;
    std::string format;
    reader.need("format", format);
    if (format != "shoal-states-1")
        throw Error(reader.locate("format"), "expected \"shoal-states-1\", found \"", format, "\"");
    reader.need("statistics", out.pictures);
    if (out.pictures != statisticNames())
        throw Error(reader.locate("statistics"), "expected other statistics");
    reader.need("pictures", out.pictures);
    for (JsonReader& state : reader.objects("states")) {
        StoredState& stored = out.states.emplace_back();
        state.need("name", stored.name);
        state.need("frames", stored.frames, Range::between(1, 1000));
        for (JsonReader& group : state.objects("groups")) {
            StoredGroup& storedGroup = stored.groups.emplace_back();
            group.need("name", storedGroup.name);
            group.need("statistics", storedGroup.statistics);
            group.need("tolerances", storedGroup.tolerances);
            group.get("vertices", storedGroup.vertices);
            group.get("vertexTolerance", storedGroup.vertexTolerance);
            if (storedGroup.statistics.size() != statisticNames().size() ||
                storedGroup.tolerances.size() != storedGroup.statistics.size())
                throw Error(group.locate("statistics"), "expected ", statisticNames().size(), " numbers");
            group.finish();
        }
        state.finish();
    }
    reader.finish();
    return out;
}

JsonValue asJson(const StoredStates& stored) {
    return object(key("format", "shoal-states-1"), key("statistics", statisticNames()),
                  key("pictures", stored.pictures), key("states", arrayOf(stored.states, asJson)));
}

Mismatch mismatch(const Simulation& simulation, const StoredGroup& stored, size_t group) {
    const Snapshot state = simulation.snapshot(group);
    const std::vector<double> statistics = statisticsOf(state);
    Mismatch out;
    const auto consider = [&](double difference, double tolerance, const std::string& what) {
        // what is not a number is the worst
        const double ratio = difference / tolerance, share = std::isfinite(ratio) ? ratio : 1e30;
        if (share < out.ofTolerance && !out.worst.empty()) return;
        out = {share, concat(stored.name, ": ", what, " off by ", formatted("%.3g", difference))};
    };
    for (size_t i = 0; i < statistics.size(); ++i)
        consider(std::abs(statistics[i] - stored.statistics[i]), stored.tolerances[i], statisticNames()[i]);
    if (stored.vertices.empty()) return out;
    const std::vector<glm::dvec3> vertices = sampledVertices(state);
    if (vertices.size() != stored.vertices.size())
        return {1e30,
                concat(stored.name, ": ", vertices.size(), " vertices instead of ", stored.vertices.size())};
    consider(furthest(vertices, stored.vertices), stored.vertexTolerance, "a vertex");
    return out;
}

StoredState recordState(const std::string& name, const Scene& scene, int frames, const BenchDevice& device) {
    Simulation simulation(*device.context, compile(scene), {.drawn = false});
    StoredState out{name, frames, {}};
    std::vector<std::vector<double>> moved;  // of each group's statistics, then of its vertices
    const int runs = 1 + shiftedRuns + int(!simulation.plan().fields.noiseTiles.empty());
    for (int run = 0; run < runs; ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        if (run > shiftedRuns) simulation.parameters.wind *= 1 + windShift;
        simulation.restart();
        for (int frame = 0; frame < frames; ++frame) {
            if (run > 0 && run <= shiftedRuns && frame % framesBetween == 0) {
                SavedState state = simulation.save();
                shiftState(state, simulation.plan(), random);
                simulation.load(state);
            }
            simulation.frame();
        }
        simulation.check();
        for (size_t g = 0; g < simulation.plan().groups.size(); ++g) {
            const Snapshot state = simulation.snapshot(g);
            if (run == 0) {
                out.groups.push_back(
                    {simulation.plan().groups[g].name, statisticsOf(state), {}, sampledVertices(state), 0});
                moved.emplace_back(statisticNames().size(), 0);
                continue;
            }
            StoredGroup& group = out.groups[g];
            const std::vector<double> statistics = statisticsOf(state);
            for (size_t i = 0; i < statistics.size(); ++i)
                moved[g][i] = std::max(moved[g][i], std::abs(statistics[i] - group.statistics[i]));
            group.vertexTolerance =
                std::max(group.vertexTolerance, furthest(sampledVertices(state), group.vertices));
        }
    }
    for (size_t g = 0; g < out.groups.size(); ++g) {
        StoredGroup& group = out.groups[g];
        const double size = simulation.plan().groups[g].size;
        for (size_t i = 0; i < group.statistics.size(); ++i) {
            const double floor = least * scaleOf(i, group.statistics, size);
            group.tolerances.push_back(roundedUp(std::max(margin * moved[g][i], floor)));
        }
        for (double& statistic : group.statistics)
            statistic = rounded(statistic);
        group.vertexTolerance = roundedUp(std::max(margin * group.vertexTolerance, least * size));
        if (simulation.plan().groups[g].needs.life || group.vertexTolerance > chance * size) {
            group.vertices.clear();
            continue;
        }
        for (glm::dvec3& vertex : group.vertices)
            for (int i = 0; i < 3; ++i)
                vertex[i] = rounded(vertex[i]);
    }
    return out;
}

Image recordPicture(const Scene& scene, const BenchDevice& device, const PictureMaker& draw) {
    Simulation simulation(*device.context, compile(scene), {});
    for (int frame = 0; frame < picturedFrames; ++frame)
        simulation.frame();
    simulation.check();
    return blockMeans(draw(scene, simulation));
}

Image blockMeans(const Image& picture) {
    EXPECTS(picture.width == blockColumns * blockSide && picture.height == blockRows * blockSide);
    Image out{blockColumns, blockRows, picture.channels, {}};
    const auto width = size_t(picture.width), channels = size_t(picture.channels), side = size_t(blockSide);
    for (size_t y = 0; y < size_t(blockRows); ++y)
        for (size_t x = 0; x < size_t(blockColumns); ++x)
            for (size_t c = 0; c < channels; ++c) {
                size_t sum = 0;
                for (size_t i = 0; i < side * side; ++i)
                    sum +=
                        picture.pixels[((y * side + i / side) * width + x * side + i % side) * channels + c];
                out.pixels.push_back(uint8_t((sum + side * side / 2) / (side * side)));
            }
    return out;
}

Mismatch pictureMismatch(const Image& blocks, const Image& sheet, int row) {
    const size_t bytes = blocks.pixels.size(), first = size_t(row) * bytes;
    if (sheet.width != blocks.width || sheet.channels != blocks.channels ||
        first + bytes > sheet.pixels.size())
        return {1e30, "the sheet of pictures has no such row"};
    double sum = 0;
    for (size_t i = 0; i < bytes; ++i)
        sum += std::abs(int(blocks.pixels[i]) - int(sheet.pixels[first + i]));
    const double mean = sum / double(bytes);
    return {mean / pictureTolerance, formatted("mean difference %.2f of 255", mean)};
}

}  // namespace shoal::bench
