#include "scene/scene.h"

namespace shoal {

const char* name(FieldSampling sampling) {
    static constexpr const char* names[] = {"vertexSubstep", "vertexFrame", "moleculeFrame"};
    return names[size_t(sampling)];
}

const char* name(ContactSearch search) {
    static constexpr const char* names[] = {"exact", "single", "staggered"};
    return names[size_t(search)];
}

const char* name(ContactResponse response) {
    static constexpr const char* names[] = {"simultaneous", "nearest"};
    return names[size_t(response)];
}

}  // namespace shoal
