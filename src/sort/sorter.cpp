#include "sort/sorter.h"

#include <algorithm>

#include "core/contract.h"
#include "core/error.h"

namespace shoal {

using Kind = gpu::Traffic::Kind;

namespace {

constexpr SortMethodRow methods[] = {
    {SortMethod::oddEvenMerge, "odd-even merge", false, 3, 3, true, false},
    {SortMethod::bitonic, "bitonic", false, 3, 3, true, true},
    {SortMethod::radix, "radix", true, 4, 3, false, false},
    {SortMethod::cpu, "cpu", true, 3, 3, false, false},  // read back, std::stable_sort, uploaded
};

}  // namespace

std::span<const SortMethodRow> sortMethods() {
    return methods;
}

const SortMethodRow& row(SortMethod method) {
    const SortMethodRow& found = methods[size_t(method)];
    EXPECTS(found.method == method);
    return found;
}

bool canRun(SortMethod method, const gpu::ContextInfo& info) {
    return info.atLeast(row(method).major, row(method).minor);
}

Sorter::Sorter(gpu::Context& context, SortMethod method, size_t capacity, int rowLength)
    : method_(method), capacity_(capacity) {
    if (row(method).network) {
        const auto kind =
            method == SortMethod::bitonic ? NetworkSort::Kind::bitonic : NetworkSort::Kind::oddEvenMerge;
        network_ = std::make_unique<NetworkSort>(context, kind, capacity, rowLength);
        return;
    }
    if (method == SortMethod::radix) radix_ = std::make_unique<RadixSort>(context, capacity);
    const size_t bytes = std::max<size_t>(capacity, 1) * sizeof(KeyIndex);
    buffer_ = gpu::Buffer(context, gpu::Buffer::Use::storage, nullptr, bytes, "pairs");
}

void Sorter::upload(std::span<const KeyIndex> pairs) {
    EXPECTS(pairs.size() <= capacity_);
    count_ = pairs.size();
    if (!network_) {
        if (count_ > 0) buffer_.update(Kind::state, 0, pairs.data(), pairs.size_bytes());
        return;
    }
    network_->setCount(count_);
    const auto length = size_t(network_->rowLength());
    const int width = network_->pairs().width();
    std::vector<KeyIndex> rows(pairs.begin(), pairs.end());
    rows.resize((count_ + length - 1) / length * length);
    if (rows.empty()) return;
    network_->pairs().upload(Kind::state, 0, 0, width, int(rows.size() / length), rows.data(),
                             rows.size() * sizeof(KeyIndex));
}

std::vector<KeyIndex> Sorter::download() const {
    if (network_) return network_->download();
    std::vector<KeyIndex> out(count_);
    if (count_ > 0) buffer_.download(Kind::state, 0, out.data(), count_ * sizeof(KeyIndex));
    return out;
}

int Sorter::passes() const {
    return radix_ ? radix_->passes(count_, 32) : network_ ? network_->passes() : 0;
}

void Sorter::sort(int keyBits) {
    if (radix_)
        radix_->sort(buffer_, count_, keyBits);
    else if (network_)
        network_->sort();
    else
        sortOnCpu();
}

void Sorter::sortOnCpu() {
    std::vector<KeyIndex> pairs = download();
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const KeyIndex& a, const KeyIndex& b) { return a.key < b.key; });
    upload(pairs);
}

NetworkSort& Sorter::network() {
    EXPECTS(network_);
    return *network_;
}

}  // namespace shoal
