#include "unit/shader_validator.h"

#include <optional>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "compile/contact_plan.h"
#include "compile/generate.h"
#include "compile/generate_forces.h"
#include "gpu/array_table.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/every_kind.h"
#include "support/shapes.h"

namespace shoal::test {

const char* const header300es =
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp sampler3D;\n"
    "precision highp sampler2DShadow;\n"
    "precision highp sampler2DArray;\n"
    "precision highp usampler2D;\n"
    "precision highp usampler2DArray;\n";

bool hasValidator() {
    static const bool found = std::system("glslangValidator --version >/dev/null 2>&1") == 0;
    if (!found)
        WARN("skipped: glslangValidator is not installed (on Debian and Ubuntu: apt install glslang-tools)");
    return found;
}

namespace {

struct Output {
    bool ok = false;
    std::string log;
};

Output validate(const std::string& files) {
    std::FILE* pipe = ::popen(("glslangValidator " + files + " 2>&1").c_str(), "r");
    if (!pipe) return {false, "glslangValidator cannot be started"};
    Output out;
    char chunk[4096];
    while (const size_t count = std::fread(chunk, 1, sizeof chunk, pipe))
        out.log.append(chunk, count);
    out.ok = ::pclose(pipe) == 0;
    return out;
}

}  // namespace

std::string complaint(const std::string& file, const gpu::ShaderSource& source) {
    const Output output = validate(file);
    return output.ok ? std::string() : source.rewriteLog(output.log);
}

void Validator::add(const std::string& file, const Defines& defines, const char* header) {
    add(file, defines, header, resolve(file, defines, generated, header));
}

gpu::ShaderSource Validator::resolve(const std::string& file, const Defines& defines,
                                     const std::map<std::string, std::string>& texts,
                                     const char* header) const {
    using Form = gpu::ArrayTable::Form;
    const std::string root = std::string(SHOAL_SOURCE_DIR) + "/shaders";
    std::optional<gpu::ArrayTable> table;
    const bool compute = std::string_view(header) == gpu::header430();
    if (!arrays.empty())
        table.emplace(concat(root, "/", arrays, "/arrays.txt"), compute ? Form::buffers : Form::textures,
                      holds);
    return gpu::resolveShader(root, file, defines, texts, header, table ? &*table : nullptr);
}

void Validator::addContact(const std::string& pass, const ContactFacts& facts, const ContactGroupFacts& group,
                           Defines defines) {
    arrays = "contact";
    holds = facts.names();
    for (const auto& [name, text] : group.files())
        generated[name] = text;
    for (const Defines& more : {facts.defines(), group.defines()})
        defines.insert(defines.end(), more.begin(), more.end());
    defines.insert(defines.end(), {"LIST 24", "NEIGHBORS 4", "AHEAD 4", concat("NEAR ", ContactPlan::near),
                                   concat("MOST_COLLIDERS ", ContactPlan::mostColliders)});
    const std::string file = concat("contact/", pass, ".pass.glsl");
    if (!facts.textures) return add(file, defines, gpu::header430());
    defines.emplace_back("ROW_BITS 6");
    addBoth(file, defines);
}

void Validator::addKernel(const Plan& plan, const KernelOptions& options) {
    const gpu::ProgramOptions program = kernelProgram(plan, 0, options);
    for (const std::string& file : {program.compute, program.vertex, program.fragment}) {
        if (file.empty()) continue;
        for (const char* header :
             options.targets ? std::vector{gpu::header330(), header300es} : std::vector{gpu::header430()}) {
            gpu::ShaderSource source = resolve(file, program.defines, program.generated, header);
            program.rewrite(source);
            add(file, program.defines, header, std::move(source));
        }
    }
}

void Validator::addFragments(const Plan& plan, KernelOptions options) {
    options.targets = 4;
    const auto add = [&](bool need, KernelOptions::Work work) {
        options.work = work;
        if (need) addKernel(plan, options);
    };
    add(true, KernelOptions::Work::frame);
    add(true, KernelOptions::Work::watch);
    add(plan.groups[0].needs.normals, KernelOptions::Work::normals);
    add(plan.contact.any(), KernelOptions::Work::touched);
    add(plan.groups[0].life.has_value(), KernelOptions::Work::births);
}

// All that gpu::flag says of shaders of pictures.
static constexpr std::array picturesFlags = {
    "PLANE",          "GRID",         "METALLIC",     "GRAINY",
    "STONY",          "COLOR_IMAGE",  "NORMAL_IMAGE", "ROUGHNESS_IMAGE",
    "EMISSIVE_IMAGE", "CUT",          "REFRACTS",     "HOLES",
    "BLENDED",        "SHADOWS",      "WIDE_SHADOWS", "LINEAR_LIGHT",
    "CLOUDS",         "BEAMS",        "OCCLUSION",    "CLEAR",
    "LINEAR",         "TEXTURED",     "GROWS",        "SKIN_OFFSETS",
    "COLOR_BY",       "SCALED",       "AGES",         "SIZES",
    "TURNS",          "IMAGE",        "FADES",        "LIT",
    "SOFT",           "ORDER_PAIRED", "SLABS",
};

void Validator::addPicture(const std::string& file, Defines defines) {
    const auto has = [&defines](const char* name) {
        return std::find(defines.begin(), defines.end(), name) != defines.end();
    };
    const bool ofBuffers = has("ORDER_BUFFER") || has("SLAB_DRAWS") || has("BLOCK 64");
    const bool inTextures = has("TEXTURES");
    for (const char* name : picturesFlags) {
        const bool wanted = has(name);
        defines.erase(std::remove(defines.begin(), defines.end(), name), defines.end());
        defines.push_back(gpu::constant(name, wanted));
    }
    for (const bool layered : {false, true}) {
        if (layered && !inTextures) break;
        if (!layered && inTextures && has("LIFE")) continue;  // the ping-pong path has no births
        if (layered) {
            std::replace(defines.begin(), defines.end(), std::string("TEXTURES"), std::string("LAYERED"));
            defines.insert(defines.end(), {"POSITION_ELEMENTS 3", "STATE_ELEMENTS 6"});
        }
        add(file, defines, gpu::header330());
        if (!ofBuffers) add(file, defines, header300es);
    }
}

void Validator::addBoth(const std::string& file, Defines defines) {
    defines.emplace_back("TEXTURES");
    add(file, defines, gpu::header330());
    add(file, defines, header300es);
}

void Validator::check() const {
    std::string all;
    for (const Shader& shader : shaders_)
        all += shader.path + " ";
    REQUIRE(!all.empty());
    const bool sound = validate(all).ok;
    CHECK(sound);
    if (sound) return;
    for (const Shader& shader : shaders_) {
        INFO(shader.what);
        CHECK(complaint(shader.path, shader.source) == "");
    }
}

void Validator::add(const std::string& file, const Defines& defines, const char* header,
                    gpu::ShaderSource source) {
    if (!seen_.insert(source.text).second) return;
    std::string stage = file.substr(file.rfind('.'));
    if (stage == ".glsl") stage = std::string_view(header) == gpu::header430() ? ".comp" : ".frag";
    const std::string path = scratch_.write("shader" + std::to_string(seen_.size()) + stage, source.text);
    std::string what =
        file + " as " + std::string(header).substr(0, std::string(header).find('\n')) + ", defines:";
    for (const std::string& define : defines)
        what += " " + define;
    shaders_.push_back({path, what, std::move(source)});
}

std::vector<Field> fieldsToValidate() {
    std::vector<Field> out = everyField();
    GridField wrapped;
    wrapped.resolution = {2, 1, 1};
    wrapped.high = {1, 1, 1};
    wrapped.values.resize(2);
    wrapped.wrap = true;
    CurlNoiseField eddies;
    eddies.octaves = 4;
    eddies.seed = 0xffffffffu;  // beyond an int
    GustField vertical;
    vertical.direction = {0, 1, 0};
    out.push_back(field(eddies));
    out.push_back(field(vertical, true));
    out.push_back(field(std::move(wrapped), true));
    return out;
}

std::vector<Collider> collidersToValidate() {
    std::vector<Collider> out;
    for (KindOfCollider& kind : kindsOfCollider())
        out.emplace_back().shape = std::move(kind.shape);
    return out;
}

std::vector<Force> forcesToValidate() {
    std::vector<Force> out = everyForce();
    for (size_t i = 0; i < out.size(); ++i)
        out[i].name = concat("force ", i, "\n}}} #error \\");  // must not leave its comment
    return out;
}

std::vector<Defines> combinations(const Defines& words) {
    std::vector<Defines> out;
    for (size_t bits = 0; bits < size_t(1) << words.size(); ++bits) {
        Defines set;
        for (size_t i = 0; i < words.size(); ++i)
            if (bits >> i & 1) set.push_back(words[i]);
        out.push_back(std::move(set));
    }
    return out;
}

std::map<std::string, std::string> generate(const std::vector<Field>& fields,
                                            const std::vector<Collider>& colliders) {
    std::vector<glm::vec4> samples;
    return {{"generated/fields.glsl", generateFields(fields, samples).source},
            {"generated/scene_forces.glsl", generateForces(forcesToValidate(), "", true).source},
            {"generated/colliders.glsl", generateColliders(colliders, samples).source},
            {"generated/stages.glsl", kernelText({}, {}, solver(SolverKind::rk4), false).stages}};
}

Scene leafScene(const Defines& words, SolverKind solver, FieldSampling sampling) {
    const auto has = [&](const char* word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    Scene scene;
    scene.solver = {solver, 32, sampling, {}};
    Group group;
    group.name = "leaf\n}}} #error \\";  // must not leave its comment
    group.molecule = leaf(200, 1);
    group.count = 1;
    if (has("muscles")) group.molecule.springs[2].actuation = Actuation{0.1, 1, 0};
    if (has("instances differ")) group.place.scale = {0.5, 0.6}, group.phaseSpread = 1;
    if (!has("springs")) group.molecule.springs.clear();
    if (!has("triangles")) group.molecule.triangles.clear();
    group.drag = has("drag by direction") ? Drag{4, 1} : Drag{1, 1};
    group.molecule.vertices[1].pinned = has("pins") || has("release");
    if (has("release")) group.release = Release{1.0, 1.0, 0};
    if (has("fields")) scene.fields = fieldsToValidate();
    if (has("colliders")) scene.colliders = collidersToValidate();
    if (has("forces")) scene.forces = forcesToValidate();
    scene.groups.push_back(std::move(group));
    return scene;
}

}  // namespace shoal::test
