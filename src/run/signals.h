// Handles the signals that end the program: SIGINT (Ctrl-C), SIGTERM, SIGHUP.
//
// The program ends at once and leaves no incomplete file; while a FinishesOnSignal lives, the first signal
// only asks for the end, and the second ends at once.
#pragma once

namespace shoal {

// Called once, by main(). Signals that were ignored when the program started, as by nohup, stay ignored.
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
