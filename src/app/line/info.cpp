#include <algorithm>
#include <iostream>

#include "app/line/commands.h"
#include "app/line/commit.h"
#include "core/json_build.h"
#include "gpu/context.h"

namespace shoal::app {

namespace {

JsonValue asJson(const gpu::ContextProbe& probe) {
    JsonValue out = object(key("context", gpu::name(probe.kind)), key("available", probe.info.has_value()));
    if (!probe.info) return append(out, key("reason", probe.reason));
    const gpu::ContextInfo& info = *probe.info;
    std::vector<std::string> paths = {name(Path::fragments), name(Path::pingPong)};
    if (info.computeShaders) paths.insert(paths.begin(), name(Path::fused));
    return append(
        out, key("platform", info.platform), key("renderer", info.renderer), key("vendor", info.vendor),
        key("version", info.version), key("glslVersion", info.glslVersion), key("software", info.software),
        key("maxTextureSize", info.maxTextureSize), key("maxColorAttachments", info.maxColorAttachments),
        key("maxSamples", info.maxSamples), key("maxVertexTextureUnits", info.maxVertexTextureUnits),
        key("max3DTextureSize", info.max3DTextureSize), key("maxBufferTexels", info.maxBufferTexels),
        key("maxStorageBlockBytes", info.maxStorageBlockBytes), key("maxSharedBytes", info.maxSharedBytes),
        key("maxMoleculeVertices", FusedLimits::vertices(info.maxSharedBytes)),
        key("maxWorkGroupsX", info.maxWorkGroupsX), key("computeShaders", info.computeShaders),
        key("subgroups", info.subgroups), key("paths", paths));
}

void printProbe(const gpu::ContextProbe& probe) {
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
                  << " bytes shared by a work group (" << FusedLimits::vertices(info.maxSharedBytes)
                  << " vertices of a molecule)" << (info.subgroups ? ", subgroups" : "");
    std::cout << "\n  paths        " << (info.computeShaders ? "fused, " : "")
              << "fragments, ping-pong (up to " << int64_t(info.maxTextureSize) * stateWidth << " vertices)"
              << (info.computeShaders ? "" : "; compute shaders need OpenGL 4.3") << "\n";
}

}  // namespace

// "0 NVIDIA H100 80GB HBM3/PCIe/SSE2 (hardware)"
static std::string deviceText(int number, const gpu::ContextProbe& device) {
    if (!device.info) return concat(number, " not available: ", device.reason);
    return concat(number, " ", device.info->renderer, device.info->software ? " (software)" : " (hardware)");
}

static void printDevices(const std::vector<gpu::ContextProbe>& devices) {
    if (devices.empty()) return;
    std::cout << "devices of EGL, for --gpu\n";
    for (size_t i = 0; i < devices.size(); ++i)
        std::cout << "  " << deviceText(int(i), devices[i]) << "\n";
}

int infoCommand(const Options& options) {
    if (options.gpu) {
        const std::vector<gpu::ContextProbe> devices = gpu::probeDevices();
        if (size_t(*options.gpu) >= devices.size())
            throw Error("--gpu: there is no device ", *options.gpu, ", but ", devices.size());
        const gpu::ContextProbe& device = devices[size_t(*options.gpu)];
        if (options.json)
            std::cout << writeJson(asJson(device));
        else
            printProbe(device);
        return device.info ? 0 : 1;
    }
    std::vector<gpu::ContextProbe> probes = gpu::probeContexts();
    const std::vector<gpu::ContextProbe> devices = gpu::probeDevices();
    if (options.context != gpu::ContextKind::automatic)
        std::erase_if(probes, [&](const gpu::ContextProbe& probe) { return probe.kind != options.context; });
    if (options.json)
        std::cout << writeJson(object(key("version", SHOAL_VERSION), key("commit", commit()),
                                      key("contexts", arrayOf(probes, asJson)),
                                      key("devices", arrayOf(devices, asJson))));
    else {
        std::for_each(probes.begin(), probes.end(), printProbe);
        printDevices(devices);
    }
    const auto available = [](const gpu::ContextProbe& probe) { return probe.info.has_value(); };
    return std::any_of(probes.begin(), probes.end(), available) ? 0 : 1;
}

}  // namespace shoal::app
