// Where pictures go: a folder, a name with a number in it, or a video (video_writer.cpp).
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "core/child_process.h"
#include "core/file.h"
#include "core/image.h"

namespace shoal {

void turnOver(Image& image);  // the last row becomes the first: OpenGL's come from the bottom

// The file of one frame. `target` is a folder, which gets frame-00000.png and so on, or a name with one
// %d or %05d in it, or a name ending in .png or .exr, which takes the frame's number only if `many`. Numbers
// are as long as `last`, so that names sort. Error: more than one %, one that is no number, or one with too
// few digits.
std::filesystem::path frameFile(const std::string& target, int frame, bool many = true, int last = 99999);

// Whether `target` names a video: .mp4, .mkv, .webm or .mov.
bool isVideo(const std::string& target);
// Whether it is one with alpha: .mov (ProRes 4444) or .webm (VP9).
bool isVideoWithAlpha(const std::string& target);

// A video, encoded by the ffmpeg command, which gets the pictures through a pipe.
class VideoWriter {
  public:
    static bool installed();       // whether ffmpeg is
    static void checkInstalled();  // Error: it is not; says how to get it

    // `alpha`: straight, of a file that isVideoWithAlpha. `patience`: s, how long ffmpeg may neither take nor
    // write anything. Error: ffmpeg cannot be started, or PartFile's.
    VideoWriter(std::filesystem::path file, int width, int height, double frameRate, bool alpha = false,
                double patience = 120);
    ~VideoWriter();  // without finish(): nothing is left behind
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    // RGBA of the size given at the start. Error: another size, or ffmpeg stopped, or hangs.
    void write(const Image& picture);
    // Waits for ffmpeg, counts the pictures of what it wrote, and gives the file its name. Error: ffmpeg
    // failed, with what it said, hangs, or wrote other than it was given.
    void finish();

  private:
    [[noreturn]] void fail(const std::string& what);
    [[noreturn]] void failWaiting(const char* forWhat);
    int waitWhileItWrites(ChildProcess& program, int written);
    void checkPictures();

    std::filesystem::path file_;
    PartFile part_;
    int width_, height_;
    double patience_;
    int pictures_ = 0, pipe_ = -1;
    std::unique_ptr<MemoryFile> log_;  // what ffmpeg says
    std::unique_ptr<ChildProcess> process_;
};

// Takes the pictures of a run, one a frame.
class PictureWriter {
  public:
    // `last`: the greatest frame number. Error: ffmpeg is needed and not installed, frameFile's, or
    // SoleWriter's.
    PictureWriter(std::string target, double frameRate, bool many = true, int last = 99999,
                  bool alpha = false);

    // A PNG is written on another thread, while the next picture is made. Error: disk full or no permission,
    // here or for the picture before; ffmpeg failed, a video's pictures differ in size, or a frame of folder
    // or name is beyond the last.
    void write(Image picture, int frame);
    // Where a frame's picture goes that is none for a video, for who writes it. Error: beyond the last.
    std::filesystem::path place(int frame);
    void finish();  // all are written; a video gets its name only now. Error: as write()

    const std::string& target() const { return target_; }
    std::filesystem::path last() const { return last_; }  // file of the last picture; empty before the first

  private:
    std::string target_;
    double frameRate_;
    bool many_, alpha_;
    int lastFrame_;
    std::optional<SoleWriter> sole_;
    std::unique_ptr<VideoWriter> video_;
    std::filesystem::path last_;
    std::future<void> writing_;  // of the last PNG
};

// "leaves-001.png", or with the first number for which there is no such file or folder.
std::string freeName(const std::string& stem, const std::string& ending);

// Pictures or a video that the user asks for while the scene runs: beside one another in the working folder,
// numbered, over no file that is there.
class Recorder {
  public:
    // A video where ffmpeg is installed, else a folder of pictures. Error: cannot be made.
    void start(const std::string& stem, double frameRate);
    void add(const Image& picture);  // Error: PictureWriter's, and it records no more
    void stop();                     // Error: the same
    bool records() const { return writer_ != nullptr; }
    int frames() const { return frames_; }
    const std::string& target() const { return target_; }  // of the last start

  private:
    std::unique_ptr<PictureWriter> writer_;  // null: nothing is recorded
    std::string target_;
    int frames_ = 0;
};

}  // namespace shoal
