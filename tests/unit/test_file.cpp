#include "support/catch.h"

#include <csignal>
#include <cstddef>
#include <fstream>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/file.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;

static size_t entries(const std::filesystem::path& folder) {
    size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder))
        ++count;
    return count;
}

TEST_CASE("a file reads back as it was written, zero bytes too", "[file]") {
    const test::Scratch folder;
    const std::string bytes("a\0b\n", 4);
    writeFile(folder / "new/deep/x.bin", bytes);
    CHECK(readFile(folder / "new/deep/x.bin") == bytes);
    writeFile(folder / "new/deep/x.bin", std::string_view("second"));
    CHECK(readFile(folder / "new/deep/x.bin") == "second");
    CHECK(entries(folder / "new/deep") == 1);
}

TEST_CASE("what cannot be read says why", "[file]") {
    const test::Scratch folder;
    CHECK(messageOf([&] { readFile(folder / "none"); }) == (folder / "none").string() + ": no such file");
    CHECK(messageOf([&] { readFile(folder.folder()); }).find("is a folder, expected a file") !=
          std::string::npos);
    writeFile(folder / "large", std::string(100, 'x'));
    CHECK(messageOf([&] { readFile(folder / "large", 99); }).find("is larger than 99 bytes") !=
          std::string::npos);
    CHECK(readFile(folder / "large", 100).size() == 100);
}

TEST_CASE("what is no regular file is refused before it is read", "[file]") {
    const test::Scratch folder;
    REQUIRE(::mkfifo(folder.path("fifo").c_str(), 0600) == 0);
    std::filesystem::create_symlink("/dev/zero", folder / "endless");
    std::filesystem::create_symlink("fifo", folder / "waits");
    CHECK(messageOf([&] { readFile(folder / "fifo"); }) ==
          folder.path("fifo") + ": is a FIFO, expected a file");
    CHECK(messageOf([&] { readFile(folder / "waits"); }).find("is a FIFO") != std::string::npos);
    CHECK(messageOf([&] { readFile("/dev/null"); }) == "/dev/null: is a device, expected a file");
    CHECK(messageOf([&] { readFile(folder / "endless"); }).find("is a device") != std::string::npos);
    writeFile(folder / "file", std::string_view("x"));
    std::filesystem::create_symlink("file", folder / "link");
    CHECK(readFile(folder / "link") == "x");
    CHECK(messageOf([&] { readFile(folder / "file/below"); }).find("no such file") != std::string::npos);
}

TEST_CASE("what cannot be written says why", "[file]") {
    const test::Scratch folder;
    writeFile(folder / "file", std::string_view("x"));
    CHECK(messageOf([&] { writeFile(folder.folder(), std::string_view("x")); }).find("is a folder") !=
          std::string::npos);
    CHECK(messageOf([&] {
              writeFile(folder / "file/below", std::string_view("x"));
          }).find("cannot make this folder") != std::string::npos);
}

TEST_CASE("a file is written through links, and into what is no file", "[file]") {
    const test::Scratch folder;
    writeFile(folder / "file", std::string_view("old"));
    std::filesystem::create_symlink("file", folder / "link");
    std::filesystem::create_symlink("deep/new", folder / "dangling");
    std::filesystem::create_symlink("loop", folder / "loop");
    std::filesystem::create_symlink("/dev/null", folder / "null");
    for (const char* name : {"link", "dangling", "null"}) {
        writeFile(folder / name, std::string_view("new"));
        CHECK(std::filesystem::is_symlink(folder / name));
    }
    CHECK(readFile(folder / "file") == "new");
    CHECK(readFile(folder / "deep/new") == "new");
    CHECK(std::filesystem::is_character_file("/dev/null"));
    CHECK(messageOf([&] { writeFile(folder / "loop", std::string_view("x")); }).find("cannot be written") !=
          std::string::npos);

    REQUIRE(::mkfifo(folder.path("fifo").c_str(), 0600) == 0);
    CHECK(messageOf([&] { writeFile(folder / "fifo", std::string_view("x")); }).find("nobody reads there") !=
          std::string::npos);
    const int reader = ::open(folder.path("fifo").c_str(), O_RDONLY | O_NONBLOCK);
    writeFile(folder / "fifo", std::string_view("x"));
    char got = 0;
    CHECK(::read(reader, &got, 1) == 1);
    CHECK(got == 'x');
    ::close(reader);
    CHECK(std::filesystem::is_fifo(folder / "fifo"));
    checkWritable(folder / "fifo");
    CHECK(messageOf([&] { PartFile{folder / "fifo"}; }).find("is a FIFO") != std::string::npos);
}

