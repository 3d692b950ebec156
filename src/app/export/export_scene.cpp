// `shoal export`: a scene for game engines and viewers: animation textures (exchange/animation_texture.h), or
// all that is drawn as glTF at one moment or as USD over time.
#include <cmath>
#include <filesystem>
#include <iostream>

#include "app/export/export_scene.h"
#include "app/line/commands.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_build.h"
#include "core/parallel.h"
#include "core/printable.h"
#include "exchange/gltf.h"
#include "run/progress.h"
#include "run/signals.h"

namespace shoal::app {

namespace fs = std::filesystem;

using exchange::AnimationFrame, exchange::AnimationTexture, exchange::DrawnMesh, exchange::GroupMesh;

namespace {

// ---- One moment

std::vector<DrawnMesh> meshesNow(const Simulation& simulation, const Scene& scene) {
    std::vector<DrawnMesh> out;
    for (size_t g = 0; g < simulation.plan().groups.size(); ++g) {
        const GroupPlan& plan = simulation.plan().groups[g];
        const Snapshot state = simulation.snapshot(g);
        const GroupMesh group(scene.groups[plan.index]);
        const std::vector<exchange::MoleculeState> molecules = livingIn(state);
        std::vector<glm::dvec3> positions;
        DrawnMesh mesh = group.mesh(molecules);
        for (const exchange::MoleculeState& molecule : molecules)
            group.place(molecule, positions, mesh.normals);
        recentre(mesh, positions);
        out.push_back(std::move(mesh));
    }
    for (const Model& model : scene.models)
        if (model.draw && !model.mesh.triangles.empty()) out.push_back(exchange::modelMesh(model));
    for (const Collider& collider : scene.colliders)
        out.push_back(exchange::colliderMesh(collider, scene.camera.eye, simulation.time()));
    return out;
}

// ---- Animation textures

// Molecules that share a texture, a column a vertex or, rigid, a molecule.
struct Part {
    std::string name;
    size_t first = 0, count = 0;  // molecules
    std::unique_ptr<AnimationTexture> texture;
    DrawnMesh mesh;
    std::vector<glm::dvec3> begin;  // m, of the scene: where its vertices are in the first frame of all
    std::vector<glm::dvec3> rest;   // and where they are in the mesh
    std::vector<glm::dquat> turns;  // the last, of each molecule: of two that are alike the nearer is next
    std::vector<std::string> written;
    double step = 0, loopShift = 0;               // m, at the most
    double worst = 0, squares = 0, vertices = 0;  // of what rigid motion leaves: m, m^2
};

const char* ending(exchange::TexelFormat format) {
    return format == exchange::TexelFormat::png16 ? ".png" : ".exr";
}

// A name as part of a file's.
std::string fileName(const std::string& name) {
    std::string out;
    for (const char c : name)
        out += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '_';
    return out.empty() ? "group" : out;
}

class TextureExport {
  public:
    TextureExport(const Options& options, const Scene& scene, Simulation& simulation)
        : options_(options.animation),
          scene_(scene),
          simulation_(simulation),
          index_(groupIndex()),
          group_(scene.groups[simulation.plan().groups[index_].index]) {
        if (group_.points())
            throw Error("group \"", group_.name(), "\" has no triangles: an animation texture needs a mesh");
        const GroupPlan& plan = simulation.plan().groups[index_];
        molecules_ = size_t(plan.count);
        if (options_.molecules) {
            if (size_t(*options_.molecules) > molecules_)
                throw WrongUse(concat("--molecules: group \"", group_.name(), "\" has ", molecules_,
                                      ", found ", *options_.molecules));
            molecules_ = size_t(*options_.molecules);
        }
        makeParts();
    }

    // False: a signal asked for the end before all frames were there, and nothing is written.
    bool run() {
        const int frames = options_.frames + options_.loop;
        eachFrame(simulation_, frames, [&](int frame) { add(simulation_.snapshot(index_), frame); });
        if (signalThatAsked()) return false;
        writeAll();
        for (const Part& part : parts_) {
            sums_.step = std::max(sums_.step, part.step);
            sums_.loopShift = std::max(sums_.loopShift, part.loopShift);
            sums_.worst = std::max(sums_.worst, part.worst);
            sums_.squares += part.squares;
            sums_.vertices += part.vertices;
            sums_.written.insert(sums_.written.end(), part.written.begin(), part.written.end());
        }
        const GroupPlan& plan = simulation_.plan().groups[index_];
        if (options_.rigid) tellWarnings(warningsOfBending(scene_.groups[plan.index], plan, sums_.worst));
        return true;
    }

