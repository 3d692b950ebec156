#include "gpu/named_arrays.h"

#include <cctype>
#include <set>

namespace shoal::gpu {

void NamedArrays::bind(const Program& program) const {
    for (const std::string& name : program.samplers()) {
        const auto found = arrays_.find(name);
        if (found == arrays_.end()) continue;
        const Entry& entry = found->second;
        if (entry.array && entry.array->texture) program.texture(name.c_str(), entry.array->texture);
        if (entry.texture && *entry.texture) program.texture(name.c_str(), *entry.texture);
    }
    std::string name;
    for (const std::string& block : program.blocks()) {
        name = block;
        name[0] = char(std::tolower(name[0]));
        const auto found = arrays_.find(name);
        if (found == arrays_.end()) continue;
        const Entry& entry = found->second;
        if (entry.array && entry.array->buffer) program.storage(block.c_str(), entry.array->buffer);
        if (entry.buffer && *entry.buffer) program.storage(block.c_str(), *entry.buffer);
    }
}

size_t NamedArrays::bytes() const {
    std::set<const void*> counted;
    size_t out = 0;
    const auto add = [&](const auto* what) {
        if (what && *what && counted.insert(what).second) out += what->bytes();
    };
    for (const auto& [name, entry] : arrays_) {
        if (entry.array) add(&entry.array->buffer);
        add(entry.buffer);
        add(entry.texture);
    }
    return out;
}

}  // namespace shoal::gpu
