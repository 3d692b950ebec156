#include "gpu/buffer.h"

#include "core/contract.h"

namespace shoal::gpu {

// Into the buffer that is bound. False: no memory for it. Some drivers count bytes in 32 bits, so what they
// say they have is compared with what was asked.
static bool allocate(Buffer::Use use, const void* data, size_t bytes) {
    // A size that is no GLsizeiptr becomes negative, which OpenGL refuses.
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data,
                 use == Buffer::Use::storage ? GL_DYNAMIC_COPY : GL_STATIC_DRAW);
    if (glGetError() != GL_NO_ERROR) return false;
    GLint64 got = 0;
    glGetBufferParameteri64v(GL_ARRAY_BUFFER, GL_BUFFER_SIZE, &got);
    return static_cast<size_t>(got) == bytes;
}

Buffer::Buffer(Context& context, Use use, const void* data, size_t bytes, const char* label)
    : traffic_(&context.traffic()), info_(&context.info()), use_(use), bytes_(bytes) {
    EXPECTS(bytes > 0);
    context.checkErrors("before a buffer is made");
    GLuint id = 0;
    glGenBuffers(1, &id);
    handle_ = Handle<deleteBuffer>(id);
    // Not GL_ELEMENT_ARRAY_BUFFER for indices: that binding belongs to the vertex array that is bound.
    glBindBuffer(GL_ARRAY_BUFFER, id);
    if (!allocate(use, data, bytes)) {
        throw OutOfMemory(
            concat("buffer \"", label, "\" does not fit into memory: it takes ", bytes >> 20, " MiB"));
    }
    if (data != nullptr) traffic_->countUpload(Traffic::Kind::parameters, bytes);
    labelObject(context, GL_BUFFER, id, label);
}

// Only storage is ever written by shaders.
void Buffer::settle() const {
    if (use_ == Use::storage && info_->computeShaders) barrier({Barrier::bufferUpdate});
}

void Buffer::update(Traffic::Kind kind, size_t offset, const void* data, size_t bytes) {
    EXPECTS(offset <= bytes_ && bytes <= bytes_ - offset);
    settle();
    glBindBuffer(GL_ARRAY_BUFFER, id());
    glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
    traffic_->countUpload(kind, bytes);
}

void Buffer::download(Traffic::Kind kind, size_t offset, void* data, size_t bytes) const {
    EXPECTS(offset <= bytes_ && bytes <= bytes_ - offset);
    settle();
    glBindBuffer(GL_COPY_READ_BUFFER, id());
    glGetBufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                       data);
    traffic_->countReadBack(kind, bytes);
}

void Buffer::copyTo(Buffer& other, size_t bytes) const {
    EXPECTS(&other != this && bytes <= bytes_ && bytes <= other.bytes_);
    settle();
    other.settle();
    glBindBuffer(GL_COPY_READ_BUFFER, id());
    glBindBuffer(GL_COPY_WRITE_BUFFER, other.id());
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, static_cast<GLsizeiptr>(bytes));
}

void Buffer::bindUniform(int binding) const {
    EXPECTS(use_ == Use::uniform);
    glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(binding), id());
}

void Buffer::bindStorage(int binding, size_t offset, size_t bytes) const {
    EXPECTS(use_ == Use::storage && info_->computeShaders);
    EXPECTS(bytes > 0 && offset <= bytes_ && bytes <= bytes_ - offset);
    EXPECTS(bytes <= static_cast<size_t>(info_->maxStorageBlockBytes));
    EXPECTS(offset % static_cast<size_t>(info_->storageBufferAlignment) == 0 && "see ContextInfo");
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), id(),
                      static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes));
}

static GLbitfield bit(Barrier reader) {
    switch (reader) {
    case Barrier::textureFetch:
        return GL_TEXTURE_FETCH_BARRIER_BIT;
    case Barrier::storage:
        return GL_SHADER_STORAGE_BARRIER_BIT;
    case Barrier::draw:
        return GL_COMMAND_BARRIER_BIT;
    case Barrier::command:
        return GL_COMMAND_BARRIER_BIT;
    default:
        return GL_BUFFER_UPDATE_BARRIER_BIT;
    }
}

void barrier(std::initializer_list<Barrier> readers) {
    GLbitfield bits = 0;
    for (const Barrier reader : readers)
        bits |= bit(reader);
    EXPECTS(glMemoryBarrier != nullptr && "needs OpenGL 4.3");
    glMemoryBarrier(bits);
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
    EXPECTS(buffer.use() == Buffer::Use::vertex && components >= 1 && components <= 4);
    const auto index = static_cast<GLuint>(location);
    bind();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, stride, asPointer(offset));
    glVertexAttribDivisor(index, static_cast<GLuint>(divisor));
}

void VertexArray::indices(const Buffer& buffer) {
    EXPECTS(buffer.use() == Buffer::Use::index);
    bind();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
}

void VertexArray::bind() const {
    glBindVertexArray(id());
}

}  // namespace shoal::gpu
