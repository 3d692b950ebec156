// What is required of a run, and how much of its time its diagnostics take.
#include <set>

#include "core/error.h"
#include "measure/stretches.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace shoal {

using namespace measure;

TEST_CASE("requirements are read, and mistakes in them told", "[diagnostics]") {
    const std::vector<Requirement> read = requirementsOf(" overlap < 1e-4,error<1e-3");
    REQUIRE(read.size() == 2);
    CHECK(read[0].quantity == Diagnostic::overlap);
    CHECK(read[0].limit == 1e-4);
    CHECK(read[1].quantity == Diagnostic::error);
    CHECK(read[1].text == "error<1e-3");
    const auto told = [](const char* text) { return messageOf([&] { requirementsOf(text); }); };
    CHECK(told("eror<1e-3") == "unknown quantity \"eror\" (did you mean \"error\"?)");
    CHECK(told("error<1e-3x") == "expected a number above 0 behind \"error<\", found \"1e-3x\"");
    CHECK(told("error<-1") == "expected a number above 0 behind \"error<\", found \"-1\"");
    CHECK(told("error<") == "expected a number above 0 behind \"error<\", found \"\"");
    CHECK(told("error>1") ==
          "expected a quantity, \"<\" and a number, such as strain<0.01, found \"error>1\"");
    CHECK(told("error<1,") == "expected a quantity, \"<\" and a number, such as strain<0.01, found \"\"");
}

TEST_CASE("a reading breaks what it is above, and at the end what is not known", "[diagnostics]") {
    const Requirement strain = requirementsOf("strain<0.1").front(),
                      error = requirementsOf("error<0.1").front();
    Reading reading;
    reading.frame = 30;
    reading.time = 0.5;
    CHECK(whyBroken(strain, reading, false).empty());
    CHECK(whyBroken(strain, reading, true) == "strain is not known by the end, frame 30");
    reading[Diagnostic::strain] = 0.05;
    CHECK(whyBroken(strain, reading, true).empty());
    reading[Diagnostic::strain] = 0.1;
    reading.places[size_t(Diagnostic::strain)] = "molecule 3 of \"leaf\"";
    CHECK(whyBroken(strain, reading, false) == "strain is 0.1 at 0.5 s, frame 30, molecule 3 of \"leaf\"");
    reading[Diagnostic::error] = 0.01;
    reading.judged = 32;
    CHECK(whyBroken(error, reading, true).empty());
    reading.unknown = 1;
    CHECK(whyBroken(error, reading, false).find("1 of 32 molecules") != std::string::npos);
}

TEST_CASE("what took a second is waited for until it was its share", "[diagnostics]") {
    Duty duty(0.01);
    CHECK(duty.allows(0));
    duty.took(1, 5);
    CHECK_FALSE(duty.allows(104));
    CHECK(duty.allows(105));
    duty.took(1, 105);
    duty.took(0.5, 106);
    CHECK_FALSE(duty.allows(254));
    CHECK(duty.allows(255));
}

TEST_CASE("a sample goes through all molecules", "[diagnostics]") {
    for (const int count : {0, 1, 31, 32, 33, 100}) {
        MovingSample sample(count, 32);
        std::set<int> seen;
        for (int i = 0; i < (count + 31) / 32; ++i) {
            const MoleculeRange range = sample.next();
            CHECK(range.count == std::min(count, 32));
            for (int m = range.first; m < range.first + range.count; ++m)
                seen.insert(m);
        }
        CHECK(int(seen.size()) == count);
        if (count > 0) CHECK(*seen.rbegin() == count - 1);
    }
}

}  // namespace shoal
