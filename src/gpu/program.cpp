#include "gpu/program.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include <glm/gtc/type_ptr.hpp>

#include "core/contract.h"
#include "core/error.h"
#include "core/printable.h"
#include "gpu/frame_record.h"
#include "gpu/program_cache.h"
#include "gpu/shader_source.h"

namespace shoal::gpu {
namespace {

std::string logOf(GLuint object, PFNGLGETSHADERIVPROC get, PFNGLGETSHADERINFOLOGPROC getLog) {
    GLint length = 0;
    get(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length) + 1, '\0');
    getLog(object, length + 1, nullptr, log.data());
    return log.c_str();  // up to the first zero, wherever the driver put it
}

struct Stage {
    GLenum type;
    const char* name;
    ShaderSource source;
};

std::vector<Stage> readStages(const std::string& root, const ProgramOptions& options) {
    const auto resolve = [&](const std::string& file, const char* header) {
        ShaderSource source =
            resolveShader(root, file, options.defines, options.generated, header, options.arrays);
        if (options.rewrite) options.rewrite(source);
        return source;
    };
    std::vector<Stage> out;
    if (!options.compute.empty()) {
        EXPECTS(options.vertex.empty() && options.fragment.empty() && "a compute program has one stage");
        out.push_back({GL_COMPUTE_SHADER, "compute", resolve(options.compute, header430())});
    } else {
        out.push_back({GL_VERTEX_SHADER, "vertex", resolve(options.vertex, header330())});
        out.push_back({GL_FRAGMENT_SHADER, "fragment", resolve(options.fragment, header330())});
    }
    return out;
}

Handle<deleteShader> compile(const Stage& stage, const std::string& label) {
    const ShaderSource& source = stage.source;
    Handle<deleteShader> shader(glCreateShader(stage.type));
    const char* text = source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled != GL_TRUE) {
        const std::string log = logOf(shader.id(), glGetShaderiv, glGetShaderInfoLog);
        throw Error(source.firstLocation(log),
                    concat("the ", stage.name, " shader of program \"", label, "\" does not compile\n  ",
                           indented(source.rewriteLog(log))));
    }
    return shader;
}

