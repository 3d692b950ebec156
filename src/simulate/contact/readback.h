// Contacts that were found and remembered, read back and written, in either form of the arrays.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "simulate/contact/data.h"
#include "simulate/contact/memory.h"
#include "simulate/execution_path.h"

namespace shoal {

// Contacts that were left out, of all steps so far.
uint32_t droppedContacts(const ContactData& data);
// With buffers, how the iterations of the last step ended.
ContactConvergence convergenceOf(const ContactData& data);
// In fragments, the largest residual that the last batch of iterations has left.
float largestResidual(const ContactData& data);
// Each pair of touching spheres once, ascending.
std::vector<std::pair<int, int>> foundPairs(const ContactData& data);
// Empty: nothing is remembered.
ContactMemory readMemory(const ContactData& data);
// Memory of another number of spheres is dropped.
void writeMemory(ContactData& data, const ContactMemory& memory);

}  // namespace shoal
