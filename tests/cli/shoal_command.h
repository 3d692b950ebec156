// The program as a user runs it: started with arguments, without a shell, and ended when it hangs.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"

namespace shoal::test {

struct Outcome {
    int code = -1;   // exit code; -1: ended by a signal or by the time limit
    int signal = 0;  // that ended it
    bool late = false;
    std::string out, err;

    // The lines that the program says on standard error as itself: "shoal: ...".
    std::vector<std::string> messages() const;
    JsonValue json() const;  // standard output, read strictly
};

// Leaves out the lines that tell what takes long on a slow machine.
std::string withoutWaits(const std::string& err);

struct Surroundings {
    std::string folder = {};  // where it starts; empty: where the test runs
    std::map<std::string, std::optional<std::string>> environment =
        {};                                   // nothing: the variable is taken away
    std::optional<size_t> largestFile = {};   // bytes, as on a disk with that much left
    std::optional<size_t> addressSpace = {};  // bytes, the most of memory
    std::string standardOutput = {};          // a file instead of Outcome::out
    double seconds = 600;                     // then it hangs, also on a slow machine
};

using Words = std::vector<std::string>;

Outcome runProgram(const std::string& program, const Words& arguments, const Surroundings& surroundings = {});
inline Outcome runShoal(const Words& arguments, const Surroundings& surroundings = {}) {
    return runProgram(SHOAL_COMMAND, arguments, surroundings);
}

// Starts the program and talks to it while it runs, in a group of processes of its own.
class StartedShoal {
  public:
    explicit StartedShoal(const Words& arguments, const Surroundings& surroundings = {},
                          const std::string& program = SHOAL_COMMAND);
    ~StartedShoal();  // ends it, if it still runs
    StartedShoal(const StartedShoal&) = delete;
    StartedShoal& operator=(const StartedShoal&) = delete;

    int process() const { return process_; }
    void waitForFile(const std::string& file);   // both fail the test when it ends before, or after the limit
    void waitForError(const std::string& part);  // on standard error
    void send(int signal, bool toAll = false);   // to all: as a terminal does
    Outcome finish();

  private:
    int process_ = -1, out_ = -1, err_ = -1;
    double seconds_;
    Outcome outcome_;
    template <typename Test>
    void waitUntil(const char* what, const Test& test);
};

// Whether this machine has the context ("egl", "osmesa", "window"); asked once.
bool hasContext(const std::string& name);

// Expects a refusal: an exit code that is not zero, nothing on standard output, exactly one message, and in
// it `part`. Returns the message.
std::string refusal(const Words& arguments, const std::string& part, const Surroundings& surroundings = {});

// Files below a folder, as paths relative to it; hidden ones, too.
std::vector<std::string> filesIn(const std::string& folder);

// A member of an object that must be there.
const JsonValue& member(const JsonValue& object, const std::string& key);

inline std::string sourceFile(const std::string& name) {
    return std::string(SHOAL_SOURCE_DIR) + "/" + name;
}
inline std::string squaresScene() {
    return sourceFile("tests/cli/squares.scene.json");
}

}  // namespace shoal::test
