// Which contexts this machine offers, for `shoal info`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/context.h"

namespace shoal::gpu {

struct ContextProbe {
    ContextKind kind = ContextKind::automatic;
    std::optional<ContextInfo> info;  // empty when the context cannot be had
    std::string reason;               // why not, and what to install
};

// Window, EGL and OSMesa, each tried in turn and given back. Whatever context was current stays so.
std::vector<ContextProbe> probeContexts();

}  // namespace shoal::gpu
