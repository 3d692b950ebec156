#include <csignal>
#include <exception>
#include <iostream>
#include <new>

#include "app/commands.h"
#include "core/printable.h"
#include "run/data_paths.h"
#include "run/scene_list.h"
#include "run/signals.h"

// Scenes by their names become files. What `check` does not find it reports like other files.
static void findScenes(shoal::app::Options& options) {
    using Command = shoal::app::Options::Command;
    for (std::string& file : options.files) {
        switch (options.command) {
        case Command::run:
        case Command::explain:
        case Command::measure:
        case Command::field:
            file = shoal::needScene(file);
            break;
        case Command::check:
            file = shoal::sceneFile(file).value_or(file);
            break;
        default:
            break;
        }
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
    try {
        std::optional<Options> options = parseOptions(argc, argv);
        int code = 0;
        if (options) {
            findScenes(*options);
            if (!options->files.empty()) keepToSandbox(*options, options->files.front());
            switch (options->command) {
            case Options::Command::run:
                code = runCommand(*options);
                break;
            case Options::Command::scenes:
                code = scenesCommand(*options);
                break;
            case Options::Command::keys:
                code = keysCommand(*options);
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
        if (const int signal = shoal::signalThatAsked()) shoal::endBySignal(signal);
        return code;
    } catch (const std::bad_alloc&) {
        std::cerr << "shoal: out of memory\n";
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