void compileAndLink(GLuint program, const std::vector<Stage>& stages, const ProgramOptions& options,
                    const std::string& label) {
    std::vector<Handle<deleteShader>> shaders;
    shaders.reserve(stages.size());
    for (const Stage& stage : stages)
        shaders.push_back(compile(stage, label));
    for (const auto& shader : shaders)
        glAttachShader(program, shader.id());
    glLinkProgram(program);
    for (const auto& shader : shaders)
        glDetachShader(program, shader.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return;
    const std::string files =
        options.compute.empty() ? options.vertex + " and " + options.fragment : options.compute;
    throw Error(concat("program \"", label, "\" (", files, ") does not link\n  ",
                       indented(logOf(program, glGetProgramiv, glGetProgramInfoLog))));
}

// Returns the name by which a uniform is asked for: light for light[0], and light.color as it is.
std::string withoutIndex(std::string name) {
    if (name.size() > 3 && name.compare(name.size() - 3, 3, "[0]") == 0) name.resize(name.size() - 3);
    return name;
}

bool isSampler(GLenum type) {
    switch (type) {
    case GL_SAMPLER_2D:
    case GL_SAMPLER_3D:
    case GL_SAMPLER_2D_SHADOW:
    case GL_SAMPLER_2D_ARRAY:
    case GL_SAMPLER_BUFFER:
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_BUFFER:
        return true;
    default:
        return false;
    }
}

// Calls visit(name, type) for each uniform that is used.
template <typename Visit>
void forUniforms(GLuint program, const Visit& visit) {
    GLint count = 0, longest = 0;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    glGetProgramiv(program, GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
    std::string name(static_cast<size_t>(longest) + 1, '\0');
    for (GLint i = 0; i < count; ++i) {
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(program, static_cast<GLuint>(i), longest + 1, nullptr, &size, &type, name.data());
        visit(name.c_str(), type);
    }
}

// The program that use() took last, for contracts: asking the driver at each uniform would make it wait.
GLuint lastUsed = 0;
// The texture at each unit and the buffer at each binding, as far as programs have put them there.
std::vector<GLuint> textureAt, bufferAt;

void put(std::vector<GLuint>& names, size_t place, GLuint what) {
    if (names.size() <= place) names.resize(place + 1);
    names[place] = what;
}

std::mutex firstGuard;
FirstUse first;
std::chrono::steady_clock::time_point firstBegan;
std::atomic<bool> isFirst = false;

void beginFirstUse(FirstUse use) {
    const std::lock_guard lock(firstGuard);
    first = std::move(use);
    firstBegan = std::chrono::steady_clock::now();
    isFirst = true;
}

struct EndsFirstUse {
    ~EndsFirstUse() { endFirstUse(); }
};

}  // namespace

Program::Program(Context& context, const ProgramOptions& options) {
    slots_->label = !options.label.empty()     ? options.label
                    : !options.compute.empty() ? options.compute
                                               : options.fragment;
    const ContextInfo& info = context.info();
    slots_->expected = info.software ? options.seconds : 0;
    if (!options.compute.empty() && !info.computeShaders)
        throw Error(
            concat("compute shaders need OpenGL 4.3; this context has ", info.major, ".", info.minor));
    if (context.shaders().empty())
        throw Error(
            "the context has no shaders: ContextOptions::shaders is their folder (share/shoal/shaders "
            "where Shoal is installed)");
    const std::vector<Stage> stages = readStages(context.shaders(), options);
    for (const Stage& stage : stages)
        for (const std::string& file : stage.source.files)
            if (file.rfind(context.shaders(), 0) == 0) context.noteShaderFile(file);
    handle_ = Handle<deleteProgram>(glCreateProgram());
    const EndsFirstUse ends;  // also where it is refused
    beginFirstUse({slots_->label, slots_->expected});
    if (!context.cache().active()) {
        compileAndLink(id(), stages, options, slots_->label);
    } else {
        context.checkErrors("before a program is made");
        std::vector<std::string_view> texts;
        texts.reserve(stages.size());
        for (const Stage& stage : stages)
            texts.emplace_back(stage.source.text);
        const std::string key = programKey(info, texts);
        if (!context.cache().load(key, id())) {
            compileAndLink(id(), stages, options, slots_->label);
            context.cache().store(key, id());
        }
    }
    slots_->spent = firstUse().seconds;
    for (const Stage& stage : stages) {
        for (const std::string* text : {&stage.source.text, &stage.source.leftOut})
            declared_.merge(declared(*text, "uniform"));
        declaredBlocks_.merge(declared(stage.source.text, "buffer"));
        slots_->written.insert(slots_->written.end(), stage.source.written.begin(),
                               stage.source.written.end());
        slots_->updated.insert(slots_->updated.end(), stage.source.updated.begin(),
                               stage.source.updated.end());
    }
    findSlots(info);
    labelObject(context, GL_PROGRAM, id(), slots_->label.c_str());
}

void Program::findSlots(const ContextInfo& info) {
    forUniforms(id(), [&](const char* name, GLenum type) {
        const GLint location = glGetUniformLocation(id(), name);
        if (location < 0) return;  // a member of a block
        locations_.emplace(withoutIndex(name), location);
        if (isSampler(type)) slots_->samplers.emplace_back(name);
    });
    slots_->textures.resize(slots_->samplers.size());
    for (const std::string& block : declaredBlocks_) {
        const GLuint index = glGetProgramResourceIndex(id(), GL_SHADER_STORAGE_BLOCK, block.c_str());
        if (index == GL_INVALID_INDEX) continue;  // the compiler left it out
        glShaderStorageBlockBinding(id(), index, static_cast<GLuint>(slots_->blocks.size()));
        slots_->blocks.push_back(block);
    }
    slots_->buffers.resize(slots_->blocks.size());
    constexpr size_t mostBlocks = 8;  // that OpenGL 4.3 promises
    EXPECTS(slots_->blocks.size() <= mostBlocks);
    if (slots_->samplers.size() <= size_t(info.maxTextureUnits)) return;
    throw Error(concat("program \"", slots_->label, "\" reads ", slots_->samplers.size(),
                       " textures; this context has units for ", info.maxTextureUnits));
}

// The slots of the program in use.
static std::weak_ptr<void> slotsInUse;

void Program::use() const {
    glUseProgram(id());
    lastUsed = id();
    slotsInUse = slots_;
    if (slots_->ran) return endFirstUse();
    beginFirstUse({slots_->label, slots_->expected, slots_->spent});
}

void beginPass() {
    const std::shared_ptr<void> used = slotsInUse.lock();
    if (!used) return;
    auto& slots = *static_cast<Program::Slots*>(used.get());
    slots.ran = true;
    FrameRecord::add(slots.label, slots.samplers, slots.blocks, slots.written, slots.updated);
#ifndef SHOAL_NO_CONTRACTS
    const auto check = [](const std::vector<std::string>& names, const std::vector<GLuint>& given,
                          const std::vector<GLuint>& bound) {
        for (size_t i = 0; i < names.size(); ++i)
            if (given[i] == 0 || given[i] != bound[i])
                contractBroken(__FILE__, __LINE__,
                               concat("the program in use was not given \"", names[i], "\"").c_str());
    };
    check(slots.samplers, slots.textures, textureAt);
    check(slots.blocks, slots.buffers, bufferAt);
#endif
}

FirstUse firstUse() {
    const std::lock_guard lock(firstGuard);
    if (!isFirst) return {};
    FirstUse out = first;
    out.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - firstBegan).count();
    return out;
}

