// A broken contract ends the program and says which and where, in every build that is tested.
#include "core/contract.h"
#include "support/catch.h"
#include "support/end_of.h"

using shoal::test::End;
using shoal::test::endOf;

TEST_CASE("a broken contract ends the program and says which", "[contract]") {
    const int three = 3;
    const End broken = endOf([&] { EXPECTS(1 + 1 == three && "sums are right"); });
    CHECK(broken.signal == SIGABRT);
    CHECK_THAT(broken.said, Catch::Contains("test_contract.cpp:") &&
                                Catch::Contains(": broken contract: 1 + 1 == three && \"sums are right\""));
    const End kept = endOf([&] { EXPECTS(1 + 2 == three); });
    CHECK(kept.signal == 0);
    CHECK(kept.said.empty());
}
