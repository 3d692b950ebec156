#include "gpu/buffer.h"

#include <cassert>

#include "core/error.h"
#include "gpu/debug_group.h"

namespace shoal::gpu {

Buffer::Buffer(Context& context, Use use, const void* data, size_t bytes, const char* label)
    : traffic_(&context.traffic()), use_(use), bytes_(bytes) {
    assert(bytes > 0);
    context.checkErrors("before a buffer is made");
    GLuint id = 0;
    glGenBuffers(1, &id);
    handle_ = Handle<deleteBuffer>(id);
    // Not GL_ELEMENT_ARRAY_BUFFER for indices: that binding belongs to the vertex array that is bound.
    glBindBuffer(GL_ARRAY_BUFFER, id);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
    if (glGetError() != GL_NO_ERROR) {
        throw Error(concat("buffer \"", label, "\" does not fit into memory: it takes ",
                           double(bytes) / (1 << 20), " MiB"));
    }
    if (data != nullptr) traffic_->countUpload(Traffic::Kind::parameters, bytes);
    labelObject(context, GL_BUFFER, id, label);
}

void Buffer::update(Traffic::Kind kind, size_t offset, const void* data, size_t bytes) {
    assert(offset + bytes <= bytes_);
    glBindBuffer(GL_ARRAY_BUFFER, id());
    glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
    traffic_->countUpload(kind, bytes);
}

void Buffer::bindUniform(int binding) const {
    assert(use_ == Use::uniform);
    glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(binding), id());
}

VertexArray::VertexArray(Context& context, const char* label) {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    handle_ = Handle<deleteVertexArray>(id);
    glBindVertexArray(id);  // an object exists, and can be labelled, once it was bound
    labelObject(context, GL_VERTEX_ARRAY, id, label);
}

// OpenGL takes an offset as a pointer, for reasons of history.
static const void* asPointer(int offset) {
    return reinterpret_cast<const void*>(static_cast<intptr_t>(offset));
}

void VertexArray::attribute(int location, const Buffer& buffer, int components, int stride, int offset,
                            int divisor) {
    assert(buffer.use() == Buffer::Use::vertex && components >= 1 && components <= 4);
    const auto index = static_cast<GLuint>(location);
    bind();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, stride, asPointer(offset));
    glVertexAttribDivisor(index, static_cast<GLuint>(divisor));
}

void VertexArray::indices(const Buffer& buffer) {
    assert(buffer.use() == Buffer::Use::index);
    bind();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
}

void VertexArray::bind() const {
    glBindVertexArray(id());
}

}  // namespace shoal::gpu
