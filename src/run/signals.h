// What ends the program from outside: SIGINT (Ctrl-C), SIGTERM, SIGHUP.
//
// It ends at once and leaves no file that is not whole; while something lives that can be finished, the first
// signal only asks for that, and the second ends at once.
#pragma once

namespace shoal {

// Once, by main(). What was ignored when the program started, as nohup does, stays ignored.
void catchSignals();

// While it lives, the first signal only asks.
class FinishesOnSignal {
  public:
    FinishesOnSignal();
    ~FinishesOnSignal();
    FinishesOnSignal(const FinishesOnSignal&) = delete;
    FinishesOnSignal& operator=(const FinishesOnSignal&) = delete;
};

int signalThatAsked();                      // 0: none yet
[[noreturn]] void endBySignal(int signal);  // so that whoever waits for the program sees the signal

}  // namespace shoal
