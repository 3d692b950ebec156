#include "sort/network.h"

#include "core/contract.h"

namespace shoal {

size_t powerOfTwoAbove(size_t count) {
    size_t power = 1;
    while (power < count)
        power *= 2;
    return power;
}

std::vector<OddEvenPass> oddEvenMergePasses(size_t count) {
    std::vector<OddEvenPass> out;
    for (size_t run = 1; run < count; run *= 2) {
        for (size_t distance = run; distance >= 1; distance /= 2)
            out.push_back({int(run), int(distance)});
    }
    return out;
}

std::vector<BitonicPass> bitonicPasses(size_t block) {
    EXPECTS(block == powerOfTwoAbove(block));
    if (block == 2) return {{0, false, true, false}};
    std::vector<BitonicPass> out;
    for (size_t merged = 4; merged <= block; merged *= 2) {  // elements
        size_t mask = merged / 2 - 1;                        // texels
        out.push_back({int(mask), true, merged == 4, false});
        for (mask = merged / 8; mask >= 1; mask /= 2)
            out.push_back({int(mask), false, false, false});
        out.back().last = true;
    }
    return out;
}

}  // namespace shoal
