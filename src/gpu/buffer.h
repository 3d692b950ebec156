// Vertex, index and uniform data that is written once or rarely, storage that compute shaders read and write,
// and how shaders reach them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/error.h"
#include "gpu/context.h"
#include "gpu/handle.h"

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

// Borrows its buffers, which must outlive it. One without attributes is what a draw needs that makes its
// vertices from gl_VertexID.
class VertexArray {
  public:
    VertexArray() = default;
    explicit VertexArray(Context& context, const char* label = "");

    // Floats. stride and offset in bytes; divisor 1: one value an instance.
    void attribute(int location, const Buffer& buffer, int components, int stride, int offset,
                   int divisor = 0);
    void indices(const Buffer& buffer);
    void bind() const;

    GLuint id() const { return handle_.id(); }
    explicit operator bool() const { return bool(handle_); }

  private:
    Handle<deleteVertexArray> handle_;
};

}  // namespace shoal::gpu
