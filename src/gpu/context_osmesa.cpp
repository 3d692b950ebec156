// A context of OSMesa: Mesa's CPU rasteriser as a plain library, opened when asked for.
//
// Mesa removed OSMesa in 25.1, so that it is optional at run time, and its header, which GLEW does not
// tolerate, is not included.
#include <dlfcn.h>

#include <array>
#include <vector>

#include "core/error.h"
#include "gpu/platform.h"

// From OSMesa's published interface, version 12.
using OSMesaContext = struct osmesa_context*;
using OSMESAproc = void (*)();
#define OSMESA_RGBA 0x1908
#define OSMESA_FORMAT 0x22
#define OSMESA_DEPTH_BITS 0x30
#define OSMESA_PROFILE 0x33
#define OSMESA_CORE_PROFILE 0x34
#define OSMESA_CONTEXT_MAJOR_VERSION 0x36
#define OSMESA_CONTEXT_MINOR_VERSION 0x37
#define GL_UNSIGNED_BYTE 0x1401

namespace shoal::gpu {
namespace {

struct OsmesaApi {
    OSMesaContext (*createContextAttribs)(const int* attributes, OSMesaContext share) = nullptr;
    void (*destroyContext)(OSMesaContext context) = nullptr;
    unsigned char (*makeCurrent)(OSMesaContext context, void* buffer, unsigned type, int width,
                                 int height) = nullptr;
    OSMESAproc (*getProcAddress)(const char* name) = nullptr;

    OsmesaApi() {
        void* library = nullptr;
        for (const char* file : {"libOSMesa.so.8", "libOSMesa.so"}) {
            if (library == nullptr) library = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
        }
        if (library == nullptr) throw Error("libOSMesa.so.8 is not installed");
        load(library, createContextAttribs, "OSMesaCreateContextAttribs");
        load(library, destroyContext, "OSMesaDestroyContext");
        load(library, makeCurrent, "OSMesaMakeCurrent");
        load(library, getProcAddress, "OSMesaGetProcAddress");
    }

    template <typename Function>
    static void load(void* library, Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(library, name));
        if (function == nullptr) throw Error(concat("libOSMesa has no ", name));
    }
};

// Once per process and never closed: Mesa's threads and exit handlers do not survive that.
const OsmesaApi& osmesa() {
    static const OsmesaApi api;
    return api;
}

class OsmesaPlatform final : public Platform {
  public:
    OsmesaPlatform() {
        for (const AskedVersion version : askedVersions) {
            std::vector<int> attributes = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24};
            if (!version.any())
                attributes.insert(attributes.end(),
                                  {OSMESA_PROFILE, OSMESA_CORE_PROFILE, OSMESA_CONTEXT_MAJOR_VERSION,
                                   version.major, OSMESA_CONTEXT_MINOR_VERSION, version.minor});
            attributes.push_back(0);
            context_ = osmesa().createContextAttribs(attributes.data(), nullptr);
            if (context_ != nullptr) return;
        }
        throw Error("libOSMesa makes no context");
    }
    ~OsmesaPlatform() override { osmesa().destroyContext(context_); }

    void makeCurrent() override {
        if (osmesa().makeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == 0)
            throw Error("OSMesa's context cannot be made current");
    }
    void release() override { osmesa().makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
    Loader loader() const override { return osmesa().getProcAddress; }
    std::string description() const override { return "OSMesa"; }

  private:
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4> pixel_ = {};  // the framebuffer that OSMesa insists on
};

}  // namespace

std::unique_ptr<Platform> createOsmesaPlatform(const ContextOptions&) {
    return std::make_unique<OsmesaPlatform>();
}

}  // namespace shoal::gpu