    JsonValue report() const {
        JsonValue out = object(key("group", group_.name()), key("molecules", molecules_),
                               key("columns", columnsEach() * molecules_), key("frames", options_.frames),
                               key("positionStep", sums_.step));
        if (options_.rigid) append(out, key("rigidResidual", sums_.worst), key("rigidResidualRms", rms()));
        if (options_.loop > 0) append(out, key("loopShift", sums_.loopShift));
        return append(out, key("written", sums_.written));
    }
    std::string text() const {
        std::string out = concat("group \"", printable(group_.name()),
                                 "\": ", many(int64_t(molecules_), "molecule", "molecules"), ", ",
                                 columnsEach() * molecules_, " columns, ",
                                 many(int64_t(options_.frames), "frame", "frames"), "\n");
        if (parts_.size() > 1)
            out += concat("  split into ", parts_.size(), " textures of at most ",
                          AnimationTexture::mostColumns, " columns\n");
        out += concat("  positions in steps of ", sums_.step * 1e3, " mm\n");
        if (options_.rigid)
            out += concat("  rigid: vertices lie up to ", sums_.worst * 1e3, " mm off, ", rms() * 1e3,
                          " mm in the root of the mean square\n");
        if (options_.loop > 0)
            out += concat("  loop: blending moves vertices by up to ", sums_.loopShift * 1e3, " mm\n");
        for (const std::string& file : sums_.written)
            out += concat("wrote ", printable(file), "\n");
        return out;
    }

  private:
    size_t groupIndex() const {
        const std::vector<GroupPlan>& groups = simulation_.plan().groups;
        std::vector<std::string> names;
        for (const GroupPlan& group : groups)
            names.push_back(group.name);
        if (options_.group.empty()) {
            if (groups.size() == 1) return 0;
            throw WrongUse(concat("--group: the scene has ", groups.size(),
                                  " groups, choose one: ", joined(names, ", ")));
        }
        const auto found = std::find(names.begin(), names.end(), options_.group);
        if (found == names.end())
            throw WrongUse(concat("--group: the scene has no group \"", options_.group, "\"",
                                  suggestion(options_.group, names)));
        return size_t(found - names.begin());
    }

    size_t columnsEach() const { return options_.rigid ? 1 : group_.verticesEach(); }
    double rms() const { return sums_.vertices > 0 ? std::sqrt(sums_.squares / sums_.vertices) : 0; }

    void makeParts() {
        const size_t most = AnimationTexture::mostColumns / columnsEach();
        if (most == 0)
            throw Error("group \"", group_.name(), "\": a molecule is drawn with ", columnsEach(),
                        " vertices, and a texture has at most ", AnimationTexture::mostColumns, " columns");
        const Snapshot state = simulation_.snapshot(index_);
        for (size_t first = 0; first < molecules_; first += most) {
            Part part;
            part.first = first;
            part.count = std::min(most, molecules_ - first);
            part.name = fileName(group_.name());
            if (first > 0) part.name += concat("-", parts_.size() + 1);
            part.texture = std::make_unique<AnimationTexture>(
                fs::path(options_.vat) / (part.name + "_vat" + ending(options_.format)),
                part.count * columnsEach());
            std::vector<exchange::MoleculeState> molecules;
            for (size_t i = 0; i < part.count; ++i)
                molecules.push_back(moleculeIn(state, first + i));
            part.mesh = group_.mesh(molecules);
            part.mesh.name = part.name;
            part.turns.resize(options_.rigid ? part.count : 0, glm::dquat(1, 0, 0, 0));
            parts_.push_back(std::move(part));
        }
    }

    void add(const Snapshot& state, int frame) {
        parallel(int(parts_.size()), allThreads(), [&](int i) { add(parts_[size_t(i)], state, frame); });
    }

    void add(Part& part, const Snapshot& state, int frame) const {
        std::vector<glm::dvec3> positions;
        std::vector<glm::vec3> normals;
        for (size_t m = part.first; m < part.first + part.count; ++m) {
            if (!state.alive.empty() && !state.alive[m])
                throw Error("group \"", group_.name(), "\": molecule ", m, " does not live in frame ",
                            options_.first + frame,
                            ": an animation texture needs molecules that live throughout");
            group_.place(moleculeIn(state, m), positions, normals);
        }
        if (frame == 0) part.begin = positions;
        // The mesh is the frame that the loop begins with; rigid ones turn from their first.
        if (frame == 0 || (frame == options_.loop && !options_.rigid)) {
            part.rest = positions;
            part.mesh.normals = normals;
        }
        part.texture->add(options_.rigid ? rigidFrame(part, positions) : frameOf(part, positions, normals));
    }

