// Contracts: what only a programmer can get wrong, checked in every build that we test and ship.
//
// EXPECTS(condition) ends the program with file, line and the broken condition. The condition must be cheap
// and must have no effect, since -DSHOAL_CONTRACTS=OFF leaves it out. What a user can get wrong throws
// `Error` (core/error.h).
#pragma once

namespace shoal {

// Prints "file:line: broken contract: condition" to standard error and aborts.
[[noreturn]] void contractBroken(const char* file, int line, const char* condition);

}  // namespace shoal

#ifdef SHOAL_NO_CONTRACTS
#define EXPECTS(...) static_cast<void>(sizeof((__VA_ARGS__) ? 1 : 0))
#else
#define EXPECTS(...) \
    ((__VA_ARGS__) ? static_cast<void>(0) : ::shoal::contractBroken(__FILE__, __LINE__, #__VA_ARGS__))
#endif
