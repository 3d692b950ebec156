// Handles the signals that end the program: SIGINT (Ctrl-C), SIGTERM, SIGHUP.
//
// The program says so in one line, leaves no incomplete file and ends at once, by the signal, which a shell
// tells as 128 and its number (130 of Ctrl-C). While a FinishesOnSignal lives, the first signal only asks for
// the end, and the second ends at once.
#pragma once

#include <string>

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

void leaveSignalsToMain();                  // called by another thread, which no signal interrupts then
int signalThatAsked();                      // 0: none yet
std::string stoppedBySignal();              // "stopped by signal 2 (Interrupt)", of the one that asked
[[noreturn]] void endBySignal(int signal);  // so that whoever waits for the program sees the signal

}  // namespace shoal