    // Offsets from the very first frame; write() takes those of the mesh from them.
    static AnimationFrame frameOf(const Part& part, const std::vector<glm::dvec3>& positions,
                                  const std::vector<glm::vec3>& normals) {
        AnimationFrame out;
        out.offsets.reserve(positions.size());
        out.turns.reserve(positions.size());
        for (size_t i = 0; i < positions.size(); ++i) {
            out.offsets.push_back(exchange::toBlender(glm::vec3(positions[i] - part.begin[i])));
            out.turns.emplace_back(exchange::toBlender(normals[i]), 0);
        }
        return out;
    }

    AnimationFrame rigidFrame(Part& part, const std::vector<glm::dvec3>& positions) const {
        AnimationFrame out;
        const size_t each = group_.verticesEach();
        for (size_t m = 0; m < part.count; ++m) {
            const auto current = std::span(positions).subspan(m * each, each);
            const exchange::RigidMotion motion =
                exchange::rigidMotion(std::span(part.rest).subspan(m * each, each), current);
            glm::dquat turn = motion.turn;
            if (glm::dot(turn, part.turns[m]) < 0) turn = -turn;
            part.turns[m] = turn;
            part.worst = std::max(part.worst, motion.worst);
            part.squares += motion.squares;
            part.vertices += double(each);
            out.offsets.emplace_back(motion.middle);
            out.turns.emplace_back(turn.x, turn.y, turn.z, turn.w);
        }
        return out;
    }

    // The frames of the loop: late ones blend into those that led up to the first.
    AnimationFrame looped(Part& part, int i) const {
        const int blended = options_.frames - options_.loop;
        AnimationFrame out = part.texture->frame(size_t(options_.loop + i));
        if (i >= blended) {
            const AnimationFrame before = part.texture->frame(size_t(i - blended));
            const float share = float(i - blended + 1) / float(options_.loop + 1);
            for (size_t c = 0; c < out.offsets.size(); ++c) {
                const glm::vec3 mixed = glm::mix(out.offsets[c], before.offsets[c], share);
                part.loopShift = std::max(part.loopShift, double(glm::distance(mixed, out.offsets[c])));
                out.offsets[c] = mixed;
                const glm::vec4 other = before.turns[c];
                const float side = options_.rigid && glm::dot(other, out.turns[c]) < 0 ? -1.0f : 1.0f;
                const glm::vec4 turn = glm::mix(out.turns[c], side * other, share);
                if (glm::length(turn) > 0) out.turns[c] = glm::normalize(turn);
            }
        }
        return out;
    }

    // The mesh is the frame that the loop begins with: offsets are from there.
    void closeLoop(Part& part, const fs::path& image) const {
        auto texture = std::make_unique<AnimationTexture>(image, part.count * columnsEach());
        AnimationFrame base;
        if (!options_.rigid) base = part.texture->frame(size_t(options_.loop));
        for (int i = 0; i < options_.frames; ++i) {
            AnimationFrame frame = looped(part, i);
            for (size_t c = 0; c < base.offsets.size(); ++c)
                frame.offsets[c] -= base.offsets[c];
            texture->add(frame);
        }
        part.texture = std::move(texture);
    }

    // Textures without their meshes mean nothing: all files or none.
    void writeAll() {
        try {
            parallel(int(parts_.size()), allThreads(), [&](int i) { write(parts_[size_t(i)]); });
        } catch (const std::exception&) {
            std::error_code ignored;
            for (const Part& part : parts_)
                for (const std::string& file : part.written)
                    fs::remove(file, ignored);
            fs::remove(options_.vat, ignored);  // the folder, if nothing else is in it
            throw;
        }
    }

    void write(Part& part) const {
        const fs::path folder = options_.vat;
        const fs::path image = folder / (part.name + "_vat" + ending(options_.format));
        if (options_.loop > 0) closeLoop(part, image);
        AnimationTexture& texture = *part.texture;
        texture.write(options_.format, options_.rigid);
        part.written.push_back(image.string());
        const glm::vec3 span = texture.high() - texture.low();
        part.step = double(std::max({span.x, span.y, span.z})) * exchange::texelStep(options_.format);
        writeMesh(part, folder / (part.name + ".glb"));
        writeRemap(texture, part, folder / (part.name + "-remap_info.json"));
    }

