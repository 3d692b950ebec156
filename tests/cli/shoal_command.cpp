#include "cli/shoal_command.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "support/catch.h"

extern char** environ;

namespace shoal::test {

namespace {

namespace fs = std::filesystem;

struct Pipe {
    int read = -1, write = -1;
    Pipe() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe for the test");
        read = ends[0];
        write = ends[1];
    }
    ~Pipe() {
        close(read);
        close(write);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    static void close(int& end) {
        if (end >= 0) ::close(end);
        end = -1;
    }
};

Words environmentOf(const Surroundings& surroundings) {
    Words out;
    for (char** entry = environ; *entry; ++entry) {
        const std::string text = *entry;
        if (!surroundings.environment.contains(text.substr(0, text.find('=')))) out.push_back(text);
    }
    for (const auto& [name, value] : surroundings.environment)
        if (value) out.push_back(name + "=" + *value);
    // Mesa takes no program that it compiled for another number of cores, as under taskset, and we tell of
    // that.
    for (std::string& entry : out)
        if (entry.rfind("SHOAL_CACHE=/", 0) == 0 && !surroundings.environment.contains("SHOAL_CACHE"))
            entry += "/" + std::to_string(std::thread::hardware_concurrency());
    return out;
}

std::vector<char*> pointers(Words& words) {
    std::vector<char*> out;
    for (std::string& word : words)
        out.push_back(word.data());
    out.push_back(nullptr);
    return out;
}

// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char** arguments, char** environment, const Surroundings& surroundings, int out,
                         int err) {
    if (!surroundings.folder.empty() && ::chdir(surroundings.folder.c_str()) != 0) ::_exit(126);
    if (surroundings.largestFile) {
        const rlimit limit{*surroundings.largestFile, *surroundings.largestFile};
        if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(126);
    }
    if (!surroundings.standardOutput.empty()) out = ::open(surroundings.standardOutput.c_str(), O_WRONLY);
    const int in = ::open("/dev/null", O_RDONLY);
    if (out < 0 || in < 0) ::_exit(126);
    ::dup2(in, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    ::execve(arguments[0], arguments, environment);
    ::_exit(127);
}

// Reads both ends until the program closes them; false when the time is up.
bool collect(Pipe& out, Pipe& err, Outcome& outcome, double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    pollfd ends[] = {{out.read, POLLIN, 0}, {err.read, POLLIN, 0}};
    std::string* texts[] = {&outcome.out, &outcome.err};
    while (ends[0].fd >= 0 || ends[1].fd >= 0) {
        const std::chrono::duration<double> left = end - std::chrono::steady_clock::now();
        if (left.count() <= 0) return false;
        ::poll(ends, 2, int(left.count() * 1000) + 1);
        for (int i = 0; i < 2; ++i) {
            if (ends[i].fd < 0 || ends[i].revents == 0) continue;
            char chunk[4096];
            const ssize_t count = ::read(ends[i].fd, chunk, sizeof chunk);
            if (count > 0)
                texts[i]->append(chunk, size_t(count));
            else
                ends[i].fd = -1;
        }
    }
    return true;
}

}  // namespace

Outcome runProgram(const std::string& program, const Words& arguments, const Surroundings& surroundings) {
    Words words{program}, variables = environmentOf(surroundings);
    words.insert(words.end(), arguments.begin(), arguments.end());
    const std::vector<char*> argv = pointers(words), envp = pointers(variables);
    Pipe out, err;
    const pid_t process = ::fork();
    if (process < 0) throw std::runtime_error("the program cannot be started");
    if (process == 0)
        become(const_cast<char**>(argv.data()), const_cast<char**>(envp.data()), surroundings, out.write,
               err.write);
    Pipe::close(out.write);
    Pipe::close(err.write);
    Outcome outcome;
    outcome.late = !collect(out, err, outcome, surroundings.seconds);
    if (outcome.late) ::kill(process, SIGKILL);
    int status = 0;
    ::waitpid(process, &status, 0);
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    if (outcome.late) outcome.err += "\n(ended by the test: it took longer than the time limit)";
    return outcome;
}

std::vector<std::string> Outcome::messages() const {
    std::vector<std::string> found;
    std::istringstream lines(err);
    for (std::string line; std::getline(lines, line);)
        if (line.rfind("shoal: ", 0) == 0) found.push_back(line);
    return found;
}

JsonValue Outcome::json() const {
    return parseJson(out, "standard output");
}

bool hasContext(const std::string& name) {
    static const JsonValue report = runShoal({"info", "--json"}).json();
    for (const JsonValue& context : member(report, "contexts").items)
        if (member(context, "context").text == name) return member(context, "available").boolean;
    return false;
}

std::string refusal(const Words& arguments, const std::string& part, const Surroundings& surroundings) {
    const Outcome outcome = runShoal(arguments, surroundings);
    std::string shown;
    for (const std::string& word : arguments)
        shown += " " + word;
    INFO("shoal" << shown << "\n" << outcome.err);
    CHECK(outcome.code == 1);
    CHECK(outcome.out.empty());
    CHECK(outcome.messages().size() == 1);
    CHECK_THAT(outcome.err, Catch::Contains(part));
    return outcome.err;
}

std::vector<std::string> filesIn(const std::string& folder) {
    std::vector<std::string> found;
    if (!fs::exists(folder)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (!entry.is_directory()) found.push_back(fs::relative(entry.path(), folder).string());
    std::sort(found.begin(), found.end());
    return found;
}

const JsonValue& member(const JsonValue& object, const std::string& key) {
    const JsonValue* found = object.find(key);
    if (!found) throw std::runtime_error("the report has no \"" + key + "\"");
    return *found;
}

}  // namespace shoal::test
