// Where pictures go. No OpenGL, but the room is `render`.
#include <cstdlib>
#include <functional>

#include "core/error.h"
#include "render/picture.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Image plain(int width, int height) {
    return {width, height, 4, std::vector<uint8_t>(size_t(width * height) * 4, 200)};
}

// Another PATH for one test.
class Path {
  public:
    explicit Path(const std::string& path) : before_(std::getenv("PATH")) { setenv("PATH", path.c_str(), 1); }
    ~Path() { setenv("PATH", before_.c_str(), 1); }
    Path(const Path&) = delete;
    Path& operator=(const Path&) = delete;

  private:
    std::string before_;
};

void writeScript(const Scratch& scratch, const std::string& text) {
    const std::string file = scratch.write("bin/ffmpeg", "#!/bin/sh\n" + text);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

// Stands in for the encoder of pictures of 7 x 5: keeps the raw bytes in the file that the last argument
// names. Asked what is in a file, it lists its pictures.
const std::string keeper = R"(
for last; do :; done
while [ $# -gt 1 ]; do [ "$1" = -i ] && in=$2; shift; done
[ "$last" = pipe:1 ] || { cat > "$last"; exit; }
echo "#comment"
for i in $(seq $(($(wc -c < "$in") / 140))); do echo "0, $i"; done
)";

size_t filesIn(const std::string& folder) {
    size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder))
        ++count;
    return count;
}

}  // namespace

TEST_CASE("frames are numbered in a folder or where the name says", "[picture]") {
    CHECK(frameFile("out", 7) == "out/frame-00007.png");
    CHECK(frameFile("out", 7, true, 123456) == "out/frame-000007.png");
    CHECK(frameFile("a/%d.png", 7, true, 123456) == "a/7.png");
    CHECK_THROWS_AS(frameFile("a/%05d.png", 7, true, 123456), Error);
    CHECK(frameFile("a/b-%04d.png", 12, true, 9999) == "a/b-0012.png");
    CHECK(frameFile("a/%d.png", 12) == "a/12.png");
    CHECK(frameFile("one.png", 12, false) == "one.png");
    CHECK(frameFile("one.png", 12, true) == "one-00012.png");
    CHECK_THROWS_AS(frameFile("%s.png", 0), Error);
    CHECK_THROWS_AS(frameFile("%d-%d.png", 0), Error);
    CHECK_THROWS_AS(frameFile("%", 0), Error);
    CHECK_THROWS_AS(frameFile("%n%n.png", 0), Error);
}

TEST_CASE("pictures are written under their number", "[picture]") {
    const Scratch scratch;
    PictureWriter writer(scratch.path("out"), 60);
    writer.write(plain(5, 3), 2);
    writer.finish();
    CHECK(writer.last() == scratch.path("out") + "/frame-00002.png");
    CHECK(readPng(writer.last()).width == 5);
    PictureWriter few(scratch.path("few"), 60, true, 10);
    CHECK_THROWS_AS(few.write(plain(5, 3), 11), Error);
}

TEST_CASE("a picture that cannot be written is told by the next one, or at the end", "[picture]") {
    const Scratch scratch;
    for (const bool last : {false, true}) {
        PictureWriter writer(scratch.path("out"), 60);
        std::filesystem::create_directories(scratch.path("out/frame-00001.png/in the way"));
        writer.write(plain(5, 3), 1);
        const std::string message = messageOf([&] { last ? writer.finish() : writer.write(plain(5, 3), 2); });
        CHECK(message.find("frame-00001.png") != std::string::npos);
    }
}

TEST_CASE("a video without ffmpeg says what to install", "[picture]") {
    const Scratch scratch;
    const Path path(scratch.path("nothing"));
    const std::string message = messageOf([&] { PictureWriter(scratch.path("a.mp4"), 30); });
    CHECK(message.find("apt install ffmpeg") != std::string::npos);
}