    void writeMesh(Part& part, const fs::path& file) const {
        const size_t each = group_.verticesEach(), columns = part.count * columnsEach();
        const double row = 0.5 / double(2 * options_.frames);
        for (size_t i = 0; i < part.rest.size(); ++i)
            part.mesh.columns.emplace_back((double(options_.rigid ? i / each : i) + 0.5) / double(columns),
                                           row);
        if (options_.rigid) {
            for (size_t m = 0; m < part.count; ++m) {
                glm::dvec3 middle(0);
                for (size_t i = m * each; i < (m + 1) * each; ++i)
                    middle += part.rest[i] / double(each);
                for (size_t i = m * each; i < (m + 1) * each; ++i)
                    part.mesh.positions.emplace_back(part.rest[i] - middle);
            }
        } else {
            recentre(part.mesh, part.rest);
        }
        writeFile(file, std::span<const std::byte>(exchange::encodeGlb({part.mesh})));
        part.written.push_back(file.string());
    }

    void writeRemap(const AnimationTexture& texture, Part& part, const fs::path& file) const {
        const double rate = scene_.frameRate;
        const JsonValue clip = object(key("startFrame", 1), key("endFrame", options_.frames),
                                      key("framerate", rate), key("looping", options_.loop > 0));
        JsonValue clips = JsonValue::makeObject();
        clips.members.push_back({part.name, clip});
        JsonValue out = object(
            key("os-remap", object(key("Min", glm::dvec3(texture.low())),
                                   key("Max", glm::dvec3(texture.high())), key("Frames", options_.frames))),
            key("animations", clips));
        if (options_.rigid) append(out, key("rigid", true));
        writeFile(file, writeJson(out));
        part.written.push_back(file.string());
    }

    const ExportOptions& options_;
    const Scene& scene_;
    Simulation& simulation_;
    size_t index_;
    GroupMesh group_;
    size_t molecules_ = 0;
    std::vector<Part> parts_;
    Part sums_;  // of all parts
};

}  // namespace

std::vector<Warning> warningsOfBending(const Group& group, const GroupPlan& plan, double residual) {
    constexpr double most = 0.05;  // of its size
    double scale = 0;
    for (const float each : plan.constants.scales)
        scale = std::max(scale, double(each));
    const double size = (scale > 0 ? scale : 1) * group.molecule.size();
    if (residual <= most * size) return {};
    return {{group.location,
             concat("\"", group.name, "\" bends: rigid molecules are off by up to ", residual * 1e3, " mm, ",
                    std::round(100 * residual / size),
                    " % of their size; without --rigid, or of USD with --rigid-within, every vertex is "
                    "written")}};
}

void eachFrame(Simulation& simulation, int frames, const std::function<void(int frame)>& look) {
    Progress progress("frames", frames);
    for (int frame = 0; frame < frames && !signalThatAsked(); ++frame) {
        if (frame > 0) simulation.frame();
        simulation.check();
        look(frame);
        progress.step();
    }
}

// False: a signal came before there was anything to write.
static bool exportNow(const Options& options, const Scene& scene, Simulation& simulation) {
    const ExportOptions& asked = options.animation;
    for (int frame = 0; frame < asked.first && !signalThatAsked(); ++frame)
        simulation.frame();
    if (signalThatAsked()) return false;
    simulation.check();
    if (!asked.glb.empty()) {
        const std::vector<std::byte> bytes = exchange::encodeGlb(meshesNow(simulation, scene), scene.camera);
        writeFile(asked.glb, std::span<const std::byte>(bytes));
        if (options.json)
            std::cout << writeJson(object(key("written", std::vector<std::string>{asked.glb}),
                                          key("bytes", bytes.size()), key("frame", simulation.frames())));
        else
            std::cout << "wrote " << printable(asked.glb) << ", frame " << simulation.frames() << ", "
                      << bytes.size() << " bytes\n";
        return true;
    }
    if (!asked.usd.empty()) return exportUsd(options, scene, simulation);
    TextureExport textures(options, scene, simulation);
    if (!textures.run()) return false;
    std::cout << (options.json ? writeJson(textures.report()) : textures.text());
    return true;
}

int exportCommand(const Options& options) {
    const ExportOptions& asked = options.animation;
    if (!asked.glb.empty()) checkWritable(asked.glb);
    Loaded loaded = loadScene(options.files.front(), options);
    tellWarnings(warningsOfStart(loaded.scene, loaded.plan));
    gpu::Context context(hiddenContext(options));
    SimulationOptions simulationOptions;
    simulationOptions.path = options.path;
    simulationOptions.lanes = options.lanes;
    simulationOptions.drawn = false;
    Simulation simulation(context, std::move(loaded.plan), simulationOptions);
    const FinishesOnSignal finishes;
    if (exportNow(options, loaded.scene, simulation)) return 0;
    std::cerr << "shoal: " << stoppedBySignal() << " after frame " << simulation.frames()
              << "; nothing is written\n";
    return 0;
}

}  // namespace shoal::app
