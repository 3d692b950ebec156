#include "gpu/buffer.h"

#include "core/contract.h"

namespace shoal::gpu {

// Allocates and fills the bound buffer. Returns whether there was memory for it. Some drivers count bytes in
// 32 bits, so the size that they report is compared with the one that was asked for.
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
    handle_ = Handle<deleteBuffer>(glGenBuffers);
    // Not GL_ELEMENT_ARRAY_BUFFER for indices: that binding belongs to the vertex array that is bound.
    glBindBuffer(GL_ARRAY_BUFFER, id());
    if (!allocate(use, data, bytes))
        throw OutOfMemory(
            concat("buffer \"", label, "\" does not fit into memory: it takes ", bytes >> 20, " MiB"));
    if (data != nullptr) traffic_->countUpload(Traffic::Kind::parameters, bytes);
    labelObject(context, GL_BUFFER, id(), label);
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

void barrier(std::initializer_list<Barrier> readers) {
    GLbitfield bits = 0;
    for (const Barrier reader : readers)
        bits |= static_cast<GLbitfield>(reader);
    EXPECTS(glMemoryBarrier != nullptr && "needs OpenGL 4.3");
    glMemoryBarrier(bits);
}

// ---- Buffer textures

static std::pair<GLenum, size_t> formatAndBytes(Texel texel) {
    static constexpr std::pair<GLenum, size_t> formats[] = {
        {GL_RGBA32F, 16}, {GL_RGBA32UI, 16}, {GL_RG32UI, 8}, {GL_R32UI, 4}};
    return formats[size_t(texel)];
}

BufferTexture::BufferTexture(Context& context, const Buffer& buffer, const char* label, size_t offset,
                             size_t bytes, Texel texel) {
    const auto [format, texelBytes] = formatAndBytes(texel);
    EXPECTS(buffer && offset < buffer.bytes() && bytes <= buffer.bytes() - offset);
    if (bytes == 0) bytes = buffer.bytes() - offset;
    const bool whole = bytes == buffer.bytes();
    EXPECTS(offset % texelBytes == 0 && bytes % texelBytes == 0);
    EXPECTS((whole || context.info().atLeast(4, 3)) && "a part of a buffer needs OpenGL 4.3");
    EXPECTS((whole || offset % size_t(context.info().textureBufferAlignment) == 0) && "see ContextInfo");
    texels_ = bytes / texelBytes;
    checkTexels(context.info(), texels_, label);
    handle_ = Handle<deleteTexture>(glGenTextures);
    bindToEdit(GL_TEXTURE_BUFFER, id());
    if (whole)
        glTexBuffer(GL_TEXTURE_BUFFER, format, buffer.id());
    else
        glTexBufferRange(GL_TEXTURE_BUFFER, format, buffer.id(), static_cast<GLintptr>(offset),
                         static_cast<GLsizeiptr>(bytes));
    labelObject(context, GL_TEXTURE, id(), label);
}

void BufferTexture::checkTexels(const ContextInfo& info, size_t texels, const char* label) {
    const auto most = static_cast<size_t>(info.maxBufferTexels);
    if (texels <= most) return;
    throw Error(concat("buffer texture \"", label, "\" of ", texels,
                       " texels is too large: this context allows ", most));
}

void BufferTexture::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_BUFFER, id());
}

// ---- Vertex arrays

VertexArray::VertexArray(Context& context, const char* label) : handle_(glGenVertexArrays) {
    bind();  // an object exists, and can be labelled, once it was bound
    labelObject(context, GL_VERTEX_ARRAY, id(), label);
}

void VertexArray::attribute(int location, const Buffer& buffer, int components, int stride, int offset,
                            int divisor) {
    EXPECTS(buffer.use() == Buffer::Use::vertex && components >= 1 && components <= 4);
    const auto index = static_cast<GLuint>(location);
    bind();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glEnableVertexAttribArray(index);
    // OpenGL takes an offset as a pointer, for reasons of history.
    const auto* start = reinterpret_cast<const void*>(static_cast<intptr_t>(offset));
    glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, stride, start);
    glVertexAttribDivisor(index, static_cast<GLuint>(divisor));
}

void VertexArray::indices(const Buffer& buffer) {
    EXPECTS(buffer.use() == Buffer::Use::index);
    bind();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
}

}  // namespace shoal::gpu
