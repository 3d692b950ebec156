// Link-time OpenGL symbols that follow the context which is current, whatever library it came from.
//
// Why this exists. Two kinds of OpenGL function are bound when the program is linked, to the system's
// libGL, which knows nothing of a context made by OSMesa or by EGL's surfaceless platform:
//   * glXGetProcAddressARB, through which a stock GLEW asks for everything else. Under OSMesa glewInit would
//     fail; asked through the context's own loader it finds every pointer.
//   * the functions of OpenGL 1.0 and 1.1 (glClear, glDrawArrays, …). GLEW never loads those; they are plain
//     symbols.
// This file defines both, and forwards each call to the loader of the current context (gpu/platform.h). A
// symbol that the executable defines goes before the one in a shared library, so GLEW's calls arrive here as
// well. When no context of ours is current, or in a window for the functions of GLX itself, the call goes on
// to the next definition, which is the system's libGL.
//
// The file is an object library that consumers of `gpu` inherit: in an archive the linker would leave it out
// or resolve some of its symbols from libGL. Pointers are found at the first call after a context of another
// kind became current; after that a call costs one comparison and one jump.
#include <dlfcn.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "gpu/gl.h"
#include "gpu/platform.h"

namespace {

using shoal::gpu::currentLoader;
using shoal::gpu::Procedure;

// The system's own definition, if there is one.
Procedure systemProcedure(const char* name) {
    void* found = dlsym(RTLD_NEXT, name);
    if (found == nullptr) {
        if (void* library = dlopen("libGL.so.1", RTLD_LAZY | RTLD_LOCAL)) found = dlsym(library, name);
    }
    return reinterpret_cast<Procedure>(found);
}

// `self` is the forwarder: a loader that answers with it would never return.
Procedure findProcedure(const char* name, Procedure self) {
    Procedure found = currentLoader.load != nullptr ? currentLoader.load(name) : nullptr;
    if (found == nullptr || found == self) found = systemProcedure(name);
    if (found == nullptr || found == self) {
        std::fprintf(stderr, "shoal: no OpenGL library provides %s\n", name);
        std::abort();
    }
    return found;
}

// The threads of two contexts may look at once, and find the same.
template <typename Function>
struct Forward {
    std::atomic<Function> function;
    std::atomic<unsigned> generation;  // of the loader that found it; 0: not looked for yet

    Function get(const char* name, Function self) {
        if (generation.load(std::memory_order_acquire) != currentLoader.generation) {
            function = reinterpret_cast<Function>(findProcedure(name, reinterpret_cast<Procedure>(self)));
            generation.store(currentLoader.generation, std::memory_order_release);
        }
        return function.load(std::memory_order_relaxed);
    }
};

}  // namespace

