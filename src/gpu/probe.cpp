#include "gpu/context.h"

#include <exception>

#include "core/error.h"

namespace shoal::gpu {

static ContextProbe probe(ContextKind kind) {
    ContextProbe result;
    result.kind = kind;
    try {
        ContextOptions options;
        options.kind = kind;
        options.width = options.height = 64;
        options.visible = false;
        result.info = Context(options).info();
    } catch (const std::exception& error) {
        result.reason = error.what();
    }
    return result;
}

std::vector<ContextProbe> probeContexts() {
    Context::State* before = Context::current();
    std::vector<ContextProbe> out;
    for (const ContextKind kind : {ContextKind::window, ContextKind::egl, ContextKind::osmesa}) {
        out.push_back(probe(kind));
    }
    Context::restore(before);
    return out;
}

}  // namespace shoal::gpu
