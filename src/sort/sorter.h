// One interface for four ways to sort pairs of a key and an index: for tests, for benchmarks, and for who
// wants an order of things on the GPU whatever the context can do. Keys are whole numbers.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "sort/network_sort.h"
#include "sort/radix_sort.h"

namespace shoal {

enum class SortMethod { oddEvenMerge, bitonic, radix, cpu };

struct SortMethodRow {
    SortMethod method;
    const char* name;
    bool stable;       // equal keys stay in their order
    int major, minor;  // OpenGL that it needs
    bool network;      // of passes in textures
    bool rowsOnly;     // sortRows()
};
std::span<const SortMethodRow> sortMethods();
const SortMethodRow& row(SortMethod method);
bool canRun(SortMethod method, const gpu::ContextInfo& info);

class Sorter {
  public:
    // rowLength: networks only, see NetworkSort. Error: the context cannot run the method, or not hold so
    // many.
    Sorter(gpu::Context& context, SortMethod method, size_t capacity, int rowLength = 0);

    // Sets the number of pairs, at most the capacity. Counted as state, like the download.
    void upload(std::span<const KeyIndex> pairs);
    // Ascending, by all 32 bits; radix: by the low `keyBits`.
    void sort(int keyBits = 32);
    void sortRows() { network().sortRows(); }                        // bitonic
    void beginSpread(int frames) { network().beginSpread(frames); }  // odd-even merge
    void advance() { network().advance(); }
    std::vector<KeyIndex> download() const;

    SortMethod method() const { return method_; }
    size_t count() const { return count_; }
    int passes() const;  // of sort() by all bits, over the pairs that were uploaded; 0 on the CPU
    // The pairs on the GPU where they lie in a buffer (radix, cpu); else null: the networks' lie in textures.
    gpu::Buffer* buffer() { return buffer_ ? &buffer_ : nullptr; }

  private:
    void sortOnCpu();
    NetworkSort& network();

    SortMethod method_;
    size_t capacity_, count_ = 0;
    gpu::Buffer buffer_;
    std::unique_ptr<RadixSort> radix_;
    std::unique_ptr<NetworkSort> network_;
};

}  // namespace shoal
