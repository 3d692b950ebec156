#include <csignal>
#include <exception>
#include <iostream>
#include <new>

#include "app/commands.h"
#include "app/data_paths.h"
#include "app/signals.h"

int main(int argc, char** argv) {
    using namespace shoal::app;
    // A full disk or a closed pipe shows as an error of the write that met it, not as a signal.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    catchSignals();
    try {
        const std::optional<Options> options = parseOptions(argc, argv);
        int code = 0;
        if (options && !options->files.empty()) keepToSandbox(*options, options->files.front());
        if (options) {
            switch (options->command) {
            case Options::Command::run:
                code = runCommand(*options);
                break;
            case Options::Command::check:
                code = checkCommand(*options);
                break;
            case Options::Command::explain:
                code = explainCommand(*options);
                break;
            case Options::Command::info:
                code = infoCommand(*options);
                break;
            case Options::Command::bench:
                code = benchCommand(*options);
                break;
            case Options::Command::measure:
                code = measureCommand(*options);
                break;
            case Options::Command::field:
                code = fieldCommand(*options);
                break;
            case Options::Command::edit:
                code = editCommand(*options);
                break;
            case Options::Command::moleculeFromMesh:
                code = moleculeFromMeshCommand(*options);
                break;
            case Options::Command::moleculeShow:
                code = moleculeShowCommand(*options);
                break;
            }
        }
        std::cout.flush();
        if (!std::cout) throw shoal::Error("standard output cannot be written");
        if (const int signal = signalThatAsked()) endBySignal(signal);
        return code;
    } catch (const std::bad_alloc&) {
        std::cerr << "shoal: out of memory\n";
    } catch (const std::exception& error) {
        std::cerr << "shoal: " << error.what() << "\n";
    }
    return 1;
}
