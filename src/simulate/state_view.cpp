#include "simulate/state_view.h"

namespace shoal {

std::vector<SharedState> sharedState(const StateView& view, size_t group) {
    std::vector<SharedState> out;
    if (!view.buffers) return out;
    const GroupBuffers& buffers = (*view.buffers)[group];
    for (const GroupBuffers::Part& part : buffers.parts()) {
        const GroupBuffers::Range state = buffers.currentState(part), records = buffers.records(part);
        out.push_back({.buffer = state.buffer->id(),
                       .anchors = records.buffer->id(),
                       .offset = state.offset,
                       .bytes = state.bytes,
                       .anchorOffset = records.offset,
                       .anchorBytes = records.bytes,
                       .first = part.first,
                       .count = part.count,
                       .elements = buffers.layout().positionElements(),
                       .stride = buffers.layout().stateElements()});
    }
    return out;
}

}  // namespace shoal
