// The text of the located Error that a call throws; empty when it throws none.
#pragma once

#include <string>

#include "core/error.h"

template <typename Call>
std::string messageOf(Call&& call) {
    try {
        call();
    } catch (const shoal::Error& error) {
        return error.what();
    }
    return {};
}
