// Contacts that were found and remembered, read back and written, in either form of the arrays.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "simulate/contact/data.h"
#include "simulate/contact/memory.h"

namespace shoal {

// Contacts that were left out, of all steps so far.
uint32_t droppedContacts(const ContactData& data);
// Each pair of touching spheres once, ascending.
std::vector<std::pair<int, int>> foundPairs(const ContactData& data);
// Empty: nothing is remembered.
ContactMemory readMemory(const ContactData& data);
// Memory of another number of spheres is dropped.
void writeMemory(ContactData& data, const ContactMemory& memory);

}  // namespace shoal
