#include <iostream>

#include "app/commands.h"
#include "core/json.h"
#include "gpu/context.h"

namespace shoal::app {

namespace {

JsonValue asJson(const gpu::ContextProbe& probe) {
    JsonValue entry = JsonValue::makeObject();
    entry.add("context", JsonValue::makeString(gpu::name(probe.kind)))
        .add("available", JsonValue::makeBoolean(probe.info.has_value()));
    if (!probe.info) return entry.add("reason", JsonValue::makeString(probe.reason));
    const gpu::ContextInfo& info = *probe.info;
    JsonValue paths = JsonValue::makeArray();
    if (info.computeShaders) paths.items.push_back(JsonValue::makeString(name(Path::fused)));
    paths.items.push_back(JsonValue::makeString(name(Path::pingPong)));
    return entry.add("platform", JsonValue::makeString(info.platform))
        .add("renderer", JsonValue::makeString(info.renderer))
        .add("vendor", JsonValue::makeString(info.vendor))
        .add("version", JsonValue::makeString(info.version))
        .add("glslVersion", JsonValue::makeString(info.glslVersion))
        .add("software", JsonValue::makeBoolean(info.software))
        .add("maxTextureSize", JsonValue::makeNumber(info.maxTextureSize))
        .add("maxColorAttachments", JsonValue::makeNumber(info.maxColorAttachments))
        .add("maxSamples", JsonValue::makeNumber(info.maxSamples))
        .add("maxVertexTextureUnits", JsonValue::makeNumber(info.maxVertexTextureUnits))
        .add("max3DTextureSize", JsonValue::makeNumber(info.max3DTextureSize))
        .add("maxBufferTexels", JsonValue::makeNumber(double(info.maxBufferTexels)))
        .add("maxStorageBlockBytes", JsonValue::makeNumber(double(info.maxStorageBlockBytes)))
        .add("maxSharedBytes", JsonValue::makeNumber(info.maxSharedBytes))
        .add("maxWorkGroupsX", JsonValue::makeNumber(info.maxWorkGroupsX))
        .add("computeShaders", JsonValue::makeBoolean(info.computeShaders))
        .add("subgroups", JsonValue::makeBoolean(info.subgroups))
        .add("paths", std::move(paths));
}

void print(const gpu::ContextProbe& probe) {
    std::cout << gpu::name(probe.kind) << "\n";
    if (!probe.info) {
        std::cout << "  not available: " << probe.reason << "\n";
        return;
    }
    const gpu::ContextInfo& info = *probe.info;
    std::cout << "  platform     " << info.platform << "\n  renderer     " << info.renderer << " ("
              << (info.software ? "software" : "hardware") << ")\n  OpenGL       " << info.version
              << ", GLSL " << info.glslVersion << "\n  limits       textures " << info.maxTextureSize
              << " a side, " << info.maxColorAttachments << " draw buffers, " << info.maxSamples
              << " samples, " << info.maxVertexTextureUnits << " vertex texture units\n               "
              << info.maxBufferTexels << " buffer texels";
    if (info.computeShaders)
        std::cout << ", storage blocks of " << info.maxStorageBlockBytes << " bytes, " << info.maxSharedBytes
                  << " bytes shared by a work group" << (info.subgroups ? ", subgroups" : "");
    std::cout << "\n  paths        " << (info.computeShaders ? "fused, " : "") << "ping-pong (up to "
              << int64_t(info.maxTextureSize) * stateWidth << " vertices)"
              << (info.computeShaders ? "" : "; fused needs OpenGL 4.3") << "\n";
}

}  // namespace

int infoCommand(const Options& options) {
    std::vector<gpu::ContextProbe> probes = gpu::probeContexts();
    if (options.context != gpu::ContextKind::automatic)
        std::erase_if(probes, [&](const gpu::ContextProbe& probe) { return probe.kind != options.context; });
    JsonValue contexts = JsonValue::makeArray();
    bool any = false;
    for (const gpu::ContextProbe& probe : probes) {
        any |= probe.info.has_value();
        if (options.json)
            contexts.items.push_back(asJson(probe));
        else
            print(probe);
    }
    if (options.json) {
        JsonValue report = JsonValue::makeObject();
        report.add("version", JsonValue::makeString(SHOAL_VERSION)).add("contexts", std::move(contexts));
        std::cout << writeJson(report);
    }
    return any ? 0 : 1;
}

}  // namespace shoal::app
