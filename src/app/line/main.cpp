#include <csignal>
#include <exception>
#include <iostream>
#include <new>

#include "app/line/commands.h"
#include "core/data_paths.h"
#include "core/memory.h"
#include "core/printable.h"
#include "run/progress.h"
#include "run/scene_list.h"
#include "run/signals.h"

// Scenes by their names become files. What `check` does not find it reports like other files.
static void findScenes(shoal::app::Options& options) {
    using namespace shoal::app;
    for (std::string& file : options.files) {
        for (const auto command : {runCommand, explainCommand, measureCommand, fieldCommand, exportCommand})
            if (options.command == command) file = shoal::needScene(file);
        if (options.command == checkCommand) file = shoal::sceneFile(file).value_or(file);
    }
}

int main(int argc, char** argv) {
    using namespace shoal::app;
    // A full disk or a closed pipe shows as an error of the write that met it, not as a signal.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    shoal::catchSignals();
    // Whoever writes to them, of whatever names: no terminal takes it for anything but text.
    const shoal::PrintableStream out(std::cout), messages(std::cerr);
    std::optional<Options> options;
    try {
        options = parseOptions(argc, argv);
        int code = 0;
        if (options) {
            findScenes(*options);
            if (!options->files.empty()) keepToSandbox(*options, options->files.front());
            const shoal::BusyWatch busy;
            code = options->command(*options);
        }
        std::cout.flush();
        if (!std::cout) throw shoal::Error("standard output cannot be written");
        if (const int signal = shoal::signalThatAsked()) shoal::endBySignal(signal);
        return code;
    } catch (const std::bad_alloc&) {
        const std::string file = options && options->files.size() == 1 ? options->files.front() + ": " : "";
        std::cerr << "shoal: " << file << "out of memory: the command had taken "
                  << shoal::mebibytes(size_t(shoal::mostMemoryTaken())) << " when it asked for more\n";
    } catch (const WrongUse& error) {
        std::cerr << "shoal: " << error.what() << "\n";
        return 2;
    } catch (const shoal::Error& error) {
        std::cerr << "shoal: " << error.what() << "\n";
    } catch (const std::exception& error) {
        std::cerr << "shoal: " << shoal::printable(error.what()) << "\n";
    }
    return 1;
}
