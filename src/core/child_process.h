// A process of its own for what may crash, hang or end without having done anything: a helper program, or
// work of ours in a fork.
#pragma once

#include <sys/types.h>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shoal {

class ChildProcess {
  public:
    // Starts `work` in a fork without exec; the child ends when it returns, without destructors. The child
    // has no handler of signals that the parent had, dies with its parent, and leaves it to the parent to end
    // on SIGINT, SIGTERM and SIGHUP, which a terminal sends to both. Error: no process can be made.
    explicit ChildProcess(const std::function<void()>& work);
    ~ChildProcess();  // ends it, if it still runs
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    // Waits at most so long. Returns its status as waitpid() has it, 0 where somebody else took it; nothing:
    // it still runs.
    std::optional<int> wait(double seconds);
    void end();  // kills it

  private:
    pid_t process_ = -1;
    int status_ = 0;
};

// A file in memory, which a full disk does not stop. Error: cannot be made, or written.
class MemoryFile {
  public:
    explicit MemoryFile(const std::string& text = {});
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    int file() const { return file_; }
    std::string text() const;  // all of it

  private:
    int file_;
};

// Open files that a program has in place of its standard streams.
struct ProgramStreams {
    int in = -1, out = -1, err = -1;
};

// Starts a program without a shell: its path, then its arguments. Where it cannot be run, its exit code is
// 127. Error: ChildProcess's.
std::unique_ptr<ChildProcess> startProgram(std::vector<std::string> command, const ProgramStreams& streams);

// A program's exit code; -1: a signal ended it.
int exitCode(int status);

// Returns the end of what a helper said, without the last line break, for an error's text.
std::string lastWords(const MemoryFile& file);

}  // namespace shoal