void endFirstUse() {
    isFirst = false;
}

bool Program::inUse() const {
    return id() != 0 && lastUsed == id();
}

GLint Program::location(const char* name) const {
    EXPECTS(inUse() && "use() goes before set()");
    const std::string_view word(name);
    const auto found = locations_.find(word);
    if (found != locations_.end()) return found->second;
    EXPECTS(declared_.count(word.substr(0, word.find_first_of(".["))) == 1 &&
            "no such uniform in the shader");
    return -1;  // which OpenGL ignores
}

int Program::unitFor(const char* sampler, GLuint texture) const {
    const GLint where = location(sampler);
    if (where < 0) return -1;
    const auto& names = slots_->samplers;
    const size_t unit = size_t(std::find(names.begin(), names.end(), sampler) - names.begin());
    EXPECTS(unit < names.size() && "it is a sampler");
    if (slots_->textures[unit] == 0) glUniform1i(where, static_cast<GLint>(unit));
    slots_->textures[unit] = texture;
    put(textureAt, unit, texture);
    return int(unit);
}

void Program::set(const char* name, const glm::mat3& value) const {
    glUniformMatrix3fv(location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, std::span<const glm::ivec4> values) const {
    if (values.empty()) return;
    glUniform4iv(location(name), static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
}

void Program::set(const char* name, std::span<const glm::vec4> values) const {
    if (values.empty()) return;
    glUniform4fv(location(name), static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
}

void Program::uniformBlock(const char* block, const Buffer& buffer) const {
    const GLuint index = glGetUniformBlockIndex(id(), block);
    EXPECTS(declared_.count(std::string_view(block)) == 1 && "no such block in the shader");
    if (index == GL_INVALID_INDEX) return;
    glUniformBlockBinding(id(), index, index);
    buffer.bindUniform(static_cast<int>(index));
}

void Program::storage(const char* block, const Buffer& buffer, size_t offset, size_t bytes) const {
    EXPECTS(declaredBlocks_.count(std::string_view(block)) == 1 && "no such storage block in the shader");
    const auto& names = slots_->blocks;
    const size_t binding = size_t(std::find(names.begin(), names.end(), block) - names.begin());
    if (binding == names.size()) return;  // the compiler left it out
    slots_->buffers[binding] = buffer.id();
    put(bufferAt, binding, buffer.id());
    buffer.bindStorage(static_cast<int>(binding), offset, bytes);
}

void Program::dispatch(int groupsX, int groupsY) const {
    EXPECTS(inUse() && "use() goes before dispatch()");
    EXPECTS(groupsX >= 0 && groupsY >= 0);
    beginPass();
    glDispatchCompute(static_cast<GLuint>(groupsX), static_cast<GLuint>(groupsY), 1);
}

void Program::dispatchIndirect(const Buffer& groups, size_t offset) const {
    EXPECTS(inUse() && "use() goes before dispatchIndirect()");
    EXPECTS(offset % 4 == 0 && offset + 3 * sizeof(uint32_t) <= groups.bytes());
    beginPass();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, groups.id());
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
}

const Program& Programs::get(Context& context, const ProgramOptions& options, const std::string& fixed) {
    std::string key;
    const auto add = [&key](const std::string& part) {
        key += std::to_string(part.size()) + ":";  // so that parts cannot run into each other
        key += part;
    };
    for (const std::string* part : {&options.vertex, &options.fragment, &options.compute, &fixed})
        add(*part);
    for (const std::string& define : options.defines)
        add(define);
    for (const auto& [name, text] : options.generated) {
        add(name);
        add(text);
    }
    const auto found = made_.find(key);
    if (found != made_.end()) return found->second;
    return made_.emplace(std::move(key), Program(context, options)).first->second;
}

}  // namespace shoal::gpu
