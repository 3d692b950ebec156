// What the GPU is asked to do, pass by pass, on whatever path: the dispatches, draws and copies of a frame
// while a record of it is kept.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace shoal::gpu {

struct PassRow {
    std::string stage;  // as PassTimers names it; empty: outside of them
    std::string pass;   // the program's label, or which copy it is
    int times = 0;      // dispatches, draws or copies
    // Arrays and textures by the names that the shader declares; a storage block that is read and written is
    // among `writes`, and so are colour targets of an array.
    std::vector<std::string> reads, writes;
};

class FrameRecord {
  public:
    // Begins; there is one at a time (a contract).
    FrameRecord();
    ~FrameRecord();
    FrameRecord(const FrameRecord&) = delete;
    FrameRecord& operator=(const FrameRecord&) = delete;

    // The stages in the order in which each was first entered, and so the passes of each.
    const std::vector<PassRow>& rows() const { return rows_; }

    // For PassTimers, Program and Framebuffer; nothing is kept while there is no record.
    static uint64_t passes();  // so far, recorded or not
    static void enter(const char* stage);
    static void add(const std::string& pass, const std::vector<std::string>& samplers,
                    const std::vector<std::string>& blocks, const std::vector<std::string>& written,
                    const std::vector<std::string>& updated);

  private:
    std::string stage_;
    std::vector<PassRow> rows_;
};

}  // namespace shoal::gpu
