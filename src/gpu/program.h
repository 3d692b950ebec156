// A vertex and a fragment shader, or a compute shader, compiled and linked, with their uniforms by name.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/gl.h"
#include "gpu/texture.h"

namespace shoal::gpu {

class ArrayTable;
struct ShaderSource;

struct ProgramOptions {
    std::string vertex, fragment;                  // files below Context::shaders()
    std::vector<std::string> defines;              // "NAME", "NAME value" or requireExtension()
    std::map<std::string, std::string> generated;  // files that exist only in memory, by include name
    std::string label;
    std::string compute = {};  // a compute program: its file; vertex and fragment stay empty
    std::function<void(ShaderSource&)> rewrite = {};  // changes a stage's text once its includes are in
    const ArrayTable* arrays = nullptr;               // what its #pragma reads, writes and updates name
    double seconds = 0;  // that a CPU rasteriser takes to compile it, about; 0: not known, or not long
};

class Program {
  public:
    Program() = default;
    // Error: a file is missing, or the driver refuses; located in our file and line, with the driver's log. A
    // compute program in a context below 4.3.
    Program(Context& context, const ProgramOptions& options);

    void use() const;

    // The program must be in use. A name that the shader declares but that the compiler dropped is ignored; a
    // name that it does not declare is a mistake of ours (a contract). Arrays: the name without [0].
    void set(const char* name, int value) const { glUniform1i(location(name), value); }
    void set(const char* name, uint32_t value) const { glUniform1ui(location(name), value); }
    void set(const char* name, float value) const { glUniform1f(location(name), value); }
    void set(const char* name, const glm::ivec2& value) const { glUniform2iv(location(name), 1, &value[0]); }
    void set(const char* name, const glm::ivec4& value) const { glUniform4iv(location(name), 1, &value[0]); }
    void set(const char* name, const glm::vec2& value) const { glUniform2fv(location(name), 1, &value[0]); }
    void set(const char* name, const glm::vec3& value) const { glUniform3fv(location(name), 1, &value[0]); }
    void set(const char* name, const glm::vec4& value) const { glUniform4fv(location(name), 1, &value[0]); }
    void set(const char* name, const glm::mat3& value) const;
    void set(const char* name, const glm::mat4& value) const;
    void set(const char* name, std::span<const glm::vec4> values) const;
    void set(const char* name, std::span<const glm::ivec4> values) const;

    // Textures and storage buffers are given by the names that the shader declares; each sampler has a unit
    // of its own, and each block a binding. What a dispatch or a draw reads must have been given since the
    // program is in use (a contract, which names what is missing).
    template <typename AnyTexture>
    void texture(const char* sampler, const AnyTexture& texture) const {
        if (const int unit = unitFor(sampler, texture.id()); unit >= 0) texture.bind(unit);
    }
    void uniformBlock(const char* block, const Buffer& buffer) const;
    void storage(const char* block, const Buffer& buffer, size_t offset, size_t bytes) const;
    void storage(const char* block, const Buffer& buffer) const { storage(block, buffer, 0, buffer.bytes()); }
    // The samplers and storage blocks that the compiler kept.
    const std::vector<std::string>& samplers() const { return slots_->samplers; }
    const std::vector<std::string>& blocks() const { return slots_->blocks; }
    // The arrays that its #pragma writes and updates name, and those of them that it reads as well.
    const std::vector<std::string>& written() const { return slots_->written; }
    const std::vector<std::string>& updated() const { return slots_->updated; }
    // Compute programs, in use (a contract). At most ContextInfo::maxWorkGroupsX; 0 does nothing.
    void dispatch(int groupsX, int groupsY = 1) const;
    // Dispatches as many workgroups as three words of the buffer say, from `offset` (a multiple of 4).
    void dispatchIndirect(const Buffer& groups, size_t offset) const;
    bool uses(const char* name) const { return locations_.contains(name); }  // the compiler kept it
    bool declares(const char* block) const { return declaredBlocks_.contains(block); }  // a storage block

    GLuint id() const { return handle_.id(); }
    const std::string& label() const { return slots_->label; }
    explicit operator bool() const { return bool(handle_); }

  private:
    friend void beginPass();
    // The textures and buffers that its samplers and blocks were given last, by unit and by binding.
    struct Slots {
        std::string label;
        double expected = 0, spent = 0;  // s, of compiling it on a CPU rasteriser: about, and so far
        bool ran = false;
        std::vector<std::string> samplers, blocks, written, updated;
        std::vector<GLuint> textures, buffers;
    };

    bool inUse() const;
    GLint location(const char* name) const;
    int unitFor(const char* sampler, GLuint texture) const;
    void findSlots(const ContextInfo& info);

    Handle<deleteProgram> handle_;
    std::map<std::string, GLint, std::less<>> locations_;
    std::shared_ptr<Slots> slots_ = std::make_shared<Slots>();  // at one place when the program is moved
    std::set<std::string, std::less<>> declared_;               // uniforms
    std::set<std::string, std::less<>> declaredBlocks_;         // storage blocks
};

// Called before a draw. Checks that all that the program in use reads is where it was given (a contract), and
// records the pass (gpu/frame_record.h).
void beginPass();

// The first use of a program, when rasterisers compile it.
struct FirstUse {
    std::string label;
    double expected = 0;  // s, about, of compiling it; 0: not known
    double seconds = 0;   // so far
};
// Returns what is being made or used for the first time, for any thread to ask; an empty label: nothing is.
FirstUse firstUse();
// Ends the first use: there is none from here on.
void endFirstUse();

// Programs of one owner by what they are made of: whoever asks for the same gets the same program, under the
// label of the first. So many equal groups compile once.
class Programs {
  public:
    // `fixed`: what else must be equal, for uniforms that are set only once. What `rewrite` does must follow
    // from the other options. The program stays where it is as long as this does. Error: Program's.
    const Program& get(Context& context, const ProgramOptions& options, const std::string& fixed = {});

  private:
    std::map<std::string, Program> made_;
};

}  // namespace shoal::gpu
