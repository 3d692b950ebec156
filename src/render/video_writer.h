// A video, encoded by the ffmpeg command, which gets the pictures through a pipe.
#pragma once

#include <sys/types.h>
#include <filesystem>

#include "core/image.h"
#include "core/part_file.h"

namespace shoal {

class VideoWriter {
  public:
    // Error: ffmpeg is not installed; says how to get it.
    static void checkInstalled();

    // Error: ffmpeg cannot be started, or PartFile's.
    VideoWriter(std::filesystem::path file, int width, int height, double frameRate);
    ~VideoWriter();  // without finish(): nothing is left behind
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    // RGBA of the size given at the start. Error: another size, or ffmpeg stopped.
    void write(const Image& picture);
    // Waits for ffmpeg and gives the file its name. Error: ffmpeg failed, with what it said.
    void finish();

  private:
    void start(double frameRate);
    void closePipe();
    void closeLog();
    int wait();  // exit status of ffmpeg, -1 when a signal ended it
    [[noreturn]] void fail(const std::string& what);
    std::string complaint() const;  // the end of what ffmpeg said

    std::filesystem::path file_;
    PartFile part_;
    int width_, height_;
    int pipe_ = -1, log_ = -1;
    pid_t process_ = -1;
};

}  // namespace shoal
