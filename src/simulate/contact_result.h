// Gives tests, benchmarks and reports the results of contact between molecules, on either path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace shoal {

class ContactResult {
  public:
    virtual ~ContactResult() = default;
    // Contacts that were left out, of all steps so far, because a sphere touched more than a list holds.
    virtual uint32_t dropped() const = 0;
    // Contacts that the last step found, as numbers of spheres (compile/contact_plan.h), the smaller first,
    // ascending. For tests and reports: reads the lists back.
    virtual std::vector<std::pair<int, int>> found() const = 0;
    virtual int listLength() const = 0;  // contacts that one sphere may have
    virtual size_t bytes() const = 0;    // on the device
};

}  // namespace shoal