TEST_CASE("an ffmpeg that fails is an error with its own words, and leaves nothing behind", "[picture]") {
    const Scratch scratch;
    writeScript(scratch, "echo no such encoder >&2\nexit 3\n");
    std::filesystem::create_directory(scratch.path("out"));
    const Path path(scratch.path("bin") + ":/usr/bin:/bin");
    const std::string message = messageOf([&] {
        PictureWriter writer(scratch.path("out/a.mp4"), 30);
        for (int i = 0; i < 50; ++i)
            writer.write(plain(256, 256), i);  // more than a pipe holds
        writer.finish();
    });
    CHECK(message.find("no such encoder") != std::string::npos);
    CHECK(filesIn(scratch.path("out")) == 0);
}

TEST_CASE("a video gets its name when it is whole", "[picture]") {
    const Scratch scratch;
    writeScript(scratch, keeper);
    std::filesystem::create_directory(scratch.path("out"));
    const Path path(scratch.path("bin") + ":/usr/bin:/bin");
    const std::string file = scratch.path("out/a; rm -rf b.mp4");  // no shell looks at the name
    PictureWriter writer(file, 30);
    for (int i = 0; i < 3; ++i)
        writer.write(plain(7, 5), i);
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK_THROWS_AS(writer.write(plain(8, 5), 3), Error);
    writer.finish();
    CHECK(std::filesystem::file_size(file) == 3 * 7 * 5 * 4);
    CHECK(filesIn(scratch.path("out")) == 1);
}

TEST_CASE("a video that is given up leaves nothing behind", "[picture]") {
    const Scratch scratch;
    writeScript(scratch, "for last; do :; done\ncat > \"$last\"\n");
    std::filesystem::create_directory(scratch.path("out"));
    const Path path(scratch.path("bin") + ":/usr/bin:/bin");
    {
        PictureWriter writer(scratch.path("out/a.mp4"), 30);
        writer.write(plain(7, 5), 0);
    }
    CHECK(filesIn(scratch.path("out")) == 0);
}

TEST_CASE("an ffmpeg's word is not taken for what it wrote", "[picture]") {
    const Scratch scratch;
    const Path path(scratch.path("bin") + ":/usr/bin:/bin");
    const std::string file = scratch.write("out/a.mp4", "old");
    const auto told = [&](const std::string& script) {
        writeScript(scratch, script);
        return messageOf([&] {
            VideoWriter writer(file, 7, 5, 30, false, 0.3);
            for (int i = 0; i < 3; ++i)
                writer.write(plain(7, 5));
            writer.finish();
        });
    };
    CHECK(told(keeper).empty());
    CHECK(std::filesystem::file_size(file) == 3 * 7 * 5 * 4);
    scratch.write("out/a.mp4", "old");
    CHECK(told("cat > /dev/null\n").find("wrote a video of 0 pictures, expected 3") != std::string::npos);
    CHECK(told(std::string("for last; do :; done\n[ \"$last\" = pipe:1 ] || { head -c 280 > "
                           "\"$last\"; cat > /dev/null; exit; }\n") +
               keeper)
              .find("wrote a video of 2 pictures, expected 3") != std::string::npos);
    CHECK(told("cat > /dev/null\nexec sleep 600\n").find("has written nothing for 0.3 s and was ended") !=
          std::string::npos);
    CHECK(told("for last; do :; done\n[ \"$last\" = pipe:1 ] || { cat > \"$last\"; exit; }\nexec sleep 600\n")
              .find("has written nothing for 0.3 s") != std::string::npos);
    CHECK(readFile(file) == "old");
    CHECK(filesIn(scratch.path("out")) == 1);
}

TEST_CASE("an ffmpeg that takes no picture is not waited for", "[picture]") {
    const Scratch scratch;
    const Path path(scratch.path("bin") + ":/usr/bin:/bin");
    std::filesystem::create_directory(scratch.path("out"));
    writeScript(scratch, "exec sleep 600\n");
    const std::string message = messageOf([&] {
        VideoWriter writer(scratch.path("out/a.mp4"), 256, 256, 30, false, 0.3);
        for (int i = 0; i < 50; ++i)
            writer.write(plain(256, 256));  // more than a pipe holds
    });
    CHECK(message.find("ffmpeg has taken nothing for 0.3 s and was ended") != std::string::npos);
    CHECK(filesIn(scratch.path("out")) == 0);
}
