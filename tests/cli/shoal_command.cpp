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
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

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
    int takeRead() { return std::exchange(read, -1); }
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
    if (surroundings.addressSpace) {
        const rlimit limit{*surroundings.addressSpace, *surroundings.addressSpace};
        if (::setrlimit(RLIMIT_AS, &limit) != 0) ::_exit(126);
    }
    if (!surroundings.standardOutput.empty()) out = ::open(surroundings.standardOutput.c_str(), O_WRONLY);
    const int in = ::open("/dev/null", O_RDONLY);
    if (out < 0 || in < 0) ::_exit(126);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})  // whatever the tests were started with
        ::signal(signal, SIG_DFL);
    ::dup2(in, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    ::execve(arguments[0], arguments, environment);
    ::_exit(127);
}

// Reads what both ends have, and waits for it at most so long. False: the program has closed them.
bool readSome(int& out, int& err, Outcome& outcome, int milliseconds) {
    pollfd ends[] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
    std::string* texts[] = {&outcome.out, &outcome.err};
    int* files[] = {&out, &err};
    ::poll(ends, 2, milliseconds);
    for (int i = 0; i < 2; ++i) {
        if (ends[i].fd < 0 || ends[i].revents == 0) continue;
        char chunk[4096];
        const ssize_t count = ::read(ends[i].fd, chunk, sizeof chunk);
        if (count > 0)
            texts[i]->append(chunk, size_t(count));
        else
            Pipe::close(*files[i]);
    }
    return out >= 0 || err >= 0;
}

double secondsNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

StartedShoal::StartedShoal(const Words& arguments, const Surroundings& surroundings,
                           const std::string& program)
    : seconds_(surroundings.seconds) {
    Words words{program}, variables = environmentOf(surroundings);
    words.insert(words.end(), arguments.begin(), arguments.end());
    const std::vector<char*> argv = pointers(words), envp = pointers(variables);
    Pipe out, err;
    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("the program cannot be started");
    if (process_ == 0) {
        ::setpgid(0, 0);
        become(const_cast<char**>(argv.data()), const_cast<char**>(envp.data()), surroundings, out.write,
               err.write);
    }
    ::setpgid(process_, process_);  // here as well, since nobody knows who comes first
    out_ = out.takeRead();
    err_ = err.takeRead();
}

StartedShoal::~StartedShoal() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    Pipe::close(out_);
    Pipe::close(err_);
}

template <typename Test>
void StartedShoal::waitUntil(const char* what, const Test& test) {
    const double end = secondsNow() + seconds_;
    while (!test()) {
        const bool runs = readSome(out_, err_, outcome_, 20);
        INFO("waits for " << what << "\n" << outcome_.out << outcome_.err);
        REQUIRE((runs || test()));
        REQUIRE(secondsNow() < end);
    }
}

void StartedShoal::waitForFile(const std::string& file) {
    waitUntil(file.c_str(), [&] { return fs::exists(file); });
}

void StartedShoal::waitForError(const std::string& part) {
    waitUntil(part.c_str(), [&] { return outcome_.err.find(part) != std::string::npos; });
}

void StartedShoal::send(int signal, bool toAll) {
    REQUIRE(::kill(toAll ? -process_ : process_, signal) == 0);
}

std::string withoutWaits(const std::string& err) {
    return std::regex_replace(err, std::regex("shoal: (compiling|baking|placing|reading) [^\n]*\n"), "");
}

Outcome StartedShoal::finish() {
    const double end = secondsNow() + seconds_;
    while (readSome(out_, err_, outcome_, 100) && !outcome_.late)
        outcome_.late = secondsNow() > end;
    if (outcome_.late) ::kill(process_, SIGKILL);
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    if (WIFEXITED(status)) outcome_.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome_.signal = WTERMSIG(status);
    outcome_.err = withoutWaits(outcome_.err);
    if (outcome_.late) outcome_.err += "\n(ended by the test: it took longer than the time limit)";
    return outcome_;
}

Outcome runProgram(const std::string& program, const Words& arguments, const Surroundings& surroundings) {
    return StartedShoal(arguments, surroundings, program).finish();
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
    CHECK((outcome.code == 1 || outcome.code == 2));
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
