#include "gpu/frame_record.h"

#include <algorithm>
#include <cctype>

#include "core/contract.h"

namespace shoal::gpu {

static FrameRecord* recording = nullptr;
static uint64_t passesSoFar = 0;

FrameRecord::FrameRecord() {
    EXPECTS(!recording);
    recording = this;
}

FrameRecord::~FrameRecord() {
    recording = nullptr;
}

uint64_t FrameRecord::passes() {
    return passesSoFar;
}

void FrameRecord::enter(const char* stage) {
    if (recording) recording->stage_ = stage;
}

// A block has the name of its array, with a capital.
void FrameRecord::add(const std::string& pass, const std::vector<std::string>& samplers,
                      const std::vector<std::string>& blocks, const std::vector<std::string>& written,
                      const std::vector<std::string>& updated) {
    ++passesSoFar;
    if (!recording) return;
    PassRow row{recording->stage_, pass, 0, samplers, {}};
    row.reads.insert(row.reads.end(), updated.begin(), updated.end());
    for (std::string block : blocks) {
        block[0] = char(std::tolower(static_cast<unsigned char>(block[0])));
        row.writes.push_back(block);
    }
    if (blocks.empty()) row.writes = written;
    std::vector<PassRow>& rows = recording->rows_;
    auto known = std::find_if(rows.begin(), rows.end(), [&](const PassRow& other) {
        return other.stage == row.stage && other.pass == row.pass && other.reads == row.reads &&
               other.writes == row.writes;
    });
    if (known == rows.end()) {
        const auto last = std::find_if(rows.rbegin(), rows.rend(),
                                       [&](const PassRow& other) { return other.stage == row.stage; });
        known = rows.insert(last == rows.rend() ? rows.end() : last.base(), row);
    }
    ++known->times;
}

}  // namespace shoal::gpu