#define EXPORTED __attribute__((visibility("default")))
#define FORWARD(Result, name, parameters, arguments)  \
    EXPORTED Result GLAPIENTRY name parameters {      \
        static Forward<decltype(&name)> forward = {}; \
        return forward.get(#name, &name) arguments;   \
    }

extern "C" {

EXPORTED Procedure glXGetProcAddressARB(const GLubyte* name);

EXPORTED Procedure glXGetProcAddressARB(const GLubyte* name) {
    const char* word = reinterpret_cast<const char*>(name);
    const bool isGlx = std::strncmp(word, "glX", 3) == 0;
    // Loaders may answer any name with a stub, so GLX must not be asked for where there is none: GLEW would
    // call it.
    if (isGlx && currentLoader.load != nullptr && !currentLoader.isWindow) return nullptr;
    if (!isGlx && currentLoader.load != nullptr) return currentLoader.load(word);
    using Self = Procedure (*)(const GLubyte*);
    const auto real = reinterpret_cast<Self>(systemProcedure("glXGetProcAddressARB"));
    return real != nullptr && real != &glXGetProcAddressARB ? real(name) : nullptr;
}

// OpenGL 1.0, as far as the core profile of 3.3 has it.
FORWARD(void, glCullFace, (GLenum mode), (mode))
FORWARD(void, glFrontFace, (GLenum mode), (mode))
FORWARD(void, glHint, (GLenum target, GLenum mode), (target, mode))
FORWARD(void, glLineWidth, (GLfloat width), (width))
FORWARD(void, glPointSize, (GLfloat size), (size))
FORWARD(void, glPolygonMode, (GLenum face, GLenum mode), (face, mode))
FORWARD(void, glScissor, (GLint x, GLint y, GLsizei w, GLsizei h), (x, y, w, h))
FORWARD(void, glTexParameterf, (GLenum t, GLenum name, GLfloat v), (t, name, v))
FORWARD(void, glTexParameterfv, (GLenum t, GLenum name, const GLfloat* v), (t, name, v))
FORWARD(void, glTexParameteri, (GLenum t, GLenum name, GLint v), (t, name, v))
FORWARD(void, glTexParameteriv, (GLenum t, GLenum name, const GLint* v), (t, name, v))
FORWARD(void, glTexImage1D,
        (GLenum t, GLint level, GLint kept, GLsizei w, GLint border, GLenum format, GLenum type,
         const void* data),
        (t, level, kept, w, border, format, type, data))
FORWARD(void, glTexImage2D,
        (GLenum t, GLint level, GLint kept, GLsizei w, GLsizei h, GLint border, GLenum format, GLenum type,
         const void* data),
        (t, level, kept, w, h, border, format, type, data))
FORWARD(void, glDrawBuffer, (GLenum buffer), (buffer))
FORWARD(void, glClear, (GLbitfield mask), (mask))
FORWARD(void, glClearColor, (GLclampf r, GLclampf g, GLclampf b, GLclampf a), (r, g, b, a))
FORWARD(void, glClearStencil, (GLint s), (s))
FORWARD(void, glClearDepth, (GLclampd depth), (depth))
FORWARD(void, glStencilMask, (GLuint mask), (mask))
FORWARD(void, glColorMask, (GLboolean r, GLboolean g, GLboolean b, GLboolean a), (r, g, b, a))
FORWARD(void, glDepthMask, (GLboolean flag), (flag))
FORWARD(void, glDisable, (GLenum cap), (cap))
FORWARD(void, glEnable, (GLenum cap), (cap))
FORWARD(void, glFinish, (), ())
FORWARD(void, glFlush, (), ())
FORWARD(void, glBlendFunc, (GLenum source, GLenum target), (source, target))
FORWARD(void, glLogicOp, (GLenum operation), (operation))
FORWARD(void, glStencilFunc, (GLenum func, GLint ref, GLuint mask), (func, ref, mask))
FORWARD(void, glStencilOp, (GLenum fail, GLenum zfail, GLenum zpass), (fail, zfail, zpass))
FORWARD(void, glDepthFunc, (GLenum func), (func))
FORWARD(void, glPixelStoref, (GLenum name, GLfloat v), (name, v))
FORWARD(void, glPixelStorei, (GLenum name, GLint v), (name, v))
FORWARD(void, glReadBuffer, (GLenum buffer), (buffer))
FORWARD(void, glReadPixels, (GLint x, GLint y, GLsizei w, GLsizei h, GLenum format, GLenum type, void* data),
        (x, y, w, h, format, type, data))
FORWARD(void, glGetBooleanv, (GLenum name, GLboolean* v), (name, v))
FORWARD(void, glGetDoublev, (GLenum name, GLdouble* v), (name, v))
FORWARD(GLenum, glGetError, (), ())
FORWARD(void, glGetFloatv, (GLenum name, GLfloat* v), (name, v))
FORWARD(void, glGetIntegerv, (GLenum name, GLint* v), (name, v))
FORWARD(const GLubyte*, glGetString, (GLenum name), (name))
FORWARD(void, glGetTexImage, (GLenum t, GLint level, GLenum format, GLenum type, void* data),
        (t, level, format, type, data))
FORWARD(void, glGetTexParameterfv, (GLenum t, GLenum name, GLfloat* v), (t, name, v))
FORWARD(void, glGetTexParameteriv, (GLenum t, GLenum name, GLint* v), (t, name, v))
FORWARD(void, glGetTexLevelParameterfv, (GLenum t, GLint level, GLenum name, GLfloat* v), (t, level, name, v))
FORWARD(void, glGetTexLevelParameteriv, (GLenum t, GLint level, GLenum name, GLint* v), (t, level, name, v))
FORWARD(GLboolean, glIsEnabled, (GLenum cap), (cap))
FORWARD(void, glDepthRange, (GLclampd from, GLclampd to), (from, to))
FORWARD(void, glViewport, (GLint x, GLint y, GLsizei w, GLsizei h), (x, y, w, h))

// OpenGL 1.1, likewise; and glGetPointerv, which came back with 4.3.
FORWARD(void, glDrawArrays, (GLenum mode, GLint first, GLsizei count), (mode, first, count))
FORWARD(void, glDrawElements, (GLenum mode, GLsizei count, GLenum type, const void* indices),
        (mode, count, type, indices))
FORWARD(void, glGetPointerv, (GLenum name, void** v), (name, v))
FORWARD(void, glPolygonOffset, (GLfloat factor, GLfloat units), (factor, units))
FORWARD(void, glCopyTexImage1D,
        (GLenum t, GLint level, GLenum kept, GLint x, GLint y, GLsizei w, GLint border),
        (t, level, kept, x, y, w, border))
FORWARD(void, glCopyTexImage2D,
        (GLenum t, GLint level, GLenum kept, GLint x, GLint y, GLsizei w, GLsizei h, GLint border),
        (t, level, kept, x, y, w, h, border))
FORWARD(void, glCopyTexSubImage1D, (GLenum t, GLint level, GLint to, GLint x, GLint y, GLsizei w),
        (t, level, to, x, y, w))
FORWARD(void, glCopyTexSubImage2D,
        (GLenum t, GLint level, GLint toX, GLint toY, GLint x, GLint y, GLsizei w, GLsizei h),
        (t, level, toX, toY, x, y, w, h))
FORWARD(void, glTexSubImage1D,
        (GLenum t, GLint level, GLint x, GLsizei w, GLenum format, GLenum type, const void* data),
        (t, level, x, w, format, type, data))
FORWARD(void, glTexSubImage2D,
        (GLenum t, GLint level, GLint x, GLint y, GLsizei w, GLsizei h, GLenum format, GLenum type,
         const void* data),
        (t, level, x, y, w, h, format, type, data))
FORWARD(void, glBindTexture, (GLenum target, GLuint id), (target, id))
FORWARD(void, glDeleteTextures, (GLsizei count, const GLuint* ids), (count, ids))
FORWARD(void, glGenTextures, (GLsizei count, GLuint* ids), (count, ids))
FORWARD(GLboolean, glIsTexture, (GLuint id), (id))

}  // extern "C"
