// Vertex, index and uniform data that is written once or rarely, storage that compute shaders read and write,
// and how shaders reach them.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>

#include "core/error.h"
#include "gpu/context.h"
#include "gpu/gl.h"

namespace shoal::gpu {

// The device has no room for something: a caller may do with less.
class OutOfMemory : public Error {
    using Error::Error;
};

class Buffer {
  public:
    enum class Use { vertex, index, uniform, storage };

    Buffer() = default;
    // Counted as parameters. `data` may be null: contents undefined, nothing counted. A context below 4.3 has
    // storage as well, which only a BufferTexture can show to its shaders.
    // OutOfMemory: says how much it would take.
    Buffer(Context& context, Use use, const void* data, size_t bytes, const char* label);
    template <typename T>
    Buffer(Context& context, Use use, std::span<const T> data, const char* label)
        : Buffer(context, use, data.data(), data.size_bytes(), label) {}

    // These three see what shaders wrote before; the caller needs no barrier.
    void update(Traffic::Kind kind, size_t offset, const void* data, size_t bytes);
    void download(Traffic::Kind kind, size_t offset, void* data, size_t bytes) const;
    void copyTo(Buffer& other, size_t bytes) const;  // the first `bytes`; nothing crosses the bus

    void bindUniform(int binding) const;  // uniform buffers: all of it
    // Storage buffers, OpenGL 4.3+. `offset`: a multiple of the context's storageBufferAlignment; `bytes`: at
    // most its maxStorageBlockBytes.
    void bindStorage(int binding, size_t offset, size_t bytes) const;

    GLuint id() const { return handle_.id(); }
    size_t bytes() const { return bytes_; }
    Use use() const { return use_; }
    explicit operator bool() const { return bool(handle_); }

  private:
    void settle() const;

    Handle<deleteBuffer> handle_;
    Traffic* traffic_ = nullptr;
    const ContextInfo* info_ = nullptr;  // the context's, which outlives the buffer and does not move
    Use use_ = Use::vertex;
    size_t bytes_ = 0;
};

// Makes what shaders wrote into storage buffers visible to later commands, which OpenGL does not do by
// itself. Needs OpenGL 4.3, like the shaders that write.
enum class Barrier : GLbitfield {
    textureFetch = GL_TEXTURE_FETCH_BARRIER_BIT,  // reading through samplers, buffer textures among them
    storage = GL_SHADER_STORAGE_BARRIER_BIT,      // reading and writing storage buffers
    command = GL_COMMAND_BARRIER_BIT,             // Program::dispatchIndirect and indirect draws
    bufferUpdate = GL_BUFFER_UPDATE_BARRIER_BIT,  // what Buffer does itself, and asks for itself
};

// Called before the command that reads, with the ways in which it reads.
void barrier(std::initializer_list<Barrier> readers);

// A buffer read as texels: texelFetch(samplerBuffer, i) is bytes 16 i to 16 i + 15 as four floats; with the
// other formats a usamplerBuffer reads whole numbers. Where a shader cannot have a storage buffer, or reads
// better through the texture cache.
//
// Names the format of a texel: samplerBuffer reads the first, usamplerBuffer the others.
enum class Texel { float4, uint4, uint2, uint1 };

class BufferTexture {
  public:
    BufferTexture() = default;
    // Borrows the buffer, which must outlive it. `offset` and `bytes` are multiples of a texel's; bytes 0: up
    // to the end. A part of the buffer needs OpenGL 4.3, and an offset that is a multiple of the context's
    // textureBufferAlignment (a contract). Error: more texels than the context allows; says how many.
    BufferTexture(Context& context, const Buffer& buffer, const char* label, size_t offset = 0,
                  size_t bytes = 0, Texel texel = Texel::float4);
    BufferTexture(Context& context, const Buffer& buffer, Texel texel, const char* label)
        : BufferTexture(context, buffer, label, 0, 0, texel) {}
    // Throws the Error of too many texels before there is a buffer.
    static void checkTexels(const ContextInfo& info, size_t texels, const char* label);

    void bind(int unit) const;

    GLuint id() const { return handle_.id(); }
    size_t texels() const { return texels_; }
    explicit operator bool() const { return bool(handle_); }

  private:
    Handle<deleteTexture> handle_;
    size_t texels_ = 0;
};

// Borrows its buffers, which must outlive it. Vertices without attributes need none (drawVertices).
class VertexArray {
  public:
    VertexArray() = default;
    explicit VertexArray(Context& context, const char* label = "");

    // Floats. stride and offset in bytes; divisor 1: one value an instance.
    void attribute(int location, const Buffer& buffer, int components, int stride, int offset,
                   int divisor = 0);
    void indices(const Buffer& buffer);
    void bind() const { glBindVertexArray(id()); }

    GLuint id() const { return handle_.id(); }
    explicit operator bool() const { return bool(handle_); }

  private:
    Handle<deleteVertexArray> handle_;
};

}  // namespace shoal::gpu