TEST_CASE("what dead processes left is swept, and what is written stays", "[file]") {
    const test::Scratch folder;
    const pid_t dead = ::fork();
    if (dead == 0) ::_exit(0);
    REQUIRE(::waitpid(dead, nullptr, 0) == dead);
    const std::string own = std::to_string(::getpid());
    const auto make = [&](const std::string& name) { std::ofstream(folder / name) << "x"; };
    make(concat(".shoal-", dead, "-a.csv"));
    make(concat(".shoal-", dead, "-locked.csv"));  // by a process in another container, say
    make(concat(".shoal-", own, "-c.csv"));        // of one that had our number
    make(concat(".shoal-", ::getppid(), "-d.csv"));
    make(".shoal-notes");
    make("a.csv.part-" + own);
    const int locked = ::open(folder.path(concat(".shoal-", dead, "-locked.csv")).c_str(), O_RDONLY);
    REQUIRE(::flock(locked, LOCK_EX) == 0);
    {
        const PartFile unfinished(folder / "x.csv");
        CHECK(unfinished.path() == folder / concat(".shoal-", own, "-x.csv"));
        CHECK(entries(folder.folder()) == 5);  // of those above four
        CHECK(messageOf([&] {
                  writeFile(folder / "x.csv", std::string_view("x"));
              }).find("is being written already") != std::string::npos);
    }
    CHECK(entries(folder.folder()) == 4);
    CHECK(std::filesystem::exists(folder / concat(".shoal-", dead, "-locked.csv")));
    CHECK(std::filesystem::exists(folder / concat(".shoal-", ::getppid(), "-d.csv")));
    ::close(locked);
    const PartFile unfinished(folder / "x.csv");
    removePartFiles();
    CHECK(entries(folder.folder()) == 4);
    writeFile(folder / std::string(250, 'n'), std::string_view("long"));
    CHECK(readFile(folder / std::string(250, 'n')) == "long");
}

TEST_CASE("folders that were made for a file that is not kept go with it", "[file]") {
    const test::Scratch folder;
    checkWritable(folder / "a/b/c.json");
    CHECK(messageOf([&] { checkWritable(folder / "trailing/"); }).find("is a folder") != std::string::npos);
    CHECK(unnamedFile(folder / "a/b/c.png"));
    CHECK(entries(folder.folder()) == 0);
    std::filesystem::create_directory(folder / "a");
    {
        const PartFile unfinished(folder / "a/b/c.json");
        CHECK(entries(folder / "a/b") == 1);
    }
    CHECK(entries(folder / "a") == 0);  // which stood before
    CHECK(std::filesystem::exists(folder / "a"));
    writeFile(folder / "a/b/c.json", std::string_view("x"));
    CHECK(readFile(folder / "a/b/c.json") == "x");
}

TEST_CASE("a full disk leaves the old file and nothing else", "[file]") {
    const test::Scratch folder;
    writeFile(folder / "kept", std::string_view("old"));
    // A limit on the size of files fails a write as a full disk does.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    rlimit small = before;
    small.rlim_cur = 1000;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = messageOf([&] { writeFile(folder / "kept", std::string(100000, 'x')); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(message.find("cannot be written") != std::string::npos);
    CHECK(readFile(folder / "kept") == "old");
    CHECK(entries(folder.folder()) == 1);
}

TEST_CASE("what is not really there is not read", "[file]") {
    const test::Scratch folder;
    const std::string sparse = folder.write("sparse", "begins");
    const auto refusal = [&](off_t bytes, size_t most = size_t{1} << 40) {
        REQUIRE(::truncate(sparse.c_str(), bytes) == 0);
        return messageOf([&] { readFile(sparse, most); });
    };
    struct stat status {};
    REQUIRE(::stat(sparse.c_str(), &status) == 0);
    const std::string stored = std::to_string(512 * status.st_blocks);
    CHECK(refusal(off_t{30} << 30) == sparse + ": is sparse: of its 32212254720 bytes only " + stored +
                                          " are stored, and the rest is nothing");
    CHECK(refusal(65'000'000).find("is sparse") != std::string::npos);
    CHECK(refusal(63'000'000, 1000).find("is larger than 1000 bytes") != std::string::npos);
    REQUIRE(::truncate(sparse.c_str(), 63'000'000) == 0);  // costs little, so nobody asks
    CHECK(readFile(sparse).size() == 63'000'000);
}
