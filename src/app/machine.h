// What a report of times says of the machine.
#pragma once

#include <string>

namespace shoal::app {

std::string processorName();

// "3 s", "12 minutes": an estimate for people.
std::string roughly(double seconds);

}  // namespace shoal::app
