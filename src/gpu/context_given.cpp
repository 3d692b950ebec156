// The caller's own context, which is current and stays so: Shoal as a part of another program.
#include "gpu/platform.h"

namespace shoal::gpu {

namespace {

class GivenPlatform final : public Platform {
  public:
    explicit GivenPlatform(Loader given) : loader_(given) {}
    void makeCurrent() override {}  // by the caller
    void release() override {}
    Loader loader() const override { return loader_; }
    std::string description() const override { return "the caller's"; }

  private:
    Loader loader_;
};

}  // namespace

std::unique_ptr<Platform> createGivenPlatform(const ContextOptions& options) {
    return std::make_unique<GivenPlatform>(options.loader);
}

}  // namespace shoal::gpu
